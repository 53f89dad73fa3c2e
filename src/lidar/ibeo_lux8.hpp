// ibeo LUX and SICK LD-MRS with eight layers: wire bytes to scan points.
//
// Their messages are those of a LUX with four (lidar/ibeo_lux.hpp). The two sides of the mirror are
// tilted against its axis, one down and one up, and scan in turns: each message has four layers,
// and a flag says by which side, the lower four or the upper four (SICK, libsick_ldmrs, LuxBase).
// A unit with four layers sets that flag, too: nothing in a message tells the two apart.
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
  // Of a mirror that were not tilted; tools/car/tilted_mirror.hpp adds the unit's own tilt.
  static constexpr std::array<double, 8> kElevationsDeg{-1.2, -0.4, 0.4, 1.2,  //
                                                        -1.2, -0.4, 0.4, 1.2};
  // From 60 degrees on the right to 50 on the left: the field of view of the maker's manual.
  static constexpr std::int32_t kRightmostTicks = -1920;
  static constexpr std::int32_t kLeftmostTicks = 1600;

  [[nodiscard]] static constexpr std::size_t points_of_packet(std::size_t layers) {
    return IbeoLux::points_of_packet(layers);
  }
  [[nodiscard]] static constexpr bool looks_up(std::size_t layer) { return layer >= kLayersOfSide; }

  // As IbeoLux::decode(), and kWrongAngle for a sector that the unit cannot see. kOtherUnit: it
  // hangs upside down, and where its beams go then is not known.
  [[nodiscard]] DecodeStatus decode(std::span<const std::byte> datagram);

  [[nodiscard]] const PacketInfo& info() const { return scan_.info(); }

  // From now on the view is of this copy of the datagram.
  void move_to(std::span<const std::byte> copy) { scan_.move_to(copy); }

  // Calls visit(const ScanPoint&) for each point, in wire order. Only after decode() was kOk.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    scan_.for_each_point([&](ScanPoint point) {
      point.layer = static_cast<std::uint8_t>(point.layer + first_layer_);
      visit(point);
    });
  }

  // Calls visit(std::uint32_t) for the range of each, as on the wire, and returns it. Only after
  // decode() was kOk.
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
