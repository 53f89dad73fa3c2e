// The thesis's grid run on a drive's scans, and what it says there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string_view>
#include <vector>

#include "lab/experiments/evidential/scores.hpp"
#include "lab/reference/evidential/perception_grid.hpp"

namespace iog::lab {

// A drive, its scans, what is true of those that are scored, and its map.
struct EvidentialDrive {
  EvidentialDrive(std::string_view scene, std::uint64_t seed, std::uint32_t seconds,
                  std::uint32_t first_frame, double region_m);

  // Every fifth scan, from 1.2 s after the first on, when the grid has learnt something.
  static constexpr std::uint32_t kFramesOfScore = 10;
  static constexpr std::uint32_t kUnscoredFrames = 30;

  std::string_view name;
  std::uint64_t seed;
  std::uint32_t seconds;
  tools::Drive drive;
  std::vector<DriveScan> scans;
  Region region;  // of half-metre cells, the car's place of half of the time in its middle
  SceneMap map;
  std::map<std::uint32_t, TrueScan> truth;  // by frame
};

struct GridChoice {
  reference::evidential::ScanParameters parameters{};
  reference::evidential::LidarParameters lidar{};
  reference::evidential::MapOrder order = reference::evidential::MapOrder::kEveryScan;
};
inline constexpr double kOsmBelief = 0.97;  // table 7.1

// What is known of a cell, in one word: the pignistic decision of sections 8.1 and 8.2, or ours,
// which shares out no ignorance, of the masses that know no map.
[[nodiscard]] Word pignistic_word(const reference::evidential::PerceptionGrid& grid,
                                  std::size_t cell);
[[nodiscard]] Word our_word(const reference::evidential::PerceptionGrid& grid, std::size_t cell,
                            reference::evidential::Set map_classes);

// use(scan, grid): after each scan.
using GridUse = std::function<void(const DriveScan&, const reference::evidential::PerceptionGrid&)>;
void run_grid(const EvidentialDrive& drive, const SceneMap& map, const GridChoice& choice,
              const GridUse& use);

// The firmware's grid of the same drive since its begin, at 25 Hz, placed without error, so that
// its local frame is the world. use(truth, byte_of): for each scan that is scored; byte_of(place)
// is the class byte of a grid that knows no map, 0 beyond the window.
using ByteOf = std::function<std::int8_t(const LocalToWorld::Point&)>;
void run_firmware(const EvidentialDrive& drive, double cell_m,
                  const std::function<void(const TrueScan&, const ByteOf&)>& use);

// By the pignistic decision.
[[nodiscard]] Scores score_grid(const EvidentialDrive& drive, const GridChoice& choice);

}  // namespace iog::lab
