// Decodes the data packets of the Velodyne HDL-64E (HDL-64E S2 manual 63-HDL64ES2, S3 manual
// 63-HDL64ES3, appendix on timing). Two blocks with the same azimuth contain a firing of all 64
// lasers. The block with flag 0xEEFF contains the upper bank, and the block with flag 0xDDFF
// contains the lower bank. The lasers of a bank fire in eight groups of four, and both banks fire
// at the same time. Bytes 1204 and 1205 contain a status that changes from packet to packet. The
// elevations differ between units, so the car file specifies them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "lidar/velodyne.hpp"

namespace iog::lidar {

struct Hdl64eTiming {
  std::uint32_t block_ns;
  std::uint32_t group_ns;
  std::array<std::uint32_t, 4> in_group_ns;
};
inline constexpr Hdl64eTiming kHdl64eS2Timing{48'000, 6'000, {0, 1'260, 2'460, 3'660}};
inline constexpr Hdl64eTiming kHdl64eS3Timing{57'600, 7'200, {0, 1'300, 2'500, 3'700}};

// Firing times are rounded to multiples of 200 ns (S2) or 240 ns (S3). The largest rounding error
// is 120 ns. In this time, the head rotates by less than 0.001 degrees.
consteval VelodyneUnit make_hdl64e(const Hdl64eTiming& timing, bool has_two_returns) {
  constexpr std::uint32_t kParts = 240;
  VelodyneUnit unit{.layers = 64,
                    .banks = 2,
                    .range_unit_mm = 2,
                    .has_two_returns = has_two_returns,
                    .block_ns = timing.block_ns,
                    .block_parts = kParts};
  for (std::uint32_t channel = 0; channel < 32; ++channel) {
    const std::uint32_t at_ns = channel / 4 * timing.group_ns + timing.in_group_ns[channel % 4];
    unit.fires_at[channel] =
        static_cast<std::uint8_t>((at_ns * kParts + timing.block_ns / 2) / timing.block_ns);
  }
  return unit;
}
inline constexpr VelodyneUnit kHdl64eS2Unit = make_hdl64e(kHdl64eS2Timing, false);
inline constexpr VelodyneUnit kHdl64eS3Unit = make_hdl64e(kHdl64eS3Timing, true);

class VelodyneHdl64eS2 : public VelodyneDecoder<kHdl64eS2Unit> {
 public:
  static constexpr std::string_view kName = "Velodyne HDL-64E S2";
  // The data sheet specifies a precision of 2 cm, but iogrid uses 3 cm. One turn at 10 Hz consists
  // of 348 packets.
  static constexpr DataSheet kDataSheet = data_sheet_of_velodyne("velodyne_hdl64e_s2", 360);
  static constexpr std::array<double, 0> kElevationsDeg{};
};

class VelodyneHdl64eS3 : public VelodyneDecoder<kHdl64eS3Unit> {
 public:
  static constexpr std::string_view kName = "Velodyne HDL-64E S3";
  // The data sheet specifies a precision of 2 cm, but iogrid uses 3 cm. One turn at 10 Hz consists
  // of 290 packets. In dual return mode, one turn consists of 579 packets, so a car file for this
  // mode must increase max_points_per_scan.
  static constexpr DataSheet kDataSheet = data_sheet_of_velodyne("velodyne_hdl64e_s3", 300);
  static constexpr std::array<double, 0> kElevationsDeg{};
};

}  // namespace iog::lidar
