// Decodes the MAVLink 2 messages of an ultrasonic sensor. Each message becomes one scan point.
//
// A datagram contains one little-endian DISTANCE_SENSOR message (number 132 of the common message
// set). The message contains the distance of the first echo in the sensor's cone, in centimetres
// (docs/spec.md, section 1.2.5). The layout is published in common.xml on mavlink.io. Senders omit
// the trailing zero bytes of the payload.
//
// The message contains no direction. The point therefore lies on the sensor's axis, and the
// sensor's arc is as wide as its cone (sensor_model/arc.hpp).
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
  // is known only to within 1 %. Hits have the highest index if 1D cells are twice as long as
  // sigma_m.
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

  // Returns kOk, kWrongLength, kWrongType or kWrongAngle. `kWrongLength` means that the length
  // differs from the length in the header or exceeds the message's maximum length. `kWrongType`
  // means that the message is not a MAVLink 2 message from an ultrasonic sensor, that it has the
  // wrong number or checksum, or that it is signed or sets other unsupported flags. `kWrongAngle`
  // means that, according to the message, the sensor does not point horizontally.
  [[nodiscard]] DecodeStatus decode(std::span<const std::byte> datagram);

  // Returns the checksum of a message. `message` must not be empty and must not include the
  // checksum field.
  [[nodiscard]] static std::uint16_t checksum_of(std::span<const std::byte> message);

  [[nodiscard]] const PacketInfo& info() const { return info_; }

  // Does nothing because this decoder keeps no view.
  void move_to(std::span<const std::byte> /*copy*/) {}

  // Calls visit(const ScanPoint&) once. Requires decode() == kOk. The point has no return if there
  // was no echo within the sensor's maximum distance. The point is flagged as rain if the sensor
  // reports the echo as invalid, or if the distance is below the sensor's minimum distance.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    visit(point_);
  }

  // Calls visit(std::uint32_t) for the raw range, and returns visit. Requires decode() == kOk.
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
