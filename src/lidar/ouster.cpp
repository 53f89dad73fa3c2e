#include "lidar/ouster.hpp"

#include "lidar/fingerprint.hpp"

namespace iog::lidar {
namespace {

constexpr std::uint16_t kLidarPacket = 1;
constexpr std::uint32_t kMeasuredLegacy = 0xFFFF'FFFF;
constexpr std::uint16_t kMeasured = 0x0001;

std::uint16_t half_at(std::span<const std::byte> bytes, std::size_t offset) {
  return wire::load_le16(bytes.subspan(offset).first<2>());
}

std::uint32_t number_at(std::span<const std::byte> bytes, std::size_t offset) {
  return wire::load_le32(bytes.subspan(offset).first<4>());
}

}  // namespace

DecodeStatus OusterPacket::read(const OusterProfile& profile, std::span<const std::byte> datagram,
                                const Unit& unit) {
  *this = OusterPacket{};
  corrections_ = unit.corrections;
  columns_per_turn_ = unit.columns_per_turn;
  column_ns_ = unit.column_ns;
  const std::size_t bytes = profile.header_bytes + profile.footer_bytes +
                            kColumns * profile.column_bytes(corrections_.size());
  if (columns_per_turn_ == 0 || corrections_.empty() || datagram.size() != bytes) {
    return DecodeStatus::kWrongLength;
  }
  packet_ = datagram;
  if (!profile.is_legacy() && half_at(packet_, 0) != kLidarPacket) {
    return DecodeStatus::kWrongType;
  }
  if (const DecodeStatus status = read_columns(profile); status != DecodeStatus::kOk) {
    return status;
  }
  return has_bits_of_other(profile) || has_rows_of_other(profile) ? DecodeStatus::kOtherUnit
                                                                  : DecodeStatus::kOk;
}

// With 64 or 128 rows, RNG15 has as many bytes as 16 or 32 rows with two returns, and the columns
// begin at the same offsets. Byte 15 of a pixel with two returns is always 0. In RNG15 it is the
// reflectivity of every fourth row.
bool OusterPacket::has_bits_of_other(const OusterProfile& profile) const {
  constexpr std::size_t kUnused = 14;
  if (profile.returns() != 2) {
    return false;
  }
  for (std::size_t column = first_; column < end_; ++column) {
    const auto pixels = pixels_of(profile, column);
    for (std::size_t row = 0; row < corrections_.size(); ++row) {
      if (pixels[row * profile.pixel_bytes + kUnused] != std::byte{0}) {
        return true;
      }
    }
  }
  return false;
}

// A pixel with two returns has its near infrared where RNG15 has the range of every fourth row. If
// these rows have many returns but no reflectivity at all, the packet is not RNG15.
bool OusterPacket::has_rows_of_other(const OusterProfile& profile) const {
  constexpr std::size_t kLowRatePixelBytes = 4;
  constexpr std::size_t kRowsOfPixel = 4;
  constexpr std::size_t kFewestRows = 16;
  constexpr std::uint32_t kMany = 64;
  if (profile.pixel_bytes != kLowRatePixelBytes ||
      corrections_.size() < kFewestRows * kRowsOfPixel) {
    return false;
  }
  std::uint32_t returns = 0;
  for (std::size_t column = first_; column < end_; ++column) {
    const auto pixels = pixels_of(profile, column);
    for (std::size_t row = kRowsOfPixel - 1; row < corrections_.size(); row += kRowsOfPixel) {
      const std::uint32_t word = number_at(pixels, row * profile.pixel_bytes);
      if ((word >> 16 & 0xFFU) != 0) {
        return false;
      }
      returns += (word & profile.range_mask) != 0 ? 1U : 0U;
    }
  }
  return returns >= kMany;
}

OusterPacket::Column OusterPacket::column_at(const OusterProfile& profile,
                                             std::size_t column) const {
  const std::size_t column_bytes = profile.column_bytes(corrections_.size());
  const auto bytes = packet_.subspan(profile.header_bytes + column * column_bytes, column_bytes);
  Column it;
  it.time_ns = number_at(bytes, 0) | std::uint64_t{number_at(bytes, 4)} << 32;
  it.number = half_at(bytes, 8);
  if (profile.is_legacy()) {
    it.frame = half_at(bytes, 10);
    it.encoder = number_at(bytes, 12);
    it.is_measured = number_at(bytes, column_bytes - 4) == kMeasuredLegacy;
  } else {
    it.frame = half_at(packet_, 2);
    it.is_measured = (half_at(bytes, 10) & kMeasured) != 0;
  }
  return it;
}

// How far the head has turned clockwise when a column begins, to the nearest tick. 2^16 columns
// times 46,080 ticks plus half a turn of columns stay below 2^32.
std::uint32_t OusterPacket::edge_ticks(std::uint32_t column) const {
  return (column * static_cast<std::uint32_t>(kTicksPerTurn) + columns_per_turn_ / 2) /
         columns_per_turn_;
}

// Whether the column belongs to a turn and, if it has an encoder value, lies within half a column
// of it.
bool OusterPacket::is_in_turn(const OusterProfile& profile, const Column& column) const {
  const std::int64_t off = std::int64_t{column.encoder} * columns_per_turn_ -
                           std::int64_t{column.number} * kEncoderPerTurn;
  constexpr std::int64_t kHalfColumn = kEncoderPerTurn / 2;
  const bool is_there = !profile.is_legacy() || (off >= -kHalfColumn && off <= kHalfColumn);
  return column.number < columns_per_turn_ && is_there;
}

// Columns that were not measured can only be at the ends of the packet, beyond the unit's window.
DecodeStatus OusterPacket::read_columns(const OusterProfile& profile) {
  Column first;
  Column last;
  for (std::size_t i = 0; i < kColumns; ++i) {
    const Column column = column_at(profile, i);
    if (!column.is_measured) {
      continue;
    }
    if (end_ == 0) {
      first = column;
      first_ = i;
    }
    const bool follows = column.number == first.number + (i - first_) &&
                         column.frame == first.frame && (end_ == 0 || end_ == i);
    if (!follows || !is_in_turn(profile, column)) {
      return DecodeStatus::kWrongAngle;
    }
    last = column;
    end_ = i + 1;
    constexpr std::int32_t kBehind = kTicksPerTurn / 2;
    const auto turned = static_cast<std::int32_t>(edge_ticks(column.number));
    azimuths_[i] = turned <= kBehind ? kBehind - turned : kBehind + kTicksPerTurn - turned;
  }
  if (end_ == 0) {
    return DecodeStatus::kWrongPoint;
  }
  // Times of 64 bits may jump. A difference that does not fit the unit's mode is refused.
  const std::uint64_t took_ns = last.time_ns - first.time_ns;
  const std::uint64_t expected_ns = (end_ - first_ - 1) * std::uint64_t{column_ns_};
  if (took_ns < expected_ns - expected_ns / 4 || took_ns > expected_ns + expected_ns / 4) {
    return DecodeStatus::kWrongType;
  }
  describe(profile, first, last);
  return DecodeStatus::kOk;
}

void OusterPacket::describe(const OusterProfile& profile, const Column& first, const Column& last) {
  const std::uint32_t begin = edge_ticks(first.number);
  const std::uint32_t end = edge_ticks(last.number + 1);
  constexpr auto kTurn = static_cast<std::uint32_t>(kTicksPerTurn);
  info_.scan_number = first.frame;
  info_.point_count =
      static_cast<std::uint32_t>((end_ - first_) * corrections_.size() * profile.returns());
  // The wire counts clockwise. So counter-clockwise, the sector begins where the sweep ends.
  info_.sector = {.first_ticks = static_cast<std::uint16_t>((kTurn + kTurn / 2 - end) % kTurn),
                  .width_ticks = static_cast<std::uint16_t>(end - begin)};
  info_.sweep = {.begin_us = first.time_ns / 1'000,
                 .end_us = (last.time_ns + column_ns_) / 1'000,
                 .turns_right = true,
                 .is_of_packet = true};
  const std::size_t head = profile.header_bytes + profile.column_header_bytes;
  const std::size_t last_at =
      profile.header_bytes + (kColumns - 1) * profile.column_bytes(corrections_.size());
  info_.fingerprint =
      fingerprint(packet_.subspan(last_at).first(head), fingerprint(packet_.first(head)));
}

}  // namespace iog::lidar
