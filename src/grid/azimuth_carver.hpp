// Carver for sensors that measure in the same directions in every scan, and for tilted rotating
// ones. It works azimuth by azimuth, on cached lines (beam_lines.hpp).
//
// Beams of one azimuth are collected and carved when the next azimuth begins. Beams on one line, or
// on lines through the same cells, are carved together.
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
  // All three must outlive the carver.
  AzimuthCarver(const vehicle::Vehicle& vehicle, FrameGrids& grids, PendingMarks& marks)
      : lines_(vehicle.sensors), beams_(grids, marks), vehicle_(&vehicle) {}

  // Carves the beam of this point, now or later, and stores its mark. The sensor must be one of the
  // vehicle's whose layers do not share lines. The point's layer and azimuth must be valid in its
  // format.
  [[gnu::always_inline]] vehicle::Fate add(const vehicle::Sensor& sensor,
                                           const lidar::ScanPoint& point);

  // The same for a rotating sensor that follows the ground (docs/ground.md). Carving still uses the
  // height band. Whether a beam is low depends on its height over the ground.
  [[gnu::always_inline]] vehicle::Fate add(const vehicle::Sensor& sensor,
                                           const ground::Ground& ground,
                                           const ground::PacketJudge& judge,
                                           const lidar::ScanPoint& point);

  // The car's tilt as seen by one packet. Packet needs for_each_sample(). Its few beams are not
  // cached.
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
  // Lines of one azimuth that can be pending at a time. Consecutive numbers have different slots,
  // and so have most numbers that differ by a power of two.
  static constexpr std::uint32_t kOpenLines = 32;
  static constexpr std::uint32_t place_of(std::uint32_t number) {
    return (number ^ number / kOpenLines) % kOpenLines;
  }

  // A line of the current azimuth and its pending beams; null if none are pending. Its slot follows
  // from Layer::line.
  struct OpenLine {
    KeptLine* line = nullptr;
    LineSteps steps;
  };

  // A line that KeptAzimuth has no room for. Its slot follows from Layer::line.
  struct FurtherLine {
    KeptLine line;
    std::uint32_t number = 0;
  };

  // The beam of a point. Its sensor and azimuth become the current ones.
  [[gnu::always_inline]] KeptBeam& beam_of(const vehicle::Sensor& sensor,
                                           const lidar::ScanPoint& point) {
    if (sensor_ != &sensor || azimuth_ticks_ != point.azimuth_ticks) {
      turn_to(sensor, point.azimuth_ticks);
    }
    return kept_->has_beam(point.layer) ? kept_->beam(point.layer) : find_beam(point.layer);
  }
  void turn_to(const vehicle::Sensor& sensor, std::uint16_t azimuth_ticks);
  // Rare paths are not inlined, so that the common path keeps the registers.
  [[gnu::noinline]] KeptBeam& find_beam(std::uint8_t layer);
  void take(KeptBeam& beam, const WaitingBeam& its);
  void take(KeptBeam& beam, const WaitingBeam& its, const ground::Ground::Stretch& low);
  template <typename LowOf>
  void take(KeptBeam& beam, const WaitingBeam& its, LowOf&& low_of);
  LineSteps& steps_of(const KeptBeam& beam, Between end);
  LineSteps& steps_on(std::uint32_t number, KeptLine& line);
  KeptLine& further_line(const vehicle::Layer& layer);
  void carve_place(std::uint32_t place);

  // Members aligned to a cache line come first.
  std::array<FurtherLine, kOpenLines> further_lines_;
  BeamLines lines_;
  BeamCarver beams_;
  const vehicle::Vehicle* vehicle_;

  // The current sensor and azimuth. Two bit sets, one bit per slot: further lines already found,
  // and lines with pending beams.
  const vehicle::Sensor* sensor_ = nullptr;
  KeptAzimuth* kept_ = nullptr;
  std::uint32_t further_found_ = 0;
  std::uint32_t lines_in_use_ = 0;
  std::uint16_t azimuth_ticks_ = 0;
  std::uint32_t azimuth_step_ = 0;
  KeptBeam further_beam_;
  std::array<OpenLine, kOpenLines> open_lines_{};
};

inline vehicle::Fate AzimuthCarver::add(const vehicle::Sensor& sensor,
                                        const lidar::ScanPoint& point) {
  KeptBeam& beam = beam_of(sensor, point);
  const vehicle::Classification classified =
      vehicle::classify(sensor, beam.ranges(), point, point.range_mm);
  if (classified.evidence.is_any()) {
    take(beam, {.range_mm = point.range_mm,
                .evidence = classified.evidence,
                .is_tall = classified.evidence.marks() && beam.is_tall(sensor, point.range_mm),
                .ends_on_ground = point.is_ground});
  }
  return classified.fate;
}

inline vehicle::Fate AzimuthCarver::add(const vehicle::Sensor& sensor, const ground::Ground& ground,
                                        const ground::PacketJudge& judge,
                                        const lidar::ScanPoint& point) {
  KeptBeam& beam = beam_of(sensor, point);
  const vehicle::Ranges& in_band = beam.ranges().in_band;
  const ground::Beams& beams = ground.beams();
  const std::uint32_t sector = beams.sector_of(azimuth_step_);
  bool is_tall = false;
  const vehicle::Classification classified = vehicle::classify(
      sensor, beam.ranges().on_car, point, point.range_mm, [&](std::uint32_t reach_mm) {
        const std::int32_t z_mm = beams.height_mm(beams.slope_to(beam.end_z()), point.range_mm);
        const std::uint32_t out_mm = beams.out_mm(point.layer, point.range_mm);
        const auto judged = judge.judge(sector, out_mm, z_mm);
        is_tall = judged.is_tall;
        return vehicle::Height{.is_obstacle = judged.fate == vehicle::Fate::kUsed,
                               .otherwise = judged.fate,
                               .is_whole = in_band.first == 0 && in_band.contain(reach_mm)};
      });
  if (classified.evidence.is_any()) {
    const ground::Ground::Stretch low = ground.low_stretch(sector, point.layer);
    take(beam, {.range_mm = point.range_mm, .evidence = classified.evidence, .is_tall = is_tall},
         low);
  }
  return classified.fate;
}

}  // namespace iog::grid
