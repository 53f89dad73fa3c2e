// The messages that list which datagrams a target received in a frame, and when (docs/spec.md
// 3.13). A PC uses them to reproduce the classes if sensors and poses have different clocks. A
// frame's list is sent in parts, one message each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "stream/message.hpp"

namespace iog::stream {

// A datagram to the port of a sensor or of the poses, from an allow-listed sender.
struct Reception {
  std::uint16_t port = 0;             // UDP destination port
  bool was_left = false;              // sensor datagram that was shed for lack of time
  std::uint32_t key = 0;              // key_of() its payload
  std::uint32_t before_close_us = 0;  // from reception to the end of the frame (Header::closed_us)
  friend constexpr bool operator==(const Reception&, const Reception&) = default;
};

// CRC-32 of the first and last 64 bytes of a payload, or of the whole payload if it is shorter.
// Time, number or measurements there distinguish the datagrams of a sensor.
[[nodiscard]] std::uint32_t key_of(std::span<const std::byte> payload);

inline constexpr std::size_t kReceptionsHeaderBytes = 16;
inline constexpr std::size_t kMaxReceptionsOfAPart = 100;
inline constexpr std::size_t kMaxReceptionParts = 13;
// More than the packets and poses stored for a frame.
inline constexpr std::size_t kMaxReceptions = kMaxReceptionsOfAPart * kMaxReceptionParts;

// The fields common to all parts of a list.
struct ReceptionsHeader {
  std::uint16_t receptions = 0;  // in the frame, at most kMaxReceptions
  std::uint8_t parts = 1;        // 1 ... kMaxReceptionParts; 1 for an empty list
  std::uint32_t not_listed = 0;  // received after the list was full
  friend constexpr bool operator==(const ReceptionsHeader&, const ReceptionsHeader&) = default;
};

// The number of messages for a list of this length.
[[nodiscard]] constexpr std::size_t reception_parts_of(std::size_t receptions) {
  return receptions == 0 ? 1 : (receptions + kMaxReceptionsOfAPart - 1) / kMaxReceptionsOfAPart;
}

// Writes one part; `part` is less than reception_parts_of(list.size()). Returns the number of bytes
// written, or 0 if the buffer is too small.
std::size_t write_receptions(std::span<const Reception> list, std::uint32_t not_listed,
                             std::size_t part, std::span<std::byte> buffer);

struct ReceptionPart {
  ReceptionsHeader header{};
  std::uint8_t part = 0;
  std::uint8_t count = 0;  // of records
  std::array<Reception, kMaxReceptionsOfAPart> records{};

  [[nodiscard]] constexpr std::span<const Reception> all() const {
    return std::span(records).first(count);
  }
};

// Skips fields that a later version appends. Returns kOk, kTooShort or kInconsistent. kInconsistent
// means one of: a part number beyond the number of parts; a wrong number of receptions for this
// part; a truncated record; times that decrease.
[[nodiscard]] ReadStatus read_receptions(std::span<const std::byte> body, ReceptionPart& part);

}  // namespace iog::stream
