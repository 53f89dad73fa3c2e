// MRPT's occupancy grid: int8 log-odds with saturation. A frame is one planar scan for each layer
// of each sensor. Options are those of the library, but for the range that counts, and for missing
// returns, which by default clear half of the range before them.
#include <cmath>
#include <map>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/peers/contender.hpp"
#include "lidar/ibeo_lux.hpp"

namespace iog::lab {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::obs::CObservation2DRangeScan;

constexpr std::int32_t kTicksPerTurn = lidar::IbeoLux::kTicksPerTurn;
constexpr double kRadPerTick = 2 * std::numbers::pi / kTicksPerTurn;
constexpr std::int32_t kStepTicks = 16;  // 0.5 degrees, as the car's description has it

std::int32_t signed_ticks(const PeerBeam& beam) {
  const std::int32_t ticks = beam.point.azimuth_ticks;
  return ticks > kTicksPerTurn / 2 ? ticks - kTicksPerTurn : ticks;
}

// MRPT's directions begin at half the aperture to the right and are aperture / count apart.
CObservation2DRangeScan empty_scan(const PeerBeam& beam, std::int32_t width_ticks) {
  const std::int32_t first_ticks = -width_ticks / 2;
  const std::int32_t count = width_ticks / kStepTicks + 1;
  CObservation2DRangeScan scan;
  scan.resizeScanAndAssign(static_cast<std::size_t>(count), 0, false);
  const double aperture = count * kStepTicks * kRadPerTick;
  scan.aperture = static_cast<float>(aperture);
  const double azimuth = std::atan2(beam.end.y - beam.origin.y, beam.end.x - beam.origin.x);
  const double first = azimuth - (signed_ticks(beam) - first_ticks) * kRadPerTick;
  scan.sensorPose = {beam.origin.x, beam.origin.y, 0, first + aperture / 2, 0, 0};
  return scan;
}

using Scans = std::vector<CObservation2DRangeScan>;

Scans scans_of(const PeerFrame& frame, const vehicle::Vehicle& car) {
  std::map<std::pair<std::size_t, int>, CObservation2DRangeScan> scans;
  for (const PeerBeam& beam : frame) {
    const std::int32_t width_ticks = car.sensors[beam.sensor].scan_width_ticks;
    const auto [scan, is_new] = scans.try_emplace({beam.sensor, beam.point.layer});
    if (is_new) {
      scan->second = empty_scan(beam, width_ticks);
    }
    const auto slot = static_cast<std::size_t>((signed_ticks(beam) + width_ticks / 2) / kStepTicks);
    const double range_m = std::hypot(beam.end.x - beam.origin.x, beam.end.y - beam.origin.y);
    scan->second.setScanRange(slot, static_cast<float>(range_m));
    scan->second.setScanRangeValidity(slot, true);
  }
  Scans result;
  for (auto& [place, scan] : scans) {
    result.push_back(std::move(scan));
  }
  return result;
}

class Mrpt final : public Contender {
 public:
  explicit Mrpt(const PeerFrames& frames) {
    constexpr auto kHalfSide = static_cast<float>(kHalfSideM);
    map_.setSize(-kHalfSide, kHalfSide, -kHalfSide, kHalfSide, static_cast<float>(kCellM));
    map_.insertionOptions.maxDistanceInsertion =
        static_cast<float>(frames.vehicle->sensors[0].range.mm()) / 1000;
    map_.insertionOptions.considerInvalidRangesAsFreeSpace = false;
    for (const PeerFrame& frame : frames.frames) {
      frames_.push_back(scans_of(frame, *frames.vehicle));
    }
    // A map grows when a beam leaves it: before anything is timed.
    for (std::size_t frame = 0; frame < frames_.size(); ++frame) {
      fuse(frame);
    }
    clear();
  }

  void fuse(std::size_t frame) override {
    for (const CObservation2DRangeScan& scan : frames_[frame]) {
      map_.insertObservation(scan);
    }
  }

  void clear() override { map_.fill(); }

  [[nodiscard]] CellCounts count() const override {
    constexpr float kUnknown = 0.5F;  // 1 is free
    constexpr float kHardlyAny = 1e-3F;
    CellCounts counts{.stored = std::size_t{map_.getSizeX()} * map_.getSizeY()};
    for (int y = 0; y < static_cast<int>(map_.getSizeY()); ++y) {
      for (int x = 0; x < static_cast<int>(map_.getSizeX()); ++x) {
        const float cell = map_.getCell(x, y);
        counts.free += cell > kUnknown + kHardlyAny ? 1U : 0U;
        counts.occupied += cell < kUnknown - kHardlyAny ? 1U : 0U;
      }
    }
    return counts;
  }

 private:
  COccupancyGridMap2D map_;
  std::vector<Scans> frames_;
};

}  // namespace

std::unique_ptr<Contender> make_mrpt(const PeerFrames& frames) {
  return std::make_unique<Mrpt>(frames);
}

}  // namespace iog::lab
