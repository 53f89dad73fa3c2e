// The perception grids of a simulated drive, made by the firmware's code under one or more rules,
// with the evidence that they were made of and what is true.
//
// Cells are those of the window: cell (i, j) of the local frame holds i <= 10 x / m < i + 1.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "app/perception_engine.hpp"
#include "geometry/cell.hpp"
#include "objects/tracker.hpp"
#include "perception/window_fusion.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/drives/pose_source.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

// Nothing was tuned on these.
inline constexpr std::array<std::uint64_t, 12> kCleanSeeds{71, 72, 73, 91, 92, 93,
                                                           94, 95, 96, 97, 98, 99};
// The lengths have enough of everything; the street's is its act.
inline constexpr std::uint32_t kRoadSeconds = 8;
inline constexpr std::uint32_t kStreetSeconds = 20;

struct PerceptionRule {
  std::string_view name;
  perception::Rules rules{};
  std::span<const std::uint8_t> map{};  // a block; empty: none. It outlives the drive.
  vehicle::MovedLimits moved{};         // of all sensors
  bool has_objects = true;              // things with a speed have a say in names
};

// A cell with a positive index in one slice of a frame.
struct HitCell {
  geometry::Cell cell{};
  std::uint8_t slice = 0;  // its place in PerceptionEngine::slices()
};

// The part of the local frame that the window has, row by row from the lowest y.
struct CellWindow {
  geometry::Cell first{};
  [[nodiscard]] bool contains(geometry::Cell cell) const {
    return window::kWindowCells.contains({cell.x - first.x, cell.y - first.y});
  }
  // Of a cell that it contains.
  [[nodiscard]] std::size_t place_of(geometry::Cell cell) const {
    return static_cast<std::size_t>(cell.y - first.y) * window::kCellsAcross +
           static_cast<std::size_t>(cell.x - first.x);
  }
  [[nodiscard]] geometry::Cell cell_at(std::size_t place) const {
    return {first.x + static_cast<std::int32_t>(place % window::kCellsAcross),
            first.y + static_cast<std::int32_t>(place / window::kCellsAcross)};
  }
};

struct PerceivedFrame {
  std::uint32_t number = 0;  // of the drive
  const tools::Drive* drive = nullptr;
  const app::PerceptionEngine* engine = nullptr;  // by the first rule
  const stream::ClassEnd* end = nullptr;          // likewise
  std::vector<HitCell> hits{};                    // without evidence none
  CellWindow window{};
  std::vector<const objects::Tracker*> objects{};  // by rule
  // Of frames that are shown; else empty.
  std::vector<std::int8_t> evidence{};              // the frame's joined indexes
  std::vector<std::vector<std::int8_t>> classes{};  // class bytes, by rule
};

struct PerceivedDrive {
  std::string_view scene;
  std::uint64_t seed = 0;
  std::uint32_t seconds = 0;
  tools::PoseOptions poses{};
  std::uint32_t shown_every = 5;  // frames of which classes and evidence are handed out
  bool has_evidence = true;       // else neither hits nor shown frames
};

// Calls use(frame) for each frame of the reference car's drive, in order.
void perceive_drive(const PerceivedDrive& drive, std::span<const PerceptionRule> rules,
                    const std::function<void(const PerceivedFrame&)>& use);

}  // namespace iog::lab
