// The content of the messages that carry a grid, behind what protects them (stream/channel.hpp):
// big endian, documented byte by byte in docs/spec.md.
//
// Every content begins with the same header, which says how long it is and what follows. A receiver
// skips header bytes beyond those it knows and drops message types, encodings and storages that it
// does not know; so fields and encodings can be added. Tiles are in stream/tiles.hpp.
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
  kCarRefused = 4,  // instead of all others (stream/car_refusal.hpp)
  kObjects = 5,     // (stream/objects.hpp)
  kReceptions = 6,  // (stream/receptions.hpp)
};

// Bits of Header::flags.
inline constexpr std::uint8_t kFlagTimedOut = 0x01;    // closed by time, not by its sensors
inline constexpr std::uint8_t kFlagBayes = 0x02;       // fused by the rule bayes, not hits_win
inline constexpr std::uint8_t kFlagClasses = 0x04;     // the frame has messages of classes
inline constexpr std::uint8_t kFlagNoIndexes = 0x08;   // and no tiles of occupancy indexes
inline constexpr std::uint8_t kFlagObjects = 0x10;     // the frame has messages of objects
inline constexpr std::uint8_t kFlagReceptions = 0x20;  // and of what it has received

struct Header {
  MessageType type = MessageType::kTiles;
  std::uint8_t flags = 0;
  std::uint32_t sequence = 0;      // of messages of any type, wraps; low half: the E2E counter
  std::uint32_t frame_number = 0;  // wraps
  std::uint64_t closed_us = 0;     // when the frame closed, by the target's clock
  std::uint32_t vehicle_id = 0;    // CRC-32 of the vehicle's compiled description
  std::uint8_t sensor_count = 0;
  std::uint8_t complete_sensors = 0;  // bit i: sensor i has delivered its whole scan
  std::uint8_t partial_sensors = 0;   // bit i: sensor i has delivered a part of it
  std::uint32_t points_used = 0;      // scan points of this frame that carved and marked
  std::uint32_t points_other = 0;     // scan points of this frame with any other fate
  std::uint32_t packets_fused = 0;    // of this frame
  std::uint32_t packets_dropped = 0;  // datagrams dropped since start, whatever the cause
  std::uint32_t run_number = 0;       // of the target: another one after each of its starts

  // Whether any sensor took part.
  [[nodiscard]] constexpr bool has_evidence() const {
    return (complete_sensors | partial_sensors) != 0;
  }
  // Which grids the frame has messages of.
  [[nodiscard]] constexpr bool has_classes() const { return (flags & kFlagClasses) != 0; }
  [[nodiscard]] constexpr bool has_indexes() const { return (flags & kFlagNoIndexes) == 0; }
  // Whether the frame has messages of objects. There is one also if it has no object.
  [[nodiscard]] constexpr bool has_objects() const { return (flags & kFlagObjects) != 0; }
  [[nodiscard]] constexpr bool has_receptions() const { return (flags & kFlagReceptions) != 0; }
};

// Time on the target, in ticks of a stopwatch whose rate is in the message.
struct StageTicks {
  std::uint32_t fuse = 0;      // decode, to beams, carve, remember marks: sum over the packets
  std::uint32_t mark = 0;      // apply the marks, join slices
  std::uint32_t publish = 0;   // find the known tiles, encode, hash, send, clear
  std::uint32_t perceive = 0;  // place slices in the window, update its masses, decide
};
inline constexpr std::size_t kStageCount = 4;

// The last message of a frame.
struct FrameEnd {
  std::uint32_t tiles_sent = 0;
  std::uint32_t tiles_lost = 0;  // known, but the network took no message
  std::uint32_t grid_crc = 0;    // of all known tiles, sent or not (stream/grid_hash.hpp)
  std::uint64_t opened_us = 0;   // when the frame opened
  std::uint32_t stopwatch_hz = 0;
  StageTicks ticks{};                                      // publish: that of the frame before
  std::uint32_t stack_used_bytes = 0;                      // deepest so far
  std::array<std::uint32_t, vehicle::kFateCount> fates{};  // scan points of this frame
  std::array<std::uint32_t, intake::kPacketDropCount> packet_drops{};  // since start
  std::uint8_t link_counter_count = 0;
  LinkCounters link_counters{};                                      // since start
  std::array<intake::SensorReport, vehicle::kMaxSensors> sensors{};  // Header::sensor_count of them
  // Bit i, sector i around the vehicle: no sensor watches it; some sensor is blocked there. Empty
  // from an older target.
  std::optional<std::uint64_t> unwatched{};
  std::optional<std::uint64_t> blocked{};
  // Of the chip, in tenths of a degree Celsius, or hal::kTemperatureNotKnown. Empty of an older
  // target. Only behind `blocked`.
  std::optional<std::int16_t> temperature_dc{};
};

// Whatever somebody counts who says the names (stream/target_state.hpp). Empty if the target does
// not say it: a PC, or an older one.
template <typename Counts>
[[nodiscard]] std::optional<Counts> counts_of(const FrameEnd& end) {
  return get<Counts>(end.link_counters, end.link_counter_count);
}

// Why a content could not be read.
enum class ReadStatus : std::uint8_t { kOk, kTooShort, kInconsistent };

// Each writes one part and returns the bytes written, 0 if the buffer is too small.
std::size_t write_header(const Header& header, std::span<std::byte> buffer);
std::size_t write_frame_end(const FrameEnd& end, std::uint8_t sensor_count,
                            std::span<std::byte> buffer);

// Whether a protected message is the last one of its frame.
[[nodiscard]] constexpr bool ends_frame(std::span<const std::byte> message) {
  return message.size() > protection::kProtectionBytes &&
         message[protection::kProtectionBytes] == static_cast<std::byte>(MessageType::kFrameEnd);
}

// Changes one thing in a header that has been written.
void set_sequence(std::span<std::byte, kHeaderBytes> header, std::uint32_t sequence);

// Reads the header; `body` becomes what follows it. kOk or kTooShort.
[[nodiscard]] ReadStatus read_header(std::span<const std::byte> content, Header& header,
                                     std::span<const std::byte>& body);

// kOk, kTooShort, or kInconsistent where it counts more than can be.
[[nodiscard]] ReadStatus read_frame_end(std::span<const std::byte> body, std::uint8_t sensor_count,
                                        FrameEnd& end);

}  // namespace iog::stream
