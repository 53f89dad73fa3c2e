#include "lidar/hesai.hpp"

#include <algorithm>

#include "lidar/fingerprint.hpp"

namespace iog::lidar {
namespace {

constexpr std::uint8_t kMaker = 0x42;
constexpr std::uint16_t kBlockFlag = 0xEEFF;
constexpr std::uint16_t kHesaiTurn = HesaiPacket::kTicksPerTurn;
constexpr std::array<std::uint8_t, 4> kSingleModes{0x33, 0x34, 0x37, 0x38};
constexpr std::array<std::uint8_t, 5> kDualModes{0x39, 0x3A, 0x3B, 0x3C, 0x3E};

// Days from 1970-01-01 to a date of the Gregorian calendar. Internally, years begin in March. month
// is 1 to 12; a day past the end of a month counts into the next one.
std::int64_t days_of(std::int64_t year, std::int64_t month, std::int64_t day) {
  const std::int64_t years = month > 2 ? year : year - 1;  // years that begin in March
  const std::int64_t months = month > 2 ? month - 3 : month + 9;
  return 365 * years + years / 4 - years / 100 + years / 400 + (153 * months + 2) / 5 + day -
         719'469;
}

}  // namespace

std::uint8_t HesaiPacket::byte_at(std::size_t offset) const {
  return wire::load_u8(packet_.subspan(offset).first<1>());
}

std::uint16_t HesaiPacket::half_at(std::size_t offset) const {
  return wire::load_le16(packet_.subspan(offset).first<2>());
}

std::uint32_t HesaiPacket::word_at(std::size_t offset) const {
  return wire::load_le32(packet_.subspan(offset).first<4>());
}

DecodeStatus HesaiPacket::read(const HesaiUnit& unit, std::span<const std::byte> datagram,
                               std::span<const LaserCorrection> corrections) {
  *this = HesaiPacket{};
  if (datagram.size() != unit.bytes && datagram.size() != unit.bytes + unit.may_follow_bytes) {
    return DecodeStatus::kWrongLength;
  }
  packet_ = datagram;
  corrections_ = corrections.size() == unit.lasers ? corrections : corrections_;
  const bool begins = unit.header_bytes == 0 ? has_flags_of(unit) : has_header_of(unit);
  if (!begins || byte_at(unit.maker_at) != kMaker || !read_mode(unit)) {
    return DecodeStatus::kWrongType;
  }
  const DecodeStatus status = read_azimuths(unit);
  if (status != DecodeStatus::kOk) {
    return status;
  }
  info_.point_count = static_cast<std::uint32_t>(unit.blocks * unit.lasers);
  read_times(unit);
  const std::uint64_t of_azimuth = fingerprint(packet_.subspan(unit.block_at(0)).first(2));
  const std::uint64_t of_tail = fingerprint(packet_.subspan(unit.mode_at), of_azimuth);
  info_.fingerprint = fingerprint(packet_.subspan(unit.time_at).first(4), of_tail);
  return DecodeStatus::kOk;
}

bool HesaiPacket::has_header_of(const HesaiUnit& unit) const {
  return byte_at(0) == 0xEE && byte_at(1) == 0xFF && byte_at(2) == unit.model[0] &&
         byte_at(3) == unit.model[1] && byte_at(unit.counts_at) == unit.lasers &&
         byte_at(unit.counts_at + 1) == unit.blocks &&
         byte_at(unit.distance_unit_at) == unit.distance_unit_mm;
}

bool HesaiPacket::has_flags_of(const HesaiUnit& unit) const {
  for (std::size_t block = 0; block < unit.blocks; ++block) {
    if (half_at(unit.block_at(block) - unit.flag_bytes) != kBlockFlag) {
      return false;
    }
  }
  return true;
}

bool HesaiPacket::read_mode(const HesaiUnit& unit) {
  const std::uint8_t mode = byte_at(unit.mode_at);
  is_dual_ = std::ranges::find(kDualModes, mode) != kDualModes.end();
  return is_dual_ || std::ranges::find(kSingleModes, mode) != kSingleModes.end();
}

// How far the head turns until the next firing, rounded to the nearest tick.
std::uint32_t HesaiPacket::step_by_speed(const HesaiUnit& unit) const {
  constexpr std::uint64_t kMinuteNs = 60'000'000'000;
  const std::uint64_t rpm = half_at(unit.speed_at);
  const auto firing_ns = static_cast<std::uint64_t>(unit.firing_ns);
  return static_cast<std::uint32_t>((rpm * kHesaiTurn * firing_ns + kMinuteNs / 2) / kMinuteNs);
}

DecodeStatus HesaiPacket::read_azimuths(const HesaiUnit& unit) {
  const std::size_t stride = is_dual_ ? 2 : 1;
  std::uint32_t swept = 0;
  std::uint32_t step = unit.blocks > stride ? 0 : step_by_speed(unit);
  if (step > kMaxBlockStepTicks) {
    return DecodeStatus::kWrongAngle;
  }
  for (std::size_t block = 0; block < unit.blocks; ++block) {
    const std::uint16_t azimuth = half_at(unit.block_at(block));
    if (azimuth > kHesaiTurn) {
      return DecodeStatus::kWrongAngle;
    }
    azimuths_[block] = azimuth == kHesaiTurn ? std::uint16_t{0} : azimuth;
    if (block % stride != 0 && azimuths_[block] != azimuths_[block - 1]) {
      return DecodeStatus::kWrongAngle;
    }
    if (block >= stride && block % stride == 0) {
      const std::int32_t gained = azimuths_[block] - azimuths_[block - stride];
      step = static_cast<std::uint32_t>(gained < 0 ? gained + kHesaiTurn : gained);
      if (step > kMaxBlockStepTicks) {
        return DecodeStatus::kWrongAngle;
      }
      swept += step;
    }
  }
  // The wire counts clockwise. So counter-clockwise, the sector begins where the sweep ends.
  swept += step + kSeamTicks;
  const std::uint32_t last = (azimuths_[0] + swept) % kHesaiTurn;
  info_.sector.first_ticks = static_cast<std::uint16_t>((kHesaiTurn - last) % kHesaiTurn);
  info_.sector.width_ticks = static_cast<std::uint16_t>(swept);
  return DecodeStatus::kOk;
}

// The packet's stamp in us since 1970: a UTC second and the microsecond within it. Years below 70
// are in this century, others count from 1900. If the year is 0, the seconds since 1970 follow in 5
// bytes, big endian.
std::uint64_t HesaiPacket::stamp_us(const HesaiUnit& unit) const {
  const auto field = [&](std::size_t i) { return std::int64_t{byte_at(unit.utc_at + i)}; };
  std::int64_t seconds = 0;
  if (field(0) == 0) {
    for (std::size_t i = 1; i < 6; ++i) {
      seconds = seconds << 8 | field(i);
    }
  } else {
    const std::int64_t year = field(0) < 70 ? 2000 + field(0) : 1900 + field(0);
    const std::int64_t month = std::clamp<std::int64_t>(field(1), 1, 12);
    seconds = ((days_of(year, month, field(2)) * 24 + field(3)) * 60 + field(4)) * 60 + field(5);
  }
  return static_cast<std::uint64_t>(seconds) * 1'000'000U + word_at(unit.time_at);
}

void HesaiPacket::read_times(const HesaiUnit& unit) {
  const auto firings = static_cast<std::int64_t>(unit.blocks / (is_dual_ ? 2U : 1U));
  const std::uint64_t stamp = stamp_us(unit);
  const auto at = [stamp](std::int64_t ns) {
    constexpr std::int64_t kSomeUs = 1'000;  // keeps the quotient from being negative
    const std::int64_t us = (ns + kSomeUs * 1'000 + 500) / 1'000 - kSomeUs;
    return stamp + static_cast<std::uint64_t>(us);  // modulo 2^64
  };
  const std::int64_t all_but_one_ns = (firings - 1) * unit.firing_ns;
  const std::int64_t first_block_ns =
      unit.stamped_block_ns - (unit.is_first_stamped ? 0 : all_but_one_ns);
  info_.sweep = {.begin_us = at(first_block_ns + unit.first_laser_ns),
                 .end_us = at(first_block_ns + all_but_one_ns + unit.last_laser_ns),
                 .turns_right = true,
                 .is_of_packet = true};
}

}  // namespace iog::lidar
