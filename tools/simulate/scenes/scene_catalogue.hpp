// The scenes that `iog simulate` knows, by name.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "tools/simulate/world/scene.hpp"

namespace iog::tools {

struct SceneEntry {
  std::string_view name;
  // The scene for a drive of that many seconds. The same seed makes the same scene.
  Scene (*make)(std::uint64_t seed, double drive_s);
};

[[nodiscard]] std::span<const SceneEntry> all_scenes();
[[nodiscard]] std::string scene_names();  // "city, ring_road, ..."

// UsageError with the known names if there is no such scene.
[[nodiscard]] const SceneEntry& find_scene(std::string_view name);

inline constexpr const char* kDefaultScene = "city";

}  // namespace iog::tools
