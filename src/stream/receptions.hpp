// The messages of what a target has received in a frame, and when (docs/spec.md 3.13): with them a
// PC repeats its classes where sensors' clocks are not those of the poses. The list of a frame goes
// in parts, each a message.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "stream/message.hpp"

namespace iog::stream {

// A datagram for the port of a sensor or of the poses, from a sender that may send it.
struct Reception {
  std::uint16_t port = 0;             // UDP, to which it went
  bool was_left = false;              // for want of time; of a sensor
  std::uint32_t key = 0;              // key_of() its payload
  std::uint32_t before_close_us = 0;  // from when it was taken to the end of the frame (Header)
  friend constexpr bool operator==(const Reception&, const Reception&) = default;
};

// The CRC-32 of a payload's first and last 64 bytes, of a shorter one of all of it. Two datagrams
// of one sensor differ in them: time, number or measurements are there.
[[nodiscard]] std::uint32_t key_of(std::span<const std::byte> payload);

inline constexpr std::size_t kReceptionsHeaderBytes = 16;
inline constexpr std::size_t kMaxReceptionsOfAPart = 100;
inline constexpr std::size_t kMaxReceptionParts = 13;
// More than a frame keeps packets and poses.
inline constexpr std::size_t kMaxReceptions = kMaxReceptionsOfAPart * kMaxReceptionParts;

// What every part of a list says.
struct ReceptionsHeader {
  std::uint16_t receptions = 0;  // in the frame, at most kMaxReceptions
  std::uint8_t parts = 1;        // 1 ... kMaxReceptionParts, also without receptions
  std::uint32_t not_listed = 0;  // received behind the list's last one
  friend constexpr bool operator==(const ReceptionsHeader&, const ReceptionsHeader&) = default;
};

// How many messages a list of so many takes.
[[nodiscard]] constexpr std::size_t reception_parts_of(std::size_t receptions) {
  return receptions == 0 ? 1 : (receptions + kMaxReceptionsOfAPart - 1) / kMaxReceptionsOfAPart;
}

// Writes a part of the list, below reception_parts_of(list.size()). Returns the bytes written, 0 if
// the buffer is too small.
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

// Fields of a later version behind ours are skipped. kOk; kTooShort; or kInconsistent: a part
// beyond its parts, another number of receptions than this part has, bytes that are no whole ones,
// times that go back.
[[nodiscard]] ReadStatus read_receptions(std::span<const std::byte> body, ReceptionPart& part);

}  // namespace iog::stream
