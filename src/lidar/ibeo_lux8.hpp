// Decodes the messages of ibeo LUX and SICK LD-MRS units with eight layers into scan points.
//
// The messages have the format of a LUX with four layers (lidar/ibeo_lux.hpp). The two sides of the
// mirror scan alternately. Relative to the mirror's axis, one side is tilted downwards and the
// other upwards. Each message contains four layers. A flag specifies whether a message contains the
// lower or the upper four layers (SICK, libsick_ldmrs, LuxBase). Units with four layers also set
// this flag, so a message does not show whether its unit has four or eight layers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "lidar/ibeo_lux.hpp"
#include "lidar/scan_point.hpp"

namespace iog::lidar {

class IbeoLux8 {
 public:
  static constexpr std::string_view kName = "ibeo LUX 8L";
  static constexpr DataSheet kDataSheet = [] {
    DataSheet sheet = IbeoLux::kDataSheet;
    sheet.type = "ibeo_lux_8l";
    sheet.type_too = "sick_ld_mrs_8l";
    return sheet;
  }();
  static constexpr std::int32_t kTicksPerTurn = IbeoLux::kTicksPerTurn;
  static constexpr bool kTurns = IbeoLux::kTurns;
  static constexpr bool kHasBeamTilt = true;
  // The elevations for a mirror without tilt. `tools/car/tilted_mirror.hpp` adds the tilt.
  static constexpr std::array<double, 8> kElevationsDeg{-1.2, -0.4, 0.4, 1.2,  //
                                                        -1.2, -0.4, 0.4, 1.2};
  // According to the manufacturer's manual, the field of view extends 60 degrees to the right and
  // 50 degrees to the left.
  static constexpr std::int32_t kRightmostTicks = -1920;
  static constexpr std::int32_t kLeftmostTicks = 1600;

  [[nodiscard]] static constexpr std::size_t points_of_packet(std::size_t layers) {
    return IbeoLux::points_of_packet(layers);
  }
  [[nodiscard]] static constexpr bool looks_up(std::size_t layer) { return layer >= kLayersOfSide; }

  // Works like IbeoLux::decode(), but also returns kWrongAngle if the unit cannot see the sector,
  // and kOtherUnit if the unit is mounted upside down. The beam directions of a unit that is
  // mounted upside down are unknown.
  [[nodiscard]] DecodeStatus decode(std::span<const std::byte> datagram);

  [[nodiscard]] const PacketInfo& info() const { return scan_.info(); }

  // Makes the view refer to `copy`, which must be a copy of the datagram.
  void move_to(std::span<const std::byte> copy) { scan_.move_to(copy); }

  // Calls visit(const ScanPoint&) for each point, in wire order. Requires decode() == kOk.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    scan_.for_each_point([&](ScanPoint point) {
      point.layer = static_cast<std::uint8_t>(point.layer + first_layer_);
      visit(point);
    });
  }

  // Calls visit(std::uint32_t) for each raw range, and returns visit. Requires decode() == kOk.
  template <typename Visit>
  [[nodiscard]] Visit for_each_range(Visit visit) const {
    return scan_.for_each_range(visit);
  }

 private:
  static constexpr std::uint8_t kLayersOfSide = IbeoLux::kElevationsDeg.size();

  IbeoLux scan_;
  std::uint8_t first_layer_ = 0;
};

}  // namespace iog::lidar
