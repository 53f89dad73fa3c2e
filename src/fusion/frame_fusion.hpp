// Fuses the beams of one frame into a grid of occupancy indexes (docs/model.md section 3).
//
// The frame starts from a grid of zeros. All beams are carved before any mark is applied. Beams can
// be carved in any order, and marks can be applied in any order. Therefore, the order of a frame's
// packets does not change a single byte of the grid.
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
  // `vehicle` must outlive this object.
  explicit FrameFusion(const vehicle::Vehicle& vehicle)
      : grids_(vehicle.window.is_opened_from_below, vehicle.grid),
        turns_(vehicle, grids_, marks_),
        azimuths_(vehicle, grids_, marks_),
        first_sensor_(vehicle.sensors.data()),
        rule_(vehicle.rule) {}
  FrameFusion(const FrameFusion&) = delete;
  FrameFusion& operator=(const FrameFusion&) = delete;

  // Sets the ground models that are used to classify the packets of sensors with a ground estimate.
  // The lowest returns of these sensors are also collected. The models must belong to the vehicle
  // and outlive this object. The models may change only while no beams are pending.
  void follow(const ground::Grounds& grounds) { grounds_ = &grounds; }
  // Returns the lowest returns collected from a sensor. `place` is the sensor's index among the
  // sensors with a ground estimate.
  [[nodiscard]] ground::Lows& lows(std::size_t place) { return lows_[place]; }

  // Stores the mark for this point. If `sensor.arc` is given, stores the marks for the point's arc
  // instead. Carves the point's beam, either immediately or when a later call carves all pending
  // beams. The sensor must belong to the vehicle, and the point's layer and azimuth must be valid
  // in the sensor's format. Returns within the vehicle's height band are obstacles. In total, the
  // points of a frame may mark at most kMaxMarks cells.
  vehicle::Fate add(const vehicle::Sensor& sensor, const lidar::ScanPoint& point) {
    if (sensor.arc.is_given()) {
      return arcs_.add(sensor, point);
    }
    return sensor.layers_share_lines ? turns_.turn_to(sensor).add(point)
                                     : azimuths_.add(sensor, point);
  }

  // Adds all points of a packet. If the sensor has a ground estimate, the height limits are
  // relative to the estimated ground. Packet::for_each_point(visit) must call visit(point) for each
  // point. Calls count(fate) for each point. The function is inline so that points are decoded in
  // registers.
  template <typename Packet, typename Count>
  void add_all(const vehicle::Sensor& sensor, const Packet& packet, Count&& count) {
    const auto number = static_cast<std::size_t>(&sensor - first_sensor_);
    const std::optional<std::size_t> place =
        grounds_ == nullptr ? std::nullopt : grounds_->place_of(number);
    if (place) {
      add_all(sensor, grounds_->at(*place), lows_[*place], packet, count);
    } else if (sensor.layers_share_lines) {
      // The lambda is inlined because a function call costs about 30 instructions per point.
      packet.for_each_point([ count, turn = turns_.turn_to(sensor) ](const lidar::ScanPoint& point)
                                __attribute__((always_inline)) { count(turn.add(point)); });
    } else if (sensor.arc.is_given()) {
      packet.for_each_point(
          [&](const lidar::ScanPoint& point) { count(arcs_.add(sensor, point)); });
    } else {
      packet.for_each_point([&](const lidar::ScanPoint& point) __attribute__((always_inline)) {
        count(azimuths_.add(sensor, point));
      });
    }
  }

  // Carves all pending beams.
  void carve_waiting() {
    azimuths_.carve_waiting();
    turns_.carve_waiting();
  }

  // Carves all pending beams, and applies the marks according to the vehicle's fusion rule. Call
  // this function once per frame, after the last point.
  void finish();

  // Returns the grid. The grid is complete from the call to finish() until the grid is cleared.
  [[nodiscard]] const grid::BlockGrid& view() const { return grids_.indexes; }

  // Copies a tile of the frame, row by row from the lowest y, and then clears the tile. Returns
  // false if all cells of the tile are unknown.
  [[nodiscard]] bool take_tile(std::size_t tile,
                               std::span<grid::OccupancyIndex, geometry::kTileCells> to) {
    if (!grids_.indexes.is_touched(tile)) {
      return false;
    }
    const bool is_known = grids_.indexes.copy_tile(tile, to);
    grids_.clear_tile(tile);
    return is_known;
  }

  // `keeps_heights()` returns true if this object records low beams and tall returns
  // (grid/frame_grids.hpp). `low_and_tall()` returns the cells of a tile that were freed by a low
  // beam or hit by a tall return. Call low_and_tall() before take_tile() for the same tile.
  [[nodiscard]] bool keeps_heights() const { return grids_.keep_heights; }
  [[nodiscard]] grid::TileBits low_and_tall(std::size_t tile) const {
    return grids_.low_and_tall(tile);
  }

  // Visits the tiles of the frame in ascending order, and then clears the frame. Calls
  // visit(number, indexes) for each tile with at least one known cell. The indexes are stored row
  // by row from the lowest y, and are valid only during the call.
  template <typename Visit>
  void release(Visit&& visit) {
    release_into([this](std::size_t /*tile*/) { return std::span(tile_cells_); }, visit);
  }
  // Same as release(), but calls visit(number, indexes, low_and_tall).
  template <typename Visit>
  void release_with_heights(Visit&& visit) {
    grid::TileBits bits{};
    const auto place = [&](std::size_t tile) {
      if (grids_.keep_heights) {
        bits = grids_.low_and_tall(tile);
      }
      return std::span(tile_cells_);
    };
    release_into(place, [&](std::size_t tile, auto indexes) { visit(tile, indexes, bits); });
  }
  // Same as release(), but first copies the indexes of each tile to place(number), a span of
  // kTileCells indexes. The tile may turn out to be unknown.
  template <typename Place, typename Visit>
  void release_into(Place&& place, Visit&& visit) {
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      if (grids_.indexes.is_touched(tile)) {
        const std::span<grid::OccupancyIndex, geometry::kTileCells> cells = place(tile);
        if (take_tile(tile, cells)) {
          visit(tile, std::span<const grid::OccupancyIndex, geometry::kTileCells>(cells));
        }
      }
    }
  }

  // Sets all cells to unknown and drops all marks.
  void clear();

  template <typename Visit>
  void for_each_guard(Visit&& visit) {
    visit(behind_);
  }
  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    grids_.indexes.for_each_constant(visit);
    grids_.heights.for_each_constant(visit);
    health::visit_constants(visit, first_sensor_, grounds_, rule_);
  }

 private:
  // This function is not inlined, so that the code for the height band can keep its values in
  // registers.
  template <typename Packet, typename Count>
  [[gnu::noinline]] void add_all(const vehicle::Sensor& sensor, const ground::Ground& ground,
                                 ground::Lows& lows, const Packet& packet, Count&& count) {
    if (sensor.layers_share_lines) {
      const ground::PacketJudge judge(ground, lows, turns_.tilt_of(sensor, ground, packet));
      // The lambda is inlined; only PacketJudge::judge() is a call.
      packet.for_each_point(
          [ count, turn = turns_.turn_to(sensor, ground, judge) ](const lidar::ScanPoint& point)
              __attribute__((always_inline)) { count(turn.add(point)); });
    } else {
      const ground::PacketJudge judge(ground, lows,
                                      grid::AzimuthCarver::tilt_of(sensor, ground, packet));
      packet.for_each_point([&](const lidar::ScanPoint& point) {
        count(azimuths_.add(sensor, ground, judge, point));
      });
    }
  }

  // Members aligned to a cache line come first.
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
