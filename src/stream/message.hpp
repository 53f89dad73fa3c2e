// The content of grid messages, without the protection around it (stream/channel.hpp). It is big
// endian; docs/spec.md documents each byte.
//
// Every message begins with the same header, which gives its own length and the message type. A
// receiver skips header bytes beyond those it knows, and drops unknown message types, encodings and
// storages. New fields and encodings can therefore be added. Tiles are in stream/tiles.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "intake/sensor_report.hpp"
#include "protection/protected_message.hpp"
#include "stream/target_state.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::stream {

inline constexpr std::size_t kHeaderBytes = 48;

enum class MessageType : std::uint8_t {
  kTiles = 1,
  kFrameEnd = 2,
  kClassEnd = 3,
  kCarRefused = 4,  // sent instead of all others (stream/car_refusal.hpp)
  kObjects = 5,     // (stream/objects.hpp)
  kReceptions = 6,  // (stream/receptions.hpp)
};

// Bits of Header::flags.
inline constexpr std::uint8_t kFlagTimedOut = 0x01;   // closed by timeout, not by its sensors
inline constexpr std::uint8_t kFlagBayes = 0x02;      // fused by the rule `bayes`, not `hits_win`
inline constexpr std::uint8_t kFlagClasses = 0x04;    // the frame has messages of classes
inline constexpr std::uint8_t kFlagNoIndexes = 0x08;  // the frame has no tiles of occupancy indexes
inline constexpr std::uint8_t kFlagObjects = 0x10;    // the frame has messages of objects
inline constexpr std::uint8_t kFlagReceptions = 0x20;  // the frame has messages of receptions

struct Header {
  MessageType type = MessageType::kTiles;
  std::uint8_t flags = 0;
  std::uint32_t sequence = 0;  // over messages of all types, wraps; its low half is the E2E counter
  std::uint32_t frame_number = 0;  // wraps
  std::uint64_t closed_us = 0;     // when the frame closed, by the target's clock
  std::uint32_t vehicle_id = 0;    // CRC-32 of the compiled car file
  std::uint8_t sensor_count = 0;
  std::uint8_t complete_sensors = 0;  // bit i: sensor i has delivered its whole scan
  std::uint8_t partial_sensors = 0;   // bit i: sensor i has delivered a part of it
  std::uint32_t points_used = 0;      // scan points of this frame with the outcome kUsed
  std::uint32_t points_other = 0;     // scan points of this frame with any other outcome
  std::uint32_t packets_fused = 0;    // of this frame
  std::uint32_t packets_dropped = 0;  // datagrams dropped since start, for any cause
  std::uint32_t run_number = 0;       // identifies the target's run; differs after each start

  // True if any sensor took part.
  [[nodiscard]] constexpr bool has_evidence() const {
    return (complete_sensors | partial_sensors) != 0;
  }
  // Which grids the frame has.
  [[nodiscard]] constexpr bool has_classes() const { return (flags & kFlagClasses) != 0; }
  [[nodiscard]] constexpr bool has_indexes() const { return (flags & kFlagNoIndexes) == 0; }
  // True if the frame has a list of objects, even an empty one.
  [[nodiscard]] constexpr bool has_objects() const { return (flags & kFlagObjects) != 0; }
  [[nodiscard]] constexpr bool has_receptions() const { return (flags & kFlagReceptions) != 0; }
};

// Stage times on the target, in stopwatch ticks. FrameEnd::stopwatch_hz is their rate.
struct StageTicks {
  std::uint32_t fuse = 0;     // decode, transform to beams, carve, store hits: sum over the packets
  std::uint32_t mark = 0;     // apply hits, merge slices
  std::uint32_t publish = 0;  // find known tiles, encode, hash, send, clear
  std::uint32_t perceive = 0;  // place slices in the window, update its masses, classify
};
inline constexpr std::size_t kStageCount = 4;

// The last message of a frame.
struct FrameEnd {
  std::uint32_t tiles_sent = 0;
  std::uint32_t tiles_lost = 0;  // known but not sent: the network accepted no message
  std::uint32_t grid_crc = 0;    // of all known tiles, sent or not (stream/grid_hash.hpp)
  std::uint64_t opened_us = 0;   // when the frame opened
  std::uint32_t stopwatch_hz = 0;
  StageTicks ticks{};                  // publish is the time of the previous frame
  std::uint32_t stack_used_bytes = 0;  // maximum since start
  std::array<std::uint32_t, vehicle::kFateCount> fates{};  // scan points of this frame by outcome
  std::array<std::uint32_t, intake::kPacketDropCount> packet_drops{};  // since start
  std::uint8_t link_counter_count = 0;
  LinkCounters link_counters{};  // since start
  std::array<intake::SensorReport, vehicle::kMaxSensors>
      sensors{};  // the first Header::sensor_count
  // Bitmaps of the sectors around the vehicle. Bit i of `unwatched`: no sensor watches sector i.
  // Bit i of `blocked`: some sensor is blocked there. Empty if an older target sent the message.
  std::optional<std::uint64_t> unwatched{};
  std::optional<std::uint64_t> blocked{};
  // Chip temperature in tenths of a degree Celsius, or hal::kTemperatureNotKnown. Empty if an older
  // target sent the message. Sent only together with `blocked`.
  std::optional<std::int16_t> temperature_dc{};
};

// The counters of one component, found by name (stream/target_state.hpp). Empty if the sender, a PC
// or an older target, does not send them.
template <typename Counts>
[[nodiscard]] std::optional<Counts> counts_of(const FrameEnd& end) {
  return get<Counts>(end.link_counters, end.link_counter_count);
}

// Why a message could not be read.
enum class ReadStatus : std::uint8_t { kOk, kTooShort, kInconsistent };

// Each function writes one part and returns the number of bytes written, or 0 if the buffer is too
// small.
std::size_t write_header(const Header& header, std::span<std::byte> buffer);
std::size_t write_frame_end(const FrameEnd& end, std::uint8_t sensor_count,
                            std::span<std::byte> buffer);

// True if a protected message is the last of its frame.
[[nodiscard]] constexpr bool ends_frame(std::span<const std::byte> message) {
  return message.size() > protection::kProtectionBytes &&
         message[protection::kProtectionBytes] == static_cast<std::byte>(MessageType::kFrameEnd);
}

// Replaces the sequence number in a written header.
void set_sequence(std::span<std::byte, kHeaderBytes> header, std::uint32_t sequence);

// Reads the header; `body` becomes the bytes after it. Returns kOk or kTooShort.
[[nodiscard]] ReadStatus read_header(std::span<const std::byte> content, Header& header,
                                     std::span<const std::byte>& body);

// Returns kOk, kTooShort, or kInconsistent if a count is impossible.
[[nodiscard]] ReadStatus read_frame_end(std::span<const std::byte> body, std::uint8_t sensor_count,
                                        FrameEnd& end);

}  // namespace iog::stream
