// Defines the content of grid messages. The protection header is not part of this content
// (stream/channel.hpp). All values are big-endian. The meaning of each byte is documented in
// docs/spec.md.
//
// Every message starts with the same header, which contains its own length and the message type. A
// receiver skips unknown header bytes, and drops messages with unknown types, encodings or storage
// formats. Later versions can therefore add fields and encodings.
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
  kCarRefused = 4,  // sent instead of all other messages (stream/car_refusal.hpp)
  kObjects = 5,     // defined in stream/objects.hpp
  kReceptions = 6,  // defined in stream/receptions.hpp
};

// The bits of Header::flags.
inline constexpr std::uint8_t kFlagTimedOut = 0x01;    // closed by a timeout, not by its sensors
inline constexpr std::uint8_t kFlagBayes = 0x02;       // fusion rule `bayes` instead of `hits_win`
inline constexpr std::uint8_t kFlagClasses = 0x04;     // the frame has class messages
inline constexpr std::uint8_t kFlagNoIndexes = 0x08;   // the frame has no occupancy index tiles
inline constexpr std::uint8_t kFlagObjects = 0x10;     // the frame has object messages
inline constexpr std::uint8_t kFlagReceptions = 0x20;  // the frame has reception messages

struct Header {
  MessageType type = MessageType::kTiles;
  std::uint8_t flags = 0;
  std::uint32_t sequence = 0;      // counts all messages and wraps; its low half is the E2E counter
  std::uint32_t frame_number = 0;  // wraps
  std::uint64_t closed_us = 0;     // time at which the frame closed, by the target's clock
  std::uint32_t vehicle_id = 0;    // CRC-32 of the compiled car file
  std::uint8_t sensor_count = 0;
  std::uint8_t complete_sensors = 0;  // bit i is set if sensor i has delivered its whole scan
  std::uint8_t partial_sensors = 0;   // bit i is set if sensor i has delivered a part of its scan
  std::uint32_t points_used = 0;      // scan points of this frame whose outcome is kUsed
  std::uint32_t points_other = 0;     // scan points of this frame with any other outcome
  std::uint32_t packets_fused = 0;    // packets fused in this frame
  std::uint32_t packets_dropped = 0;  // datagrams dropped for any cause since start
  std::uint32_t run_number = 0;       // identifies the target's run; different after each start
  // For index tiles, epsilon is sent in the TilesHeader instead.
  std::uint16_t epsilon_e5 = vehicle::kUsualEpsilonE5;

  // Returns true if any sensor contributed to the frame.
  [[nodiscard]] constexpr bool has_evidence() const {
    return (complete_sensors | partial_sensors) != 0;
  }
  // The following two functions return true if the frame contains the grid that they name.
  [[nodiscard]] constexpr bool has_classes() const { return (flags & kFlagClasses) != 0; }
  [[nodiscard]] constexpr bool has_indexes() const { return (flags & kFlagNoIndexes) == 0; }
  // Returns true if the frame has an object list, which may be empty.
  [[nodiscard]] constexpr bool has_objects() const { return (flags & kFlagObjects) != 0; }
  [[nodiscard]] constexpr bool has_receptions() const { return (flags & kFlagReceptions) != 0; }
};

// The durations of the processing stages on the target, in stopwatch ticks. The tick rate is
// FrameEnd::stopwatch_hz.
struct StageTicks {
  std::uint32_t fuse = 0;     // decode, transform to beams, carve, store hits; sum over all packets
  std::uint32_t mark = 0;     // apply hits, merge slices
  std::uint32_t publish = 0;  // find known tiles, encode, hash, send, clear
  std::uint32_t perceive = 0;  // place slices in the window, update masses, classify
};
inline constexpr std::size_t kStageCount = 4;

// The last message of a frame.
struct FrameEnd {
  std::uint32_t tiles_sent = 0;
  std::uint32_t tiles_lost = 0;  // known tiles not sent because the network accepted no message
  std::uint32_t grid_crc = 0;    // CRC of all known tiles, even if not sent (stream/grid_hash.hpp)
  std::uint64_t opened_us = 0;   // time at which the frame opened
  std::uint32_t stopwatch_hz = 0;
  StageTicks ticks{};                  // `publish` belongs to the previous frame
  std::uint32_t stack_used_bytes = 0;  // maximum since start
  std::array<std::uint32_t, vehicle::kFateCount> fates{};  // scan points of this frame by outcome
  std::array<std::uint32_t, intake::kPacketDropCount> packet_drops{};  // drops by cause since start
  std::uint8_t link_counter_count = 0;
  LinkCounters link_counters{};  // counted since start
  std::array<intake::SensorReport, vehicle::kMaxSensors>
      sensors{};  // only the first Header::sensor_count are used
  // Bitmaps of the sectors around the vehicle. Bit i of `unwatched` is set if no sensor watches
  // sector i. Bit i of `blocked` is set if at least one sensor is blocked in sector i.
  std::uint64_t unwatched = 0;
  std::uint64_t blocked = 0;
  // The chip temperature in tenths of a degree Celsius, or -0x8000 if the temperature is unknown
  // (hal/thermometer.hpp).
  std::int16_t temperature_dc = -0x8000;
};

// Looks up a component's counters by name (stream/target_state.hpp). Returns std::nullopt if the
// sender is a PC, because a PC does not send these counters.
template <typename Counts>
[[nodiscard]] std::optional<Counts> counts_of(const FrameEnd& end) {
  return get<Counts>(end.link_counters, end.link_counter_count);
}

// The result of reading a message.
enum class ReadStatus : std::uint8_t { kOk, kTooShort, kInconsistent };

// Each of these functions writes one part of a message, and returns the number of bytes written, or
// 0 if the buffer is too small.
std::size_t write_header(const Header& header, std::span<std::byte> buffer);
std::size_t write_frame_end(const FrameEnd& end, std::uint8_t sensor_count,
                            std::span<std::byte> buffer);

// Returns true if a protected message is the last message of its frame.
[[nodiscard]] constexpr bool ends_frame(std::span<const std::byte> message) {
  return message.size() > protection::kProtectionBytes &&
         message[protection::kProtectionBytes] == static_cast<std::byte>(MessageType::kFrameEnd);
}

// Replaces the sequence number in a header that has already been written.
void set_sequence(std::span<std::byte, kHeaderBytes> header, std::uint32_t sequence);

// Reads the header, and sets `body` to the bytes after it. Returns kOk or kTooShort.
[[nodiscard]] ReadStatus read_header(std::span<const std::byte> content, Header& header,
                                     std::span<const std::byte>& body);

// Returns kOk, kTooShort or kInconsistent. `kInconsistent` means that a count is invalid.
[[nodiscard]] ReadStatus read_frame_end(std::span<const std::byte> body, std::uint8_t sensor_count,
                                        FrameEnd& end);

}  // namespace iog::stream
