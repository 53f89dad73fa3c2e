// A buffer descriptor of the GEM's DMA with addresses of 64 bits: four words (UG1085, "Receive
// buffer descriptor entry", "Transmit buffer descriptor entry").
#pragma once

#include <cstdint>

#include "machine.hpp"

namespace iog::zcu102 {

struct Descriptor {
  std::uint32_t address;  // low half; when receiving, with wrap and owner in its lowest bits
  std::uint32_t control;
  std::uint32_t address_high;
  std::uint32_t unused;
};
static_assert(sizeof(Descriptor) == 16);

namespace receive_flag {
// In `address`.
inline constexpr std::uint32_t kOurs = 1u << 0;
inline constexpr std::uint32_t kWrap = 1u << 1;
// In `control`.
inline constexpr std::uint32_t kLength = 0x1fff;
inline constexpr std::uint32_t kFirst = 1u << 14;
inline constexpr std::uint32_t kLast = 1u << 15;
}  // namespace receive_flag

namespace transmit_flag {
// In `control`.
inline constexpr std::uint32_t kLength = 0x3fff;
inline constexpr std::uint32_t kLast = 1u << 15;
inline constexpr std::uint32_t kWrap = 1u << 30;
inline constexpr std::uint32_t kOurs = 1u << 31;
}  // namespace transmit_flag

inline std::uint32_t low_half(std::uint64_t address) { return static_cast<std::uint32_t>(address); }
inline std::uint32_t high_half(std::uint64_t address) {
  return static_cast<std::uint32_t>(address >> 32);
}

// The only way in which a descriptor changes hands: everything that was stored before reaches
// memory, then the word with the owner bit is stored, last of all. Code that wakes the controller
// afterwards puts a barrier once more, so that it finds the bit.
inline void hand_over(std::uint32_t& word, std::uint32_t with_owner) {
  machine::barrier();
  machine::store(word, with_owner);
}

}  // namespace iog::zcu102
