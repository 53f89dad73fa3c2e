// Decoder of an ultrasonic unit behind MAVLink 2: wire bytes to a scan point.
//
// One datagram is one DISTANCE_SENSOR message (number 132 of the common message set),
// little-endian: the distance of the first echo in the unit's cone, in centimetres (docs/spec.md,
// section 1.2.5). The layout is public, mavlink.io's common.xml. Zeros at the end of a payload are
// not sent.
//
// The distance has no direction. So the point lies on the unit's axis, and the sensor's arc is as
// wide as its cone (sensor_model/arc.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "lidar/data_sheet.hpp"
#include "lidar/scan_point.hpp"

namespace iog::lidar {

class MavlinkUltrasonic {
 public:
  static constexpr std::string_view kName = "MAVLink ultrasonic";
  // Distances are sent in centimetres. Unless the air temperature is measured, the speed of sound
  // is known only to 1 %. 1D cells of twice sigma give the strongest hit.
  static constexpr DataSheet kDataSheet{.type = "mavlink_ultrasonic",
                                        .range_min_mm = 200,
                                        .range_max_mm = 5'000,
                                        .precision_mm = 100,
                                        .sigma_m = 0.05,
                                        .scan_width_ticks = 960,
                                        .max_points_per_scan = 1,
                                        .azimuth_sigma_deg = 15};
  static constexpr bool kIsUltrasonic = true;
  static constexpr std::int32_t kTicksPerTurn = 11520;  // 1/32 degree
  static constexpr bool kTurns = false;
  static constexpr std::array<double, 1> kElevationsDeg{0};

  static constexpr std::size_t kHeadBytes = 10;
  static constexpr std::size_t kMostPayloadBytes = 39;
  static constexpr std::size_t kChecksumBytes = 2;

  [[nodiscard]] static constexpr std::size_t points_of_packet(std::size_t /*layers*/) { return 1; }

  // Returns kOk; kWrongLength: not as long as its header says, or longer than the message can be;
  // kWrongType: not MAVLink 2, signed or with other flags, another message, a wrong checksum, or
  // not an ultrasonic unit; kWrongAngle: according to the message, the unit does not look to a side
  // of its carrier.
  [[nodiscard]] DecodeStatus decode(std::span<const std::byte> datagram);

  // Checksum of a message without its own checksum. The message has at least one byte.
  [[nodiscard]] static std::uint16_t checksum_of(std::span<const std::byte> message);

  [[nodiscard]] const PacketInfo& info() const { return info_; }

  // Does nothing: this decoder keeps no view.
  void move_to(std::span<const std::byte> /*copy*/) {}

  // Calls visit(const ScanPoint&) once. Requires decode() == kOk. The point has no return if there
  // was no echo up to the unit's longest distance. It is flagged as rain if the unit calls it
  // invalid or if it is below the unit's shortest distance.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    visit(point_);
  }

  // Calls visit(std::uint32_t) for the range as on the wire, and returns visit. Requires decode()
  // == kOk.
  template <typename Visit>
  [[nodiscard]] Visit for_each_range(Visit visit) const {
    visit(distance_cm_);
    return visit;
  }

 private:
  PacketInfo info_;
  ScanPoint point_;
  std::uint32_t distance_cm_ = 0;
};

}  // namespace iog::lidar
