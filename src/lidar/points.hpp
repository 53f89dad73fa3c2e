// Decodes iogrid's own datagram format, which can carry the scan points of any lidar (docs/spec.md,
// section 1.2.6).
//
// A datagram is little-endian and contains a header and up to 85 points of a scan. A point consists
// of a direction and a range, or of x, y and z, in the sensor frame. Angles are in units of 1/3,200
// degree. The angle steps of LUX, Velodyne, Hesai and Ouster lidars are multiples of this unit. The
// car file specifies the elevations of the layers. Each point belongs to the nearest layer.
//
// Two formats use this layout. Spinning units are decoded by PointsTurning, for which kTurns is
// true. All other units are decoded by Points.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "lidar/data_sheet.hpp"
#include "lidar/layer_search.hpp"
#include "lidar/sampling.hpp"
#include "lidar/scan_point.hpp"
#include "lidar/unit.hpp"
#include "numeric/polar.hpp"
#include "wire/byte_order.hpp"

namespace iog::lidar {

class PointsPacket {
 public:
  static constexpr bool kIsPoints = true;
  static constexpr std::array<double, 0> kElevationsDeg{};  // empty; the elevations vary by unit
  static constexpr std::int32_t kPartsPerDegree = 3'200;
  static constexpr std::uint32_t kPartsPerTurn = 1'152'000;
  static constexpr std::uint32_t kMagic = 0x54'50'47'49;  // "IGPT"
  static constexpr std::uint8_t kVersion = 1;
  static constexpr std::size_t kHeadBytes = 32;
  static constexpr std::size_t kPointBytes = 16;
  static constexpr std::size_t kMostPoints = 85;
  static constexpr std::uint32_t kOffsetUs = 10;  // time unit of a point's time

  // The flags in the header.
  static constexpr std::uint8_t kArePlaces = 0x01;  // x, y and z instead of directions and ranges
  static constexpr std::uint8_t kIsShare = 0x02;    // the sector describes the whole scan
  // Flags of a point.
  static constexpr std::uint8_t kEcho = 0x03;
  static constexpr std::uint8_t kNothing = 0x04;  // no return from this direction
  static constexpr std::uint8_t kGround = 0x08;
  static constexpr std::uint8_t kDirt = 0x10;
  static constexpr std::uint8_t kRain = 0x20;
  static constexpr std::uint8_t kIsLast = 0x40;  // last point of its direction; not used
  static constexpr std::uint8_t kUnknown = 0x80;

  [[nodiscard]] static constexpr bool can_have_layers(std::size_t layers) {
    return layers >= 1 && layers <= 128;
  }
  [[nodiscard]] static constexpr std::size_t points_of_packet(std::size_t /*layers*/) {
    return kMostPoints;
  }

  [[nodiscard]] const PacketInfo& info() const { return info_; }

  // Makes the view refer to `copy`, which must be a copy of the datagram.
  void move_to(std::span<const std::byte> copy) { points_ = copy.subspan(kHeadBytes); }

 protected:
  using PointBytes = std::span<const std::byte, kPointBytes>;

  // The azimuths of spinning units are later rounded to at most 16,384 steps per turn. An azimuth
  // can be rounded down to a tick first without changing the resulting step, because half a step is
  // an integer number of ticks. Other units use the ticks of a LUX.
  [[nodiscard]] static constexpr std::int32_t ticks_per_turn(bool turns) {
    return turns ? 32'768 : 11'520;
  }
  // Converts an angle of less than two turns to ticks.
  [[nodiscard]] static constexpr std::uint32_t ticks_of(bool turns, std::uint32_t angle) {
    return turns ? angle * 32 / 1'125 : (angle + 50) / 100;
  }

  // Checks the whole datagram, including every point, and keeps a view of the datagram.
  [[nodiscard]] DecodeStatus read(std::span<const std::byte> datagram, const Unit& unit,
                                  bool turns);

  // Returns the raw range. If the point has x, y and z, returns a hash of these coordinates.
  [[nodiscard]] std::uint32_t range_at(PointBytes bytes) const {
    if ((flags_at(bytes) & kNothing) != 0) {
      return 0;
    }
    const std::uint32_t range = wire::load_le32(bytes.subspan<8, 4>());
    return are_places_ ? range ^ wire::load_le32(bytes.subspan<0, 4>()) * 0x9E37'79B1U ^
                             wire::load_le32(bytes.subspan<4, 4>()) * 0x85EB'CA77U
                       : range;
  }

  [[nodiscard]] static std::uint8_t flags_at(PointBytes bytes) {
    return wire::load_u8(bytes.subspan<14, 1>());
  }
  [[nodiscard]] PointBytes bytes_at(std::size_t number) const {
    return points_.subspan(number * kPointBytes).first<kPointBytes>();
  }
  [[nodiscard]] std::size_t count() const { return points_.size() / kPointBytes; }
  [[nodiscard]] bool are_places() const { return are_places_; }

  struct Direction {
    std::uint32_t azimuth = 0;
    std::int32_t elevation = 0;
    std::uint32_t range_mm = 0;
  };

  [[nodiscard]] static Direction direction_at(PointBytes bytes) {
    return {.azimuth = wire::load_le32(bytes.subspan<0, 4>()),
            .elevation = signed_at(bytes.subspan<4, 4>()),
            .range_mm = wire::load_le32(bytes.subspan<8, 4>())};
  }
  [[nodiscard]] static Direction direction_of_place(PointBytes bytes);

  [[nodiscard]] const LayerSearch& layers() const { return layers_; }

 private:
  [[nodiscard]] static std::int32_t signed_at(std::span<const std::byte, 4> bytes) {
    return static_cast<std::int32_t>(wire::load_le32(bytes));
  }
  [[nodiscard]] static bool is_place(PointBytes bytes);
  [[nodiscard]] DecodeStatus read_head(std::span<const std::byte> head, bool turns);
  [[nodiscard]] DecodeStatus check_points();
  [[nodiscard]] bool is_direction(PointBytes bytes) const;

  PacketInfo info_;
  std::span<const std::byte> points_;
  LayerSearch layers_;
  bool are_places_ = false;
  std::uint32_t sector_begin_ = 0;
  std::uint32_t sector_width_ = 0;  // all directions lie within it; 0 means any direction
};

template <bool kHeadTurns>
class PointsDecoder : public PointsPacket {
 public:
  static constexpr bool kTurns = kHeadTurns;
  static constexpr std::int32_t kTicksPerTurn = ticks_per_turn(kTurns);

  // Checks the datagram and keeps a view of its points. The view is valid only while the datagram
  // and the unit's elevations exist. `unit.elevations` contains one elevation per layer. Returns
  // kOk, kWrongLength, kWrongType, kWrongAngle or kWrongPoint. `kWrongLength` means that the length
  // differs from the length in the header or exceeds the maximum, or that the unit has no layers.
  // `kWrongType` means that the magic number, the version or a flag is unknown. `kWrongAngle` means
  // that the sector is larger than a turn, or that the number of the datagram is too high for the
  // scan. `kWrongPoint` means that a point contains an impossible value, or is outside the
  // datagram's sector.
  [[nodiscard]] DecodeStatus decode(std::span<const std::byte> datagram, const Unit& unit) {
    return read(datagram, unit, kTurns);
  }

  // Calls visit(const ScanPoint&) for each point, in wire order. Requires decode() == kOk.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    if (are_places()) {
      visit_points<true>(visit);
    } else {
      visit_points<false>(visit);
    }
  }

  // Calls visit(const ScanPoint&) for each first echo in the sampled layers. The function uses all
  // firings, because a datagram contains only a few. If a datagram has x, y and z, the function
  // reads only every third point, because computing a direction is slow. Requires decode() == kOk.
  template <typename Visit>
  void for_each_sample(const Sampling& sampling, Visit&& visit) const {
    std::array<bool, 256> are_asked{};
    for (const std::uint8_t layer : sampling.layers) {
      are_asked[layer] = true;
    }
    const std::size_t apart = are_places() ? 3 : 1;
    for (std::size_t i = 0; i < count(); i += apart) {
      const ScanPoint its = are_places() ? point<true>(bytes_at(i)) : point<false>(bytes_at(i));
      if (its.echo == 0 && are_asked[its.layer]) {
        visit(its);
      }
    }
  }

  // Calls visit(std::uint32_t) for each raw range, and returns visit. Requires decode() == kOk.
  template <typename Visit>
  [[nodiscard]] Visit for_each_range(const Sampling& /*sampling*/, Visit visit) const {
    for (std::size_t i = 0; i < count(); ++i) {
      visit(range_at(bytes_at(i)));
    }
    return visit;
  }

 private:
  // For spinning units, echo 1 represents all echoes after the first.
  static constexpr std::uint8_t kLastEcho = kTurns ? 1 : 2;

  // Points in directions outside the layers are flagged as rain, because the car file defines no
  // beams there.
  template <bool kArePlacesHere>
  [[nodiscard]] ScanPoint point(PointBytes bytes) const {
    const std::uint8_t flags = flags_at(bytes);
    const Direction there = kArePlacesHere ? direction_of_place(bytes) : direction_at(bytes);
    const std::uint32_t ticks = ticks_of(kTurns, there.azimuth);
    return {.range_mm = (flags & kNothing) != 0 ? 0 : there.range_mm,
            .azimuth_ticks = static_cast<std::uint16_t>(ticks == kTicksPerTurn ? 0 : ticks),
            .layer = static_cast<std::uint8_t>(layers().nearest(there.elevation)),
            .echo = std::min(static_cast<std::uint8_t>(flags & kEcho), kLastEcho),
            .is_ground = (flags & kGround) != 0,
            .is_dirt = (flags & kDirt) != 0,
            .is_rain = (flags & kRain) != 0 || !layers().sees(there.elevation)};
  }

  template <bool kArePlacesHere>
  void visit_points(auto&& visit) const {
    for (std::size_t i = 0; i < count(); ++i) {
      visit(point<kArePlacesHere>(bytes_at(i)));
    }
  }
};

// Range and precision depend on the unit, so the car file specifies them.
class Points : public PointsDecoder<false> {
 public:
  static constexpr std::string_view kName = "points";
  static constexpr DataSheet kDataSheet{.type = "points"};
};

class PointsTurning : public PointsDecoder<true> {
 public:
  static constexpr std::string_view kName = "points, turning";
  static constexpr DataSheet kDataSheet{.type = "points_turning"};
};

}  // namespace iog::lidar
