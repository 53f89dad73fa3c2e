// Decodes ibeo LUX scan messages (data type 0x2202) into scan points.
//
// Each datagram contains one message. A message consists of a 24-byte big-endian header and a
// little-endian body. The body has 44 bytes plus 10 bytes per point (docs/spec.md; SICK "Ethernet
// data protocol LD-MRS"). A scan may be split into several messages with the same scan number. Each
// message specifies the sector that it covers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "lidar/data_sheet.hpp"
#include "lidar/scan_point.hpp"
#include "wire/byte_order.hpp"

namespace iog::lidar {

class IbeoLux {
 public:
  static constexpr std::string_view kName = "ibeo LUX";
  // The field of view is 100 degrees, the precision 10 cm and the maximum range 50 m
  // (docs/model.md, section 8; thesis, section 4.1.4). The maximum number of points per scan
  // depends on the angular resolution.
  static constexpr DataSheet kDataSheet{.type = "ibeo_lux",
                                        .range_min_mm = 300,
                                        .range_max_mm = 50'000,
                                        .precision_mm = 100,
                                        .sigma_m = 0.10,
                                        .scan_width_ticks = 3200};
  static constexpr std::int32_t kTicksPerTurn = 11520;  // 1/32 degrees
  static constexpr bool kTurns = false;                 // each scan repeats the same azimuths
  static constexpr std::array<double, 4> kElevationsDeg{-1.2, -0.4, 0.4, 1.2};
  static constexpr std::uint32_t kMagic = 0xAFFEC0C2;
  static constexpr std::uint16_t kDataType = 0x2202;
  static constexpr std::size_t kHeaderBytes = 24;
  static constexpr std::size_t kScanBytes = 44;
  static constexpr std::size_t kPointBytes = 10;
  static constexpr std::uint8_t kMaxEchoes = 3;

  // Returns the number of points per azimuth. The number of azimuths in a message depends on the
  // unit.
  [[nodiscard]] static constexpr std::size_t points_of_packet(std::size_t /*layers*/) {
    return kElevationsDeg.size() * kMaxEchoes;
  }

  // Checks the whole message, including every point, and keeps a view of the datagram. The view is
  // valid only while the datagram exists. Returns kOk, kWrongLength, kWrongType, kWrongAngle or
  // kWrongPoint.
  [[nodiscard]] DecodeStatus decode(std::span<const std::byte> datagram);

  [[nodiscard]] const PacketInfo& info() const { return info_; }

  // Makes the view refer to `copy`, which must be a copy of the datagram.
  void move_to(std::span<const std::byte> copy) {
    points_ = copy.subspan(kHeaderBytes + kScanBytes);
  }

  // Calls visit(const ScanPoint&) for each point, in wire order. Requires decode() == kOk.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    for (auto rest = points_; rest.size() >= kPointBytes; rest = rest.subspan(kPointBytes)) {
      visit(point(rest.first<kPointBytes>()));
    }
  }

  // Calls visit(std::uint32_t) for each raw range, and returns visit. Requires decode() == kOk.
  template <typename Visit>
  [[nodiscard]] Visit for_each_range(Visit visit) const {
    for (auto rest = points_; rest.size() >= kPointBytes; rest = rest.subspan(kPointBytes)) {
      visit(range_at(rest.first<kPointBytes>()));
    }
    return visit;
  }

 private:
  using PointBytes = std::span<const std::byte, kPointBytes>;

  static std::uint32_t range_at(PointBytes bytes) { return wire::load_le16(bytes.subspan<4, 2>()); }

  [[gnu::always_inline]] static ScanPoint point(PointBytes bytes) {
    constexpr std::uint8_t kRain = 0x02;
    constexpr std::uint8_t kGround = 0x04;
    constexpr std::uint8_t kDirt = 0x08;
    constexpr std::uint32_t kMillimetresPerUnit = 10;
    const std::uint8_t layer_and_echo = wire::load_u8(bytes.first<1>());
    const std::uint8_t flags = wire::load_u8(bytes.subspan<1, 1>());
    const std::int32_t angle = signed_angle(bytes);
    return {
        .range_mm = range_at(bytes) * kMillimetresPerUnit,
        .azimuth_ticks = static_cast<std::uint16_t>(angle < 0 ? angle + kTicksPerTurn : angle),
        .layer = static_cast<std::uint8_t>(layer_and_echo & 0x0F),
        .echo = static_cast<std::uint8_t>(layer_and_echo >> 4),
        .is_ground = (flags & kGround) != 0,
        .is_dirt = (flags & kDirt) != 0,
        .is_rain = (flags & kRain) != 0,
    };
  }

  static std::int32_t signed_angle(PointBytes bytes) {
    return static_cast<std::int16_t>(wire::load_le16(bytes.subspan<2, 2>()));
  }

  [[nodiscard]] DecodeStatus check_points(std::int32_t right, std::int32_t left) const;

  PacketInfo info_;
  std::span<const std::byte> points_;
};

}  // namespace iog::lidar
