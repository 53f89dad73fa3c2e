// What a map adds to the names of the perception grid, on a simulated drive whose scene is drawn
// well or badly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lab/evaluation/class_truth.hpp"
#include "lab/experiments/experiment.hpp"
#include "lab/experiments/perception/perceived_drive.hpp"
#include "tools/simulate/maps/drawn_map.hpp"

namespace iog::lab {

// A drawing of the scene, and how precise it says that it is.
struct MapVariant {
  std::string_view name;
  tools::MapErrors errors{};
  std::uint32_t accuracy_mm = 0;  // 0: no map
};

// The first is none at all; the last has houses that do not exist, are missing and are outdated.
[[nodiscard]] std::vector<MapVariant> map_variants();

// What the last of the variants has drawn wrongly. Missing houses count with 0.3 m around them: the
// beams' hits are on their walls.
enum class Wrong : std::uint8_t { kGhostBeside, kGhostOnRoad, kMissing };
inline constexpr std::size_t kWrongCount = 3;

struct MapScore {
  Confusion cells{};  // of all known cells
  Confusion seen{};   // of those of which the frame's own beams say something
  std::array<std::array<std::uint64_t, kClassCount>, kWrongCount> in_wrong{};  // by class
};

struct MapDrive {
  std::string_view scene;
  std::uint64_t seed = 0;
  std::uint32_t seconds = 0;
  std::uint32_t first_scored = 50;  // frame; before it a window knows little and is being drawn
};

// By variant; every tenth frame is scored from the first on.
[[nodiscard]] std::vector<MapScore> score_maps(const MapDrive& drive,
                                               std::span<const MapVariant> variants);

}  // namespace iog::lab
