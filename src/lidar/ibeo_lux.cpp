#include "lidar/ibeo_lux.hpp"

#include <algorithm>

#include "lidar/fingerprint.hpp"
#include "wire/byte_reader.hpp"

namespace iog::lidar {
namespace {

// Converts an NTP64 time to Unix time, rounded to the nearest microsecond. NTP64 has seconds from
// 1900 in its high half, which cover 1970 to 2106 here, and units of 2^-32 s in its low half.
std::uint64_t unix_us_of_ntp(std::uint64_t ntp) {
  constexpr std::uint32_t kUnixEpoch = 2'208'988'800U;  // RFC 868
  constexpr std::uint64_t kSecondUs = 1'000'000;
  const std::uint32_t seconds = static_cast<std::uint32_t>(ntp >> 32) - kUnixEpoch;
  const std::uint64_t fraction = ntp & 0xFFFF'FFFFU;
  return seconds * kSecondUs + ((fraction * kSecondUs + (std::uint64_t{1} << 31)) >> 32);
}

}  // namespace

DecodeStatus IbeoLux::decode(std::span<const std::byte> datagram) {
  *this = IbeoLux{};
  if (datagram.size() < kHeaderBytes + kScanBytes) {
    return DecodeStatus::kWrongLength;
  }
  wire::ByteReader header(datagram);
  const std::uint32_t magic = header.u32_be();
  header.skip(4);  // size of the previous message: 0 in live data
  const std::uint32_t body_bytes = header.u32_be();
  header.skip(2);  // reserved, device id
  const std::uint16_t data_type = header.u16_be();
  if (magic != kMagic || data_type != kDataType) {
    return DecodeStatus::kWrongType;
  }

  const auto body = datagram.subspan(kHeaderBytes);
  wire::ByteReader scan(body);
  info_.scan_number = scan.u16_le();
  scan.skip(2 + 2);  // status, synchronisation phase
  info_.sweep.begin_us = unix_us_of_ntp(scan.u64_le());
  info_.sweep.end_us = unix_us_of_ntp(scan.u64_le());
  const std::int32_t ticks_per_turn = scan.u16_le();
  const std::int32_t start = scan.i16_le();
  const std::int32_t end = scan.i16_le();
  const std::uint32_t point_count = scan.u16_le();
  if (body_bytes != body.size() ||
      body.size() != kScanBytes + kPointBytes * std::size_t{point_count}) {
    return DecodeStatus::kWrongLength;
  }
  info_.point_count = point_count;  // only now are the bytes known to be there

  // The mirror may turn either way. The sector is stored counter-clockwise, from right to left.
  const auto [right, left] = std::minmax(start, end);
  if (ticks_per_turn != kTicksPerTurn || right < -kTicksPerTurn / 2 || left > kTicksPerTurn / 2) {
    return DecodeStatus::kWrongAngle;
  }
  info_.sector.first_ticks = static_cast<std::uint16_t>(right < 0 ? right + kTicksPerTurn : right);
  info_.sector.width_ticks = static_cast<std::uint16_t>(left - right);
  info_.sweep.turns_right = start >= end;

  points_ = body.subspan(kScanBytes);
  info_.fingerprint = fingerprint(body.first<kScanBytes>());
  if (!points_.empty()) {
    info_.fingerprint = fingerprint(points_.first<kPointBytes>(), info_.fingerprint);
    info_.fingerprint = fingerprint(points_.last<kPointBytes>(), info_.fingerprint);
  }
  return check_points(right, left);
}

// A point with an impossible layer, echo or direction means that the whole message is wrong, so all
// of it is dropped.
DecodeStatus IbeoLux::check_points(std::int32_t right, std::int32_t left) const {
  for (auto rest = points_; rest.size() >= kPointBytes; rest = rest.subspan(kPointBytes)) {
    const auto bytes = rest.first<kPointBytes>();
    const std::uint8_t layer_and_echo = wire::load_u8(bytes.first<1>());
    if ((layer_and_echo & 0x0F) >= kElevationsDeg.size() || (layer_and_echo >> 4) >= kMaxEchoes) {
      return DecodeStatus::kWrongPoint;
    }
    const std::int32_t angle = signed_angle(bytes);
    if (angle < right || angle > left) {
      return DecodeStatus::kWrongPoint;
    }
  }
  return DecodeStatus::kOk;
}

}  // namespace iog::lidar
