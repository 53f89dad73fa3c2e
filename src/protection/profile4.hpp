// AUTOSAR E2E Profile 4 (PRS_E2EProtocol, section "Specification of E2E Profile 4"): 12 bytes of
// header somewhere in the data that they protect, big endian.
//
//    0  u16 length of the data, this header included
//    2  u16 counter, + 1 for each message, wraps from 0xFFFF to 0
//    4  u32 data id: unique in the vehicle, against messages that went astray
//    8  u32 CRC-32/P4 over all the data but these four bytes
//
// The counter starts at 0, and that is what a receiver expects of the first message. A receiver
// that joins late therefore finds a wrong sequence once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::protection {

inline constexpr std::size_t kProfile4HeaderBytes = 12;

struct Profile4 {
  std::uint32_t data_id;
  std::size_t offset_bytes;         // of the header in the data; 8 for SOME/IP
  std::uint16_t max_delta_counter;  // counters may advance by this much and count as "some lost"
};

// The values are those of E2E_P04CheckStatusType.
enum class CheckStatus : std::uint8_t {
  kOk = 0x00,             // whole, and the next of its sender
  kNoNewData = 0x01,      // nothing has been received
  kError = 0x07,          // not whole: wrong CRC, length or data id
  kRepeated = 0x08,       // whole, and the same as before
  kOkSomeLost = 0x20,     // whole, and not more than max_delta_counter ahead
  kWrongSequence = 0x40,  // whole, and farther ahead, or behind
};

// Whether the data may be used.
[[nodiscard]] constexpr bool is_usable(CheckStatus status) {
  return status == CheckStatus::kOk || status == CheckStatus::kOkSomeLost;
}

class Profile4Protector {
 public:
  constexpr explicit Profile4Protector(const Profile4& profile) : profile_{profile} {}

  // Fills in the header. `data` has room for it at the profile's offset and is at most 0xFFFF long.
  void protect(std::span<std::byte> data);

 private:
  Profile4 profile_;
  std::uint16_t counter_ = 0;
};

class Profile4Checker {
 public:
  constexpr explicit Profile4Checker(const Profile4& profile) : profile_{profile} {}

  // Any bytes may come. As in the standard, every whole message moves the counter. So after a wrong
  // sequence the next message is fine again, and an old message must be recognised by its content,
  // too.
  [[nodiscard]] CheckStatus check(std::span<const std::byte> data);

  // How far the last whole message was ahead of the one before it. One less is the number of lost
  // messages.
  [[nodiscard]] std::uint16_t delta_counter() const { return delta_counter_; }

 private:
  Profile4 profile_;
  std::uint16_t counter_ = 0xFFFF;
  std::uint16_t delta_counter_ = 0;
};

}  // namespace iog::protection
