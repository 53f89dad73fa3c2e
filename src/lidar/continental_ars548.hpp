// Decodes the detection lists of a Continental ARS548 RDI radar into scan points.
//
// Each datagram contains a complete list. A list consists of a 101-byte header, 800 detection slots
// of 44 bytes each, and a 35-byte tail. The detections occupy the first slots, and the tail
// contains the number of detections. All numbers are big-endian. Angles are in radians and
// distances in metres, both as binary32 (docs/spec.md, section 1.2.4). The manufacturer's document
// is not public, so the layout is taken from two drivers, tier4/nebula and robotics-upo/ars548_ros.
//
// A detection is a reflection with its own direction. The elevation of a detection is far less
// accurate than its azimuth. The radar reports the standard deviation of the elevation. The decoder
// moves the elevation towards the horizon by one standard deviation, but not past the horizon, and
// then rounds it to the nearest layer. The height band therefore drops a detection only if it is
// outside the band by more than one standard deviation. The decoder ignores speeds.
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

class ContinentalArs548 {
 public:
  static constexpr std::string_view kName = "Continental ARS548";
  // The radar reports a precision of 0.2 m in range and 0.5 degrees in azimuth. Hits have the
  // highest index if 1D cells are twice as long as sigma_m (docs/model.md, section 10).
  static constexpr DataSheet kDataSheet{.type = "continental_ars548",
                                        .range_min_mm = 200,
                                        .precision_mm = 400,
                                        .sigma_m = 0.20,
                                        .scan_width_ticks = 3840,  // 60 degrees to each side
                                        .max_points_per_scan = 800,
                                        .azimuth_sigma_deg = 0.5};
  static constexpr bool kIsRadar = true;
  static constexpr std::int32_t kTicksPerTurn = 11520;  // 1/32 degree
  static constexpr bool kTurns = false;
  // The elevations range from -30 to 30 degrees in steps of one degree.
  static constexpr std::int32_t kSteepestDeg = 30;
  static constexpr auto kElevationsDeg = [] {
    std::array<double, 2 * kSteepestDeg + 1> elevations{};
    double degrees = -kSteepestDeg;
    for (double& elevation : elevations) {
      elevation = degrees;
      degrees += 1;
    }
    return elevations;
  }();

  static constexpr std::uint16_t kMethod = 336;
  static constexpr std::size_t kMostDetections = 800;
  static constexpr std::size_t kHeadBytes = 101;
  static constexpr std::size_t kDetectionBytes = 44;
  static constexpr std::size_t kTailBytes = 35;
  static constexpr std::size_t kBytes =
      kHeadBytes + kMostDetections * kDetectionBytes + kTailBytes;  // 35,336
  static constexpr std::uint8_t kLeastExistence = 50;               // percent

  [[nodiscard]] static constexpr std::size_t points_of_packet(std::size_t /*layers*/) {
    return kMostDetections;
  }

  // Checks the whole list, including every detection, and keeps a view of the datagram. The view is
  // valid only while the datagram exists. Returns kOk, kWrongLength, kWrongType or kWrongPoint.
  // `kWrongType` means that the radar sent a different type of message, such as an object list or a
  // status message. `kWrongPoint` means that the list has more than 800 detections, or that a valid
  // detection contains an impossible value.
  [[nodiscard]] DecodeStatus decode(std::span<const std::byte> datagram);

  [[nodiscard]] const PacketInfo& info() const { return info_; }

  // Makes the view refer to `copy`, which must be a copy of the datagram.
  void move_to(std::span<const std::byte> copy) {
    detections_ = copy.subspan(kHeadBytes, detections_.size());
  }

  // Calls visit(const ScanPoint&) for each detection, in wire order. Requires decode() == kOk. A
  // detection is flagged as rain if it is outside the field of view, if its existence probability
  // is below kLeastExistence, or if the radar reports it as invalid, as noise, or as an obstacle
  // that a vehicle can drive under.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    for (auto rest = detections_; rest.size() >= kDetectionBytes;
         rest = rest.subspan(kDetectionBytes)) {
      visit(point(rest.first<kDetectionBytes>()));
    }
  }

  // Calls visit(std::uint32_t) for each raw range, and returns visit. Requires decode() == kOk.
  template <typename Visit>
  [[nodiscard]] Visit for_each_range(Visit visit) const {
    for (auto rest = detections_; rest.size() >= kDetectionBytes;
         rest = rest.subspan(kDetectionBytes)) {
      visit(range_at(rest.first<kDetectionBytes>()));
    }
    return visit;
  }

 private:
  using DetectionBytes = std::span<const std::byte, kDetectionBytes>;

  [[nodiscard]] static std::uint32_t range_at(DetectionBytes bytes) {
    return wire::load_be32(bytes.subspan<17, 4>());
  }
  // An invalid detection becomes a point without a range.
  [[nodiscard]] static ScanPoint point(DetectionBytes bytes);
  [[nodiscard]] static bool is_place(DetectionBytes bytes);

  PacketInfo info_;
  std::span<const std::byte> detections_;
};

}  // namespace iog::lidar
