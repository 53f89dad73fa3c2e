// The fusion of one frame: beams in, a grid of occupancy indexes out.
//
// docs/model.md section 3. The frame starts from a grid of zeros. The carvers, the pending marks
// and the grid are objects apart. All beams carve before any mark is applied; beams among
// themselves, and marks among themselves, may come in any order. So whatever the order of a frame's
// packets, the grid is the same to the byte.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "geometry/grid.hpp"
#include "grid/arc_marker.hpp"
#include "grid/azimuth_carver.hpp"
#include "grid/frame_grids.hpp"
#include "grid/pending_marks.hpp"
#include "grid/turn_carver.hpp"
#include "ground/ground.hpp"
#include "ground/lows.hpp"
#include "health/constants.hpp"
#include "health/guard.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::fusion {

class FrameFusion {
 public:
  // vehicle outlives the fusion.
  explicit FrameFusion(const vehicle::Vehicle& vehicle)
      : grids_(vehicle.window.is_opened_from_below),
        turns_(vehicle, grids_, marks_),
        azimuths_(vehicle, grids_, marks_),
        first_sensor_(vehicle.sensors.data()),
        rule_(vehicle.rule) {}
  FrameFusion(const FrameFusion&) = delete;
  FrameFusion& operator=(const FrameFusion&) = delete;

  // From now on packets of sensors that follow the ground are judged by these, and their lowest
  // returns are kept. They are the vehicle's, change only when nothing waits, and outlive the
  // fusion.
  void follow(const ground::Grounds& grounds) { grounds_ = &grounds; }
  // By the place of their sensor among them.
  [[nodiscard]] ground::Lows& lows(std::size_t place) { return lows_[place]; }

  // Carves the beam of this point, now or later, and remembers its mark, or those of an arc.
  // The sensor is one of the vehicle's, and the point is judged by its height band; the point's
  // layer and azimuth are those of its format. All points of a frame mark at most kMaxMarks cells.
  vehicle::Fate add(const vehicle::Sensor& sensor, const lidar::ScanPoint& point) {
    if (sensor.arc.is_given()) {
      return arcs_.add(sensor, point);
    }
    return sensor.layers_share_lines ? turns_.turn_to(sensor).add(point)
                                     : azimuths_.add(sensor, point);
  }

  // The same for all points of a packet, by the ground if its sensor follows it:
  // for_each_point(visit) calls visit(point) for each of them. count(fate) is called for each.
  // Inline, so that a point is taken apart in registers.
  template <typename Packet, typename Count>
  void add_all(const vehicle::Sensor& sensor, const Packet& packet, Count&& count) {
    const auto number = static_cast<std::size_t>(&sensor - first_sensor_);
    const std::optional<std::size_t> place =
        grounds_ == nullptr ? std::nullopt : grounds_->place_of(number);
    if (place) {
      add_all(sensor, grounds_->at(*place), lows_[*place], packet, count);
    } else if (sensor.layers_share_lines) {
      // Inline, because a call costs some 30 instructions a point.
      packet.for_each_point([ count, turn = turns_.turn_to(sensor) ](const lidar::ScanPoint& point)
                                __attribute__((always_inline)) { count(turn.add(point)); });
    } else if (sensor.arc.is_given()) {
      packet.for_each_point(
          [&](const lidar::ScanPoint& point) { count(arcs_.add(sensor, point)); });
    } else {
      packet.for_each_point(
          [&](const lidar::ScanPoint& point) { count(azimuths_.add(sensor, point)); });
    }
  }

  // Carves the beams that still wait.
  void carve_waiting() {
    azimuths_.carve_waiting();
    turns_.carve_waiting();
  }

  // The same, and applies the marks by the vehicle's fusion rule. Once per frame, after its last
  // point.
  void finish();

  // The grid, complete after finish(), until it is cleared.
  [[nodiscard]] const grid::BlockGrid& view() const { return grids_.indexes; }

  // Copies a tile of the frame, row by row from its lowest y, and clears it. False if nothing is
  // known in it.
  [[nodiscard]] bool take_tile(std::size_t tile,
                               std::span<grid::OccupancyIndex, geometry::kTileCells> to) {
    if (!grids_.indexes.is_touched(tile)) {
      return false;
    }
    const bool is_known = grids_.indexes.copy_tile(tile, to);
    grids_.clear_tile(tile);
    return is_known;
  }

  // Whether heights count (grid/frame_grids.hpp). Of a tile that is not taken yet: which of its
  // cells were freed from below, or hit by something tall.
  [[nodiscard]] bool keeps_heights() const { return grids_.keep_heights; }
  [[nodiscard]] grid::TileBits low_and_tall(std::size_t tile) const {
    return grids_.low_and_tall(tile);
  }

  // Shows the frame tile by tile and clears it: visit(number, indexes) for each tile in
  // which something is known, in rising order. The indexes, row by row from the lowest y, are valid
  // during the call.
  template <typename Visit>
  void release(Visit&& visit) {
    release_with_heights([&](std::size_t tile, auto indexes,
                             const grid::TileBits& /*low_and_tall*/) { visit(tile, indexes); });
  }
  // The same with visit(number, indexes, low_and_tall).
  template <typename Visit>
  void release_with_heights(Visit&& visit) {
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      if (!grids_.indexes.is_touched(tile)) {
        continue;
      }
      const grid::TileBits bits =
          grids_.keep_heights ? grids_.low_and_tall(tile) : grid::TileBits{};
      if (take_tile(tile, tile_cells_)) {
        visit(tile, std::span<const grid::OccupancyIndex, geometry::kTileCells>(tile_cells_), bits);
      }
    }
  }

  // Sets all cells back to unknown and drops all marks.
  void clear();

  template <typename Visit>
  void for_each_guard(Visit&& visit) {
    visit(behind_);
  }
  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, first_sensor_, grounds_, rule_);
  }

 private:
  // Not inlined, so that those that keep to the band have the registers.
  template <typename Packet, typename Count>
  [[gnu::noinline]] void add_all(const vehicle::Sensor& sensor, const ground::Ground& ground,
                                 ground::Lows& lows, const Packet& packet, Count&& count) {
    if (sensor.layers_share_lines) {
      const ground::PacketJudge judge(ground, lows, turns_.tilt_of(sensor, ground, packet));
      // A call, because a point over the ground is more than its registers hold.
      packet.for_each_point([count, turn = turns_.turn_to(sensor, ground, judge)](
                                const lidar::ScanPoint& point) { count(turn.add(point)); });
    } else {
      const ground::PacketJudge judge(ground, lows,
                                      grid::AzimuthCarver::tilt_of(sensor, ground, packet));
      packet.for_each_point([&](const lidar::ScanPoint& point) {
        count(azimuths_.add(sensor, ground, judge, point));
      });
    }
  }

  // What is aligned to a cache line comes first.
  grid::FrameGrids grids_;
  grid::TurnCarver turns_;
  grid::AzimuthCarver azimuths_;
  const vehicle::Sensor* first_sensor_;
  const ground::Grounds* grounds_ = nullptr;
  vehicle::FusionRule rule_;
  alignas(8) std::array<grid::OccupancyIndex, geometry::kTileCells> tile_cells_{};
  grid::PendingMarks marks_;
  grid::ArcMarker arcs_{grids_, marks_};
  std::array<ground::Lows, vehicle::kMaxGroundSensors> lows_{};
  health::Guard behind_;
};

}  // namespace iog::fusion
