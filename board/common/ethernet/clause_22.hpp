// Defines the registers of a PHY according to IEEE 802.3 clause 22, and the link that these
// registers describe.
#pragma once

#include <cstdint>

namespace iog::board {

struct Link {
  enum class Speed : std::uint8_t { k10, k100, k1000 };
  bool up = false;
  Speed speed = Speed::k100;
  bool full_duplex = true;

  friend bool operator==(const Link&, const Link&) = default;
};

namespace phy {

inline constexpr unsigned kBasicControl = 0;
inline constexpr unsigned kBasicStatus = 1;
inline constexpr unsigned kIdHigh = 2;
inline constexpr unsigned kIdLow = 3;
inline constexpr unsigned kAdvertised = 4;
inline constexpr unsigned kPartnerAbility = 5;
inline constexpr unsigned kGigabitControl = 9;
inline constexpr unsigned kGigabitStatus = 10;

inline constexpr std::uint16_t kStatusLinkUp = 1u << 2;
inline constexpr std::uint16_t kStatusNegotiated = 1u << 5;
inline constexpr std::uint16_t kGigabitFull = 1u << 9;
inline constexpr std::uint16_t kGigabitHalf = 1u << 8;
inline constexpr std::uint16_t kNegotiateAnew = 1u << 12 | 1u << 9;

// Returns the best mode that both ends support, according to the four registers (802.3 annex
// 28B.3). If the partner does not negotiate, the result is 10 Mbit/s half duplex.
constexpr Link resolve(std::uint16_t advertised, std::uint16_t partner,
                       std::uint16_t gigabit_control, std::uint16_t gigabit_status) {
  // The partner's gigabit bits are two positions above our own.
  const unsigned gigabit = gigabit_control & (static_cast<unsigned>(gigabit_status) >> 2);
  const unsigned common = advertised & partner;
  if ((gigabit & (1u << 9 | 1u << 8)) != 0) {
    return {.up = true, .speed = Link::Speed::k1000, .full_duplex = (gigabit & 1u << 9) != 0};
  }
  if ((common & (1u << 8 | 1u << 7)) != 0) {
    return {.up = true, .speed = Link::Speed::k100, .full_duplex = (common & 1u << 8) != 0};
  }
  return {.up = true, .speed = Link::Speed::k10, .full_duplex = (common & 1u << 6) != 0};
}

// The PHY on the management bus.
struct Identity {
  static constexpr std::uint32_t kNobody = 0xffff'ffff;

  unsigned address = 0;
  std::uint32_t id = kNobody;  // both identifier registers

  bool answers() const { return id != kNobody; }
};

}  // namespace phy
}  // namespace iog::board
