// Decodes the packets of Ouster OS lidars into scan points.
//
// A datagram is little-endian and contains 16 columns. Each column contains a time, the column's
// number in the turn, and a range for each row of the unit (docs/spec.md; Ouster "Firmware User
// Manual", chapter "Lidar Data Packet Format"). The decoder supports four profiles: LEGACY (the
// only profile before firmware 2.0), RNG15 ("low data rate"), RNG19 ("single return") and RNG19
// dual ("dual return"). The car file specifies the profile, the number of rows and the number of
// columns per turn, because packets do not contain these values.
//
// A turn has `W` columns. Column `i` is measured when the head has turned clockwise from `-x` by
// `i/W` of a turn. The head is 16 mm wide. The decoder assumes that beams start at the centre of
// the head, which shifts points by less than 1 mm.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "lidar/data_sheet.hpp"
#include "lidar/echo_pair.hpp"
#include "lidar/laser.hpp"
#include "lidar/sampling.hpp"
#include "lidar/scan_point.hpp"
#include "lidar/unit.hpp"
#include "wire/byte_order.hpp"

namespace iog::lidar {

// The differences between profiles. To obtain a range in mm, the decoder masks the first word of
// the pixel and shifts the result left. If each beam has two returns, the pixel contains a second
// range.
struct OusterProfile {
  std::size_t header_bytes = 0;
  std::size_t column_header_bytes = 0;
  std::size_t pixel_bytes = 0;
  std::size_t column_tail_bytes = 0;
  std::size_t footer_bytes = 0;
  std::uint32_t range_mask = 0;
  std::uint32_t range_shift = 0;
  std::size_t second_range_at = 0;  // 0 if there is only one return

  [[nodiscard]] constexpr std::uint8_t returns() const { return second_range_at == 0 ? 1 : 2; }
  [[nodiscard]] constexpr bool is_legacy() const { return header_bytes == 0; }
  [[nodiscard]] constexpr std::size_t column_bytes(std::size_t rows) const {
    return column_header_bytes + rows * pixel_bytes + column_tail_bytes;
  }
};

class OusterPacket {
 public:
  // With 512, 1024 or 2048 columns per turn, columns are 90, 45 or 22.5 ticks apart. One degree is
  // 128 ticks.
  static constexpr std::int32_t kTicksPerTurn = 46'080;
  static constexpr bool kTurns = true;
  static constexpr bool kHasModes = true;
  static constexpr std::array<double, 0> kElevationsDeg{};  // empty; the elevations vary by unit
  static constexpr std::size_t kColumns = 16;
  static constexpr std::uint32_t kEncoderPerTurn = 90'112;

  // Returns true if units with this number of rows exist.
  [[nodiscard]] static constexpr bool can_have_layers(std::size_t layers) {
    return layers == 16 || layers == 32 || layers == 64 || layers == 128;
  }

  [[nodiscard]] const PacketInfo& info() const { return info_; }

  // Makes the view refer to `copy`, which must be a copy of the datagram.
  void move_to(std::span<const std::byte> copy) { packet_ = copy; }

 protected:
  struct Column {
    std::uint64_t time_ns = 0;
    std::uint32_t number = 0;
    std::uint16_t frame = 0;
    std::uint32_t encoder = 0;  // only for LEGACY
    bool is_measured = false;
  };

  // Checks the whole packet and keeps a view of the datagram.
  [[nodiscard]] DecodeStatus read(const OusterProfile& profile, std::span<const std::byte> datagram,
                                  const Unit& unit);

  [[nodiscard]] std::span<const std::byte> pixels_of(const OusterProfile& profile,
                                                     std::size_t column) const {
    return packet_.subspan(profile.header_bytes +
                           column * profile.column_bytes(corrections_.size()) +
                           profile.column_header_bytes);
  }

  // Calls visit(const ScanPoint&) for each point of a measured column.
  template <typename Visit>
  void for_each_row(const OusterProfile& profile, std::size_t column, Visit&& visit) const {
    const auto pixels = pixels_of(profile, column);
    for (std::size_t row = 0; row < corrections_.size(); ++row) {
      const auto pixel = pixels.subspan(row * profile.pixel_bytes);
      for (std::uint8_t echo = 0; echo < profile.returns(); ++echo) {
        visit(point(profile, pixel, column, row, echo));
      }
    }
  }

  [[nodiscard]] ScanPoint point(const OusterProfile& profile, std::span<const std::byte> pixel,
                                std::size_t column, std::size_t row, std::uint8_t echo) const {
    const LaserCorrection& laser = corrections_[row];
    // The azimuth and the 16-bit offset are both below one turn, so the sum has to be wrapped only
    // once.
    std::int32_t azimuth = azimuths_[column] + laser.azimuth_ticks;
    azimuth += azimuth < 0 ? kTicksPerTurn : 0;
    azimuth -= azimuth >= kTicksPerTurn ? kTicksPerTurn : 0;
    std::uint32_t range_mm = range_at(profile, pixel, 0);
    if (profile.second_range_at != 0) {
      range_mm = range_of_echo(range_mm, range_at(profile, pixel, profile.second_range_at), echo);
    }
    return {.range_mm = std::min(corrected_range_mm(range_mm, laser.range_mm), kMaxRangeMm),
            .azimuth_ticks = static_cast<std::uint16_t>(azimuth),
            .layer = static_cast<std::uint8_t>(row),
            .echo = echo};
  }

  [[nodiscard]] static std::uint32_t range_at(const OusterProfile& profile,
                                              std::span<const std::byte> pixel, std::size_t at) {
    const std::uint32_t word = wire::load_le32(pixel.subspan(at).first<4>());
    return (word & profile.range_mask) << profile.range_shift;
  }

  [[nodiscard]] std::size_t first_column() const { return first_; }
  [[nodiscard]] std::size_t end_column() const { return end_; }

 private:
  [[nodiscard]] Column column_at(const OusterProfile& profile, std::size_t column) const;
  [[nodiscard]] std::uint32_t edge_ticks(std::uint32_t column) const;
  [[nodiscard]] DecodeStatus read_columns(const OusterProfile& profile);
  [[nodiscard]] bool has_bits_of_other(const OusterProfile& profile) const;
  [[nodiscard]] bool has_rows_of_other(const OusterProfile& profile) const;
  [[nodiscard]] bool is_in_turn(const OusterProfile& profile, const Column& column) const;
  void describe(const OusterProfile& profile, const Column& first, const Column& last);

  PacketInfo info_;
  std::uint32_t columns_per_turn_ = 1;
  std::uint32_t column_ns_ = 0;
  std::span<const std::byte> packet_;
  std::span<const LaserCorrection> corrections_;
  std::size_t first_ = 0;  // first measured column; end_ is one past the last measured column
  std::size_t end_ = 0;
  std::array<std::int32_t, kColumns> azimuths_{};  // counter-clockwise from straight ahead
};

template <const OusterProfile& kProfile>
class OusterDecoder : public OusterPacket {
 public:
  // Returns the packet size, in bytes, of a unit with this many rows.
  [[nodiscard]] static constexpr std::size_t packet_bytes(std::size_t rows) {
    return kProfile.header_bytes + kProfile.footer_bytes + kColumns * kProfile.column_bytes(rows);
  }

  [[nodiscard]] static constexpr std::size_t points_of_packet(std::size_t layers) {
    return kColumns * layers * kProfile.returns();
  }

  [[nodiscard]] static constexpr const OusterProfile& profile() { return kProfile; }

  // Checks the packet and keeps a view of the datagram. The view is valid only while the datagram
  // and the unit's corrections exist. `unit.corrections` contains one correction per row. Returns
  // kOk, kWrongLength, kWrongType, kWrongAngle, kWrongPoint or kOtherUnit. `kWrongType` means that
  // the packet has the wrong type, or that the times between columns do not match the unit's mode.
  // `kWrongAngle` means that a column number is too high or does not match the encoder value, or
  // that the columns are not consecutive. `kWrongPoint` means that no column was measured.
  // `kOtherUnit` means that the pixels have the format of a different profile.
  [[nodiscard]] DecodeStatus decode(std::span<const std::byte> datagram, const Unit& unit) {
    return read(kProfile, datagram, unit);
  }

  // Calls visit(const ScanPoint&) for each point of the measured columns, in wire order. The nearer
  // return of a beam comes first. Requires decode() == kOk.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    for (std::size_t column = first_column(); column < end_column(); ++column) {
      for_each_row(kProfile, column, visit);
    }
  }

  // Calls visit(const ScanPoint&) for the first echo of each sampled beam in the measured columns.
  // Requires decode() == kOk.
  template <typename Visit>
  void for_each_sample(const Sampling& sampling, Visit&& visit) const {
    for_each_pixel(sampling,
                   [&](std::span<const std::byte> pixel, std::size_t column, std::uint8_t row) {
                     visit(point(kProfile, pixel, column, row, 0));
                   });
  }

  // Calls visit(std::uint32_t) for the uncorrected range of each sampled point, and returns visit.
  // Requires decode() == kOk.
  template <typename Visit>
  [[nodiscard]] Visit for_each_range(const Sampling& sampling, Visit visit) const {
    for_each_pixel(sampling, [&](std::span<const std::byte> pixel, std::size_t /*column*/,
                                 std::uint8_t /*row*/) { visit(range_at(kProfile, pixel, 0)); });
    return visit;
  }

 private:
  // Calls visit(pixel, column, row) for each sampled point.
  template <typename Visit>
  void for_each_pixel(const Sampling& sampling, Visit&& visit) const {
    sampling.for_each_firing(end_column() - first_column(), [&](std::size_t firing) {
      const std::size_t column = first_column() + firing;
      const auto pixels = pixels_of(kProfile, column);
      for (const std::uint8_t row : sampling.layers) {
        visit(pixels.subspan(row * kProfile.pixel_bytes), column, row);
      }
    });
  }
};

// Old firmware sets additional bits above the 20 bits of a LEGACY range.
inline constexpr OusterProfile kOusterLegacyProfile{.column_header_bytes = 16,
                                                    .pixel_bytes = 12,
                                                    .column_tail_bytes = 4,
                                                    .range_mask = 0x000F'FFFF};
inline constexpr OusterProfile kOusterRng15Profile{.header_bytes = 32,
                                                   .column_header_bytes = 12,
                                                   .pixel_bytes = 4,
                                                   .footer_bytes = 32,
                                                   .range_mask = 0x7FFF,
                                                   .range_shift = 3};
inline constexpr OusterProfile kOusterRng19Profile{.header_bytes = 32,
                                                   .column_header_bytes = 12,
                                                   .pixel_bytes = 12,
                                                   .footer_bytes = 32,
                                                   .range_mask = 0x0007'FFFF};
inline constexpr OusterProfile kOusterRng19DualProfile{.header_bytes = 32,
                                                       .column_header_bytes = 12,
                                                       .pixel_bytes = 16,
                                                       .footer_bytes = 32,
                                                       .range_mask = 0x0007'FFFF,
                                                       .second_range_at = 4};

// The minimum range of all units is 0.3 m (Hardware User Manual). The number of points per turn
// depends on the number of rows and on the mode.
constexpr DataSheet data_sheet_of_ouster(std::string_view type) {
  return {.type = type, .range_min_mm = 300};
}

class OusterLegacy : public OusterDecoder<kOusterLegacyProfile> {
 public:
  static constexpr std::string_view kName = "Ouster OS, legacy";
  static constexpr DataSheet kDataSheet = data_sheet_of_ouster("ouster_legacy");
};

class OusterRng15 : public OusterDecoder<kOusterRng15Profile> {
 public:
  static constexpr std::string_view kName = "Ouster OS, RNG15";
  static constexpr DataSheet kDataSheet = data_sheet_of_ouster("ouster_rng15");
};

class OusterRng19 : public OusterDecoder<kOusterRng19Profile> {
 public:
  static constexpr std::string_view kName = "Ouster OS, RNG19";
  static constexpr DataSheet kDataSheet = data_sheet_of_ouster("ouster_rng19");
};

class OusterRng19Dual : public OusterDecoder<kOusterRng19DualProfile> {
 public:
  static constexpr std::string_view kName = "Ouster OS, RNG19 dual";
  static constexpr DataSheet kDataSheet = data_sheet_of_ouster("ouster_rng19_dual");
};

}  // namespace iog::lidar
