// Carves the beams of tilted rotating sensors and of sensors that measure in the same directions in
// every scan. The carver uses cached lines (beam_lines.hpp). The beams of one azimuth are collected
// and then carved when the next azimuth begins.
//
// Beams that share a line, or whose lines cross the same cells, are carved together.
#pragma once

#include <array>
#include <cstdint>

#include "grid/beam_carver.hpp"
#include "grid/beam_lines.hpp"
#include "grid/frame_grids.hpp"
#include "grid/free_steps.hpp"
#include "grid/pending_marks.hpp"
#include "grid/turn_lines.hpp"
#include "ground/ground.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

class AzimuthCarver {
 public:
  // All arguments must outlive the carver.
  AzimuthCarver(const vehicle::Vehicle& vehicle, FrameGrids& grids, PendingMarks& marks)
      : beams_(grids, marks), vehicle_(&vehicle), lines_(vehicle.sensors) {
    latest_ = open_lines_.data();
  }

  // Stores the mark for this point. Carves the point's beam, either immediately or when the next
  // azimuth begins. The sensor must belong to the vehicle, and its layers must not share lines. The
  // point's layer and azimuth must be valid in the sensor's format.
  [[gnu::always_inline]] vehicle::Fate add(const vehicle::Sensor& sensor,
                                           const lidar::ScanPoint& point);

  // Same as above, for a rotating sensor with a ground estimate (docs/ground.md).
  [[gnu::always_inline]] vehicle::Fate add(const vehicle::Sensor& sensor,
                                           const ground::Ground& ground,
                                           const ground::PacketJudge& judge,
                                           const lidar::ScanPoint& point);

  // Estimates the car's tilt from one packet. The packet type must have for_each_sample(). The
  // beams of the sampled points are not cached.
  template <typename Packet>
  [[nodiscard]] static ground::Tilt tilt_of(const vehicle::Sensor& sensor,
                                            const ground::Ground& ground, const Packet& packet) {
    return ground.tilt_of(sensor, packet, [&](std::uint32_t step, const lidar::ScanPoint& point) {
      const vehicle::Layer& layer = sensor.layers[point.layer];
      const vehicle::Direction direction = vehicle::direction_of(sensor, step);
      return ground::Ray{
          .on_car = vehicle::ranges_on_car(sensor, vehicle::line_of(sensor, layer, direction)),
          .slope = ground.beams().slope_to(vehicle::end_height_of(layer, direction))};
    });
  }

  // Carves all pending beams.
  void carve_waiting();

  // Drops all pending beams without carving them.
  void drop_waiting();

 private:
  // The maximum number of pending lines per azimuth. Consecutive line numbers map to different
  // slots, and so do most line numbers that differ by a power of two.
  static constexpr std::uint32_t kOpenLines = 32;
  static constexpr std::uint32_t place_of(std::uint32_t number) {
    return (number ^ number / kOpenLines) % kOpenLines;
  }

  // A line of the current azimuth and its pending beams. The line is null if it has no pending
  // beams. The slot is computed from Layer::line.
  struct OpenLine {
    KeptLine* line = nullptr;
    LineSteps steps;
  };

  // A line that has no slot in KeptAzimuth. The slot is computed from Layer::line.
  struct FurtherLine {
    KeptLine line;
    std::uint32_t number = 0;
  };

  // Returns the beam of a point. Makes the point's sensor and azimuth the current ones.
  [[gnu::always_inline]] KeptBeam& beam_of(const vehicle::Sensor& sensor,
                                           const lidar::ScanPoint& point) {
    if (sensor_ != &sensor || azimuth_ticks_ != point.azimuth_ticks) {
      turn_to(sensor, point.azimuth_ticks);
    }
    return kept_->has_beam(point.layer) ? kept_->beam(point.layer) : find_beam(point.layer);
  }
  void turn_to(const vehicle::Sensor& sensor, std::uint16_t azimuth_ticks);
  // Rare paths are not inlined, so that the common path can keep its values in registers.
  [[gnu::noinline]] KeptBeam& find_beam(std::uint8_t layer);
  // Returns the cached height properties of a beam.
  [[nodiscard]] KeptHeight& height_of(const KeptBeam& beam) {
    return &beam == &further_beam_ ? further_height_ : kept_->height_of(beam);
  }
  [[gnu::noinline]] void find_band(KeptBeam& beam);
  [[gnu::noinline]] bool is_tall(const KeptBeam& beam, std::uint32_t range_mm);
  KeptBeam& find_further_beam(const vehicle::Layer& layer, KeptLine& line);
  void take(KeptBeam& beam, const WaitingBeam& its);
  void take(KeptBeam& beam, const WaitingBeam& its, const ground::Ground& ground,
            std::uint32_t sector, std::uint8_t layer);
  // `limits` is null if the beam can free the whole line within the grid.
  template <typename LowOf>
  void take(KeptBeam& beam, const WaitingBeam& its, const FreePart* limits, LowOf&& low_of);
  LineSteps& steps_of(KeptLine& line, Between end);
  LineSteps& steps_on(KeptLine& line);
  [[gnu::noinline]] OpenLine& open(KeptLine& line);
  KeptLine& further_line(const vehicle::Layer& layer);
  void carve_place(std::uint32_t place);

  // Members that are needed for each point come first, because accesses with large offsets need
  // more instructions.
  BeamCarver beams_;
  const vehicle::Vehicle* vehicle_;

  // The current sensor and azimuth, and two bit sets with one bit per slot. `further_found_`
  // contains the slots whose line in `further_lines_` has been found. `lines_in_use_` contains the
  // slots whose line has pending beams.
  const vehicle::Sensor* sensor_ = nullptr;
  KeptAzimuth* kept_ = nullptr;
  std::uint32_t further_found_ = 0;
  std::uint32_t lines_in_use_ = 0;
  std::uint16_t azimuth_ticks_ = 0;
  std::uint32_t azimuth_step_ = 0;
  OpenLine* latest_ = nullptr;  // of the latest beam; the next beam is often on the same line
  KeptBeam further_beam_;
  KeptHeight further_height_;
  std::array<OpenLine, kOpenLines> open_lines_{};
  std::array<FurtherLine, kOpenLines> further_lines_;
  BeamLines lines_;
};

inline vehicle::Fate AzimuthCarver::add(const vehicle::Sensor& sensor,
                                        const lidar::ScanPoint& point) {
  KeptBeam& beam = beam_of(sensor, point);
  const vehicle::Classification classified =
      vehicle::classify(sensor, beam.ranges(), point, point.range_mm);
  if (classified.evidence.is_any()) {
    take(beam, {.range_mm = point.range_mm,
                .evidence = classified.evidence,
                .is_tall = classified.evidence.marks() && beams_.keeps_heights() &&
                           is_tall(beam, point.range_mm),
                .ends_on_ground = point.is_ground});
  }
  return classified.fate;
}

inline vehicle::Fate AzimuthCarver::add(const vehicle::Sensor& sensor, const ground::Ground& ground,
                                        const ground::PacketJudge& judge,
                                        const lidar::ScanPoint& point) {
  KeptBeam& beam = beam_of(sensor, point);
  const ground::Beams& beams = ground.beams();
  const std::uint32_t sector = beams.sector_of(azimuth_step_);
  bool is_tall = false;
  const vehicle::Classification classified = vehicle::classify(
      sensor, beam.ranges().on_car, point, point.range_mm, [&](std::uint32_t reach_mm) {
        const std::int32_t z_mm =
            beams.height_mm(beams.slope_to(height_of(beam).end_z()), point.range_mm);
        const std::uint32_t out_mm = beams.out_mm(point.layer, point.range_mm);
        const auto judged = judge.judge(sector, out_mm, z_mm);
        is_tall = judged.is_tall;
        return vehicle::Height{.fate = judged.fate,
                               .is_whole = reach_mm <= ground.exits().to_mm(sector, point.layer)};
      });
  if (classified.evidence.is_any()) {
    take(beam, {.range_mm = point.range_mm, .evidence = classified.evidence, .is_tall = is_tall},
         ground, sector, point.layer);
  }
  return classified.fate;
}

}  // namespace iog::grid
