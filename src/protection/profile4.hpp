// AUTOSAR E2E Profile 4 (PRS_E2EProtocol, section "Specification of E2E Profile 4"). The profile
// adds a 12-byte big-endian header to the data that it protects.
//
//    0  u16 length of the data, including this header
//    2  u16 counter, + 1 for each message, wraps from 0xFFFF to 0
//    4  u32 data id: unique in the vehicle, reveals misrouted messages
//    8  u32 CRC-32/P4 over all data except these four bytes
//
// The counter starts at 0 because receivers expect 0 in the first message. A receiver that starts
// after the sender reports kWrongSequence once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "checksum/crc32.hpp"

namespace iog::protection {

inline constexpr std::size_t kProfile4HeaderBytes = 12;

struct Profile4 {
  std::uint32_t data_id;
  std::size_t offset_bytes;         // of the header within the data, a multiple of 4; 8 for SOME/IP
  std::uint16_t max_delta_counter;  // the maximum counter step that is reported as kOkSomeLost
};

// The values are the same as in E2E_P04CheckStatusType.
enum class CheckStatus : std::uint8_t {
  kOk = 0x00,             // valid; next message of its sender
  kNoNewData = 0x01,      // no message received
  kError = 0x07,          // invalid: wrong CRC, length or data id
  kRepeated = 0x08,       // valid; same counter as the previous message
  kOkSomeLost = 0x20,     // valid; counter at most max_delta_counter ahead
  kWrongSequence = 0x40,  // valid; counter farther ahead or behind
};

// Returns true if the data may be used.
[[nodiscard]] constexpr bool is_usable(CheckStatus status) {
  return status == CheckStatus::kOk || status == CheckStatus::kOkSomeLost;
}

// The CRC remainder of the last Crc32P4::kPartBytes bytes of the data, if the caller already knows
// it. In this case, these bytes are not read again.
using TailRemainder = std::optional<std::uint32_t>;

class Profile4Protector {
 public:
  constexpr explicit Profile4Protector(const Profile4& profile) : profile_{profile} {}

  // Fills in the header. `data` includes the header at the profile's offset and is at most 0xFFFF
  // bytes long. The tail must begin after the header.
  void protect(std::span<std::byte> data, TailRemainder tail = {});

 private:
  Profile4 profile_;
  std::uint16_t counter_ = 0;
};

class Profile4Checker {
 public:
  constexpr explicit Profile4Checker(const Profile4& profile) : profile_{profile} {}

  // Checks a message, which may contain any bytes. As in the standard, every valid message updates
  // the counter, so the next message after a wrong sequence is accepted again. The caller must
  // therefore also detect old messages by their content.
  [[nodiscard]] CheckStatus check(std::span<const std::byte> data);

  // Returns the counter step between the last two valid messages. The number of lost messages is
  // this step minus 1.
  [[nodiscard]] std::uint16_t delta_counter() const { return delta_counter_; }

 private:
  Profile4 profile_;
  std::uint16_t counter_ = 0xFFFF;
  std::uint16_t delta_counter_ = 0;
};

}  // namespace iog::protection
