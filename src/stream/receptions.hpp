// The messages that list the datagrams received in a frame and when each one arrived (docs/spec.md
// 3.13). If the sensors and the pose source have different clocks, a PC needs the reception times
// to reproduce the classes. The list of a frame is sent in parts, with one message per part.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "stream/message.hpp"

namespace iog::stream {

// A datagram from an allow-listed sender to a sensor port or to the pose port.
struct Reception {
  std::uint16_t port = 0;             // UDP destination port
  bool was_left = false;              // sensor datagram shed because the target is too slow
  std::uint32_t key = 0;              // result of key_of() for its payload
  std::uint32_t before_close_us = 0;  // time from reception to the frame's end (Header::closed_us)
  friend constexpr bool operator==(const Reception&, const Reception&) = default;
};

// Returns the CRC-32 of the first and last 64 bytes of a payload. If the payload has at most 128
// bytes, the CRC covers the entire payload. The first or last bytes differ from one datagram of a
// sensor to the next because they contain a timestamp, a sequence number or measurements.
[[nodiscard]] std::uint32_t key_of(std::span<const std::byte> payload);

inline constexpr std::size_t kReceptionsHeaderBytes = 16;
inline constexpr std::size_t kMaxReceptionsOfAPart = 100;
inline constexpr std::size_t kMaxReceptionParts = 13;
// The maximum number of receptions. A frame stores fewer packets and poses than this.
inline constexpr std::size_t kMaxReceptions = kMaxReceptionsOfAPart * kMaxReceptionParts;

// The fields that are the same in all parts of a list.
struct ReceptionsHeader {
  std::uint16_t receptions = 0;  // number of receptions in the frame, at most kMaxReceptions
  std::uint8_t parts = 1;        // 1 to kMaxReceptionParts; 1 if the list is empty
  std::uint32_t not_listed = 0;  // number of datagrams received after the list was full
  friend constexpr bool operator==(const ReceptionsHeader&, const ReceptionsHeader&) = default;
};

// Returns the number of messages needed for a list of this length.
[[nodiscard]] constexpr std::size_t reception_parts_of(std::size_t receptions) {
  return receptions == 0 ? 1 : (receptions + kMaxReceptionsOfAPart - 1) / kMaxReceptionsOfAPart;
}

// Writes one part. Requires part < reception_parts_of(list.size()). Returns the number of bytes
// written, or 0 if the buffer is too small.
std::size_t write_receptions(std::span<const Reception> list, std::uint32_t not_listed,
                             std::size_t part, std::span<std::byte> buffer);

struct ReceptionPart {
  ReceptionsHeader header{};
  std::uint8_t part = 0;
  std::uint8_t count = 0;  // number of records
  std::array<Reception, kMaxReceptionsOfAPart> records{};

  [[nodiscard]] constexpr std::span<const Reception> all() const {
    return std::span(records).first(count);
  }
};

// Reads one part. Skips fields that a later version may append. Returns kOk, kTooShort or
// kInconsistent. A part is inconsistent in any of these cases:
//   * The part number is not less than the number of parts.
//   * The number of receptions is wrong for this part.
//   * A record is truncated, or the times decrease.
[[nodiscard]] ReadStatus read_receptions(std::span<const std::byte> body, ReceptionPart& part);

}  // namespace iog::stream
