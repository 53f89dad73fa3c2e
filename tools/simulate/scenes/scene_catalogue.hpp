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

// UsageError with the known names if there is no such scene.
[[nodiscard]] const SceneEntry& find_scene(std::string_view name);

// For --help: "--scene NAME" and the names that it takes.
inline constexpr const char* kDefaultScene = "city";
[[nodiscard]] std::string scene_option_help();

}  // namespace iog::tools
