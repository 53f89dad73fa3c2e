#include "lidar/points.hpp"

#include "lidar/fingerprint.hpp"
#include "numeric/magnitude.hpp"
#include "wire/byte_reader.hpp"

namespace iog::lidar {
namespace {

// Converts 2^-32 turns to the nearest 1/3,200 degree.
std::int32_t nearest_part(std::int64_t angle) {
  return static_cast<std::int32_t>(
      (angle * PointsPacket::kPartsPerTurn + (std::int64_t{1} << 31)) >> 32);
}

}  // namespace

PointsPacket::Direction PointsPacket::direction_of_place(PointBytes bytes) {
  const numeric::Polar polar =
      numeric::polar_of(signed_at(bytes.subspan<0, 4>()), signed_at(bytes.subspan<4, 4>()),
                        signed_at(bytes.subspan<8, 4>()));
  const auto azimuth = static_cast<std::uint32_t>(nearest_part(polar.azimuth));
  return {.azimuth = azimuth == kPartsPerTurn ? 0 : azimuth,
          .elevation = nearest_part(polar.elevation),
          .range_mm = std::min(polar.range, kMaxRangeMm)};
}

bool PointsPacket::is_place(PointBytes bytes) {
  const auto is_near = [](std::int32_t coordinate) {
    constexpr auto kMost = static_cast<std::int32_t>(kMaxRangeMm);
    return coordinate >= -kMost && coordinate <= kMost;
  };
  return is_near(signed_at(bytes.subspan<0, 4>())) && is_near(signed_at(bytes.subspan<4, 4>())) &&
         is_near(signed_at(bytes.subspan<8, 4>()));
}

bool PointsPacket::is_direction(PointBytes bytes) const {
  constexpr std::int32_t kZenith = 90 * kPartsPerDegree;
  const Direction there = direction_at(bytes);
  const std::uint32_t turned = there.azimuth - sector_begin_;
  const std::uint32_t within = there.azimuth < sector_begin_ ? turned + kPartsPerTurn : turned;
  return there.azimuth < kPartsPerTurn && there.elevation >= -kZenith &&
         there.elevation <= kZenith && there.range_mm <= kMaxRangeMm &&
         (sector_width_ == 0 || within <= sector_width_);
}

DecodeStatus PointsPacket::read_head(std::span<const std::byte> head, bool turns) {
  wire::ByteReader in(head);
  const std::uint32_t magic = in.u32_le();
  const std::uint8_t version = in.u8();
  const std::uint8_t flags = in.u8();
  info_.point_count = in.u16_le();
  info_.scan_number = in.u32_le();
  const std::uint32_t number = in.u16_le();
  const std::uint32_t datagrams = in.u16_le();
  info_.sweep = {.begin_us = in.u64_le(), .is_of_packet = true};
  sector_begin_ = in.u32_le();
  sector_width_ = in.u32_le();
  if (magic != kMagic || version != kVersion || (flags & ~(kArePlaces | kIsShare)) != 0) {
    return DecodeStatus::kWrongType;
  }
  if (sector_begin_ >= kPartsPerTurn || sector_width_ > kPartsPerTurn || number >= datagrams) {
    return DecodeStatus::kWrongAngle;
  }
  are_places_ = (flags & kArePlaces) != 0;
  std::uint32_t begin = sector_begin_;
  std::uint32_t end = begin + sector_width_;
  if ((flags & kIsShare) != 0) {
    const auto share_of = [&](std::uint32_t before) {
      return static_cast<std::uint32_t>(std::uint64_t{sector_width_} * before / datagrams);
    };
    end = begin + share_of(number + 1);
    begin += share_of(number);
  }
  const std::uint32_t first = ticks_of(turns, begin);
  const auto turn = static_cast<std::uint32_t>(ticks_per_turn(turns));
  info_.sector = {.first_ticks = static_cast<std::uint16_t>(first % turn),
                  .width_ticks = static_cast<std::uint16_t>(ticks_of(turns, end) - first)};
  return DecodeStatus::kOk;
}

DecodeStatus PointsPacket::check_points() {
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < count(); ++i) {
    const PointBytes bytes = bytes_at(i);
    const std::uint8_t flags = flags_at(bytes);
    const bool is_there = are_places_ ? is_place(bytes) : is_direction(bytes);
    if (!is_there || (flags & kEcho) == kEcho || (flags & kUnknown) != 0) {
      return DecodeStatus::kWrongPoint;
    }
    last = std::max<std::uint32_t>(last, wire::load_le16(bytes.subspan<12, 2>()));
  }
  info_.sweep.end_us = info_.sweep.begin_us + std::uint64_t{last} * kOffsetUs;
  return DecodeStatus::kOk;
}

DecodeStatus PointsPacket::read(std::span<const std::byte> datagram, const Unit& unit, bool turns) {
  *this = PointsPacket{};
  if (datagram.size() < kHeadBytes || unit.elevations.empty()) {
    return DecodeStatus::kWrongLength;
  }
  const auto head = datagram.first<kHeadBytes>();
  const DecodeStatus status = read_head(head, turns);
  if (status != DecodeStatus::kOk) {
    info_.point_count = 0;
    return status;
  }
  if (info_.point_count > kMostPoints ||
      datagram.size() != kHeadBytes + kPointBytes * std::size_t{info_.point_count}) {
    info_.point_count = 0;
    return DecodeStatus::kWrongLength;
  }
  points_ = datagram.subspan(kHeadBytes);
  layers_ = LayerSearch(unit.elevations);
  info_.fingerprint = fingerprint(head);
  if (!points_.empty()) {
    info_.fingerprint = fingerprint(points_.first<kPointBytes>(), info_.fingerprint);
    info_.fingerprint = fingerprint(points_.last<kPointBytes>(), info_.fingerprint);
  }
  return check_points();
}

}  // namespace iog::lidar
