#include "lidar/velodyne_identity.hpp"

#include <type_traits>

#include "lidar/velodyne_bytes.hpp"

namespace iog::lidar {
namespace {

// A Velodyne format and the bytes that its packets contain.
struct Claim {
  VelodyneCandidate candidate;
  std::uint8_t banks;
  std::uint8_t product;
  std::uint8_t old_product;
};

struct Claims {
  std::size_t count = 0;
  std::array<Claim, kFormatCount> list{};
};

consteval Claims make_claims() {
  Claims claims;
  for_each_format([&]<typename Decoder>(Format format, std::type_identity<Decoder> /*which*/) {
    if constexpr (std::is_base_of_v<VelodynePacket, Decoder>) {
      constexpr VelodyneUnit kUnit = Decoder::unit();
      claims.list[claims.count++] = {
          {format, kUnit.block_ns}, kUnit.banks, kUnit.product, kUnit.old_product};
    }
  });
  return claims;
}
constexpr Claims kClaims = make_claims();

using velodyne::gained;
using velodyne::kHourUs;
using velodyne::kTurn;

// 5 and 20 turns per second, with a margin of an eighth.
constexpr std::uint64_t kLeastEighthsHz = 35;
constexpr std::uint64_t kMostEighthsHz = 180;
// Less than a turn at 20 Hz, so that the azimuth gained in between is unambiguous.
constexpr std::uint32_t kLongestGapUs = 40'000;
// An azimuth is known to 0.01 degrees; over this many the error is small.
constexpr std::uint32_t kEnoughTicks = 200;

// Two banks alternate; a VLS-128 has two more after them.
bool has_flags(std::span<const std::byte> packet) {
  const auto flag = [&](std::size_t block) {
    return velodyne::word_at(packet, block * velodyne::kBlockBytes);
  };
  const std::array<std::uint16_t, 4>& flags = velodyne::kBankFlags;
  const bool is_vls128 = flag(2) == flags[2] && flag(3) == flags[3];
  return flag(0) == flags[0] && (flag(1) != flags[1] || flag(2) == flags[0] || is_vls128);
}

// The formats that the bytes of this packet allow.
VelodyneCandidates candidates_of(const VelodyneLook& look) {
  VelodyneCandidates candidates;
  for (const Claim& claim : std::span(kClaims.list).first(kClaims.count)) {
    const bool has_product =
        look.banks == 2 || look.product == claim.product || look.product == claim.old_product;
    if (claim.banks == look.banks && has_product && candidates.count < candidates.list.size()) {
      candidates.list[candidates.count++] = claim.candidate;
    }
  }
  return candidates;
}

}  // namespace

FormatSet VelodyneIdentity::all() const {
  FormatSet set;
  for (const VelodyneCandidate& candidate : candidates_.all()) {
    set.add(candidate.format);
  }
  return set;
}

// The candidates that can gain this much azimuth.
FormatSet VelodyneIdentity::by_gain(const VelodyneLook& look) const {
  FormatSet set;
  for (const VelodyneCandidate& candidate : candidates_.all()) {
    // Both in 10^-9 of 0.01 degrees, below 2^45.
    const std::uint64_t gain = std::uint64_t{look.gain} * 1'000'000'000;
    const std::uint64_t of_one_hertz = std::uint64_t{look.steps} * candidate.block_ns * kTurn;
    if (8 * gain >= kLeastEighthsHz * of_one_hertz && 8 * gain <= kMostEighthsHz * of_one_hertz) {
      set.add(candidate.format);
    }
  }
  return set.is_empty() ? all() : set;
}

// The candidate with blocks of this duration, to a twelfth; all candidates if there is none.
FormatSet VelodyneIdentity::by_block_time(std::uint64_t block_ns) const {
  for (const VelodyneCandidate& candidate : candidates_.all()) {
    const std::uint64_t of_unit = candidate.block_ns;
    if (12 * block_ns >= 11 * of_unit && 12 * block_ns <= 13 * of_unit) {
      return FormatSet(candidate.format);
    }
  }
  return all();
}

// The products stay below 2^52: 36000 ticks, 40000 us, and at most 200 packets until enough azimuth
// is gained, because packets without a gain are not counted.
void VelodyneIdentity::compare(const VelodyneLook& look) {
  const std::uint32_t forward_us = (look.time_us + kHourUs - last_.time_us) % kHourUs;
  const bool is_reordered = forward_us > kHourUs / 2;
  const std::uint32_t apart_us = is_reordered ? kHourUs - forward_us : forward_us;
  if (apart_us > kLongestGapUs) {
    gain_times_us_ = 0;
    gain_times_blocks_ = 0;
    gain_between_ = 0;
    possible_ = by_gain(look);
    return;
  }
  const VelodyneLook& earlier = is_reordered ? look : last_;
  const VelodyneLook& later = is_reordered ? last_ : look;
  const std::uint32_t between = gained(earlier.azimuth, later.azimuth);
  if (apart_us == 0 || between == 0) {
    return;
  }
  gain_times_us_ += std::uint64_t{earlier.gain} * apart_us;
  gain_times_blocks_ += std::uint64_t{earlier.steps} * between;
  gain_between_ += between;
  if (gain_between_ >= kEnoughTicks) {
    possible_ = by_block_time(gain_times_us_ * 1000 / gain_times_blocks_);
    gain_times_us_ = 0;
    gain_times_blocks_ = 0;
    gain_between_ = 0;
  }
}

FormatSet VelodyneIdentity::add(std::span<const std::byte> packet) {
  if (packet.size() == velodyne::kPacketBytes && has_flags(packet)) {
    return add(look_at(packet.first<velodyne::kPacketBytes>()));
  }
  *this = VelodyneIdentity{};
  return {};
}

FormatSet VelodyneIdentity::add(const VelodyneLook& look) {
  const VelodyneCandidates candidates = candidates_of(look);
  if (candidates.count < 2) {
    *this = VelodyneIdentity{};
    return candidates.count == 0 ? FormatSet() : FormatSet(candidates.list[0].format);
  }
  if (candidates != candidates_) {
    *this = VelodyneIdentity{};
    candidates_ = candidates;
    possible_ = by_gain(look);
  } else {
    compare(look);
  }
  last_ = look;
  return possible_;
}

}  // namespace iog::lidar
