#include "tools/simulate/scenes/scene_catalogue.hpp"

#include <algorithm>
#include <array>

#include "tools/program/exit_status.hpp"
#include "tools/program/joined.hpp"
#include "tools/simulate/scenes/city.hpp"
#include "tools/simulate/scenes/hills.hpp"
#include "tools/simulate/scenes/ring_road.hpp"
#include "tools/simulate/scenes/street.hpp"

namespace iog::tools {
namespace {

constexpr std::array kScenes{SceneEntry{"city", make_city}, SceneEntry{"ring_road", make_ring_road},
                             SceneEntry{"hills", make_hills}, SceneEntry{"street", make_street}};

}  // namespace

std::span<const SceneEntry> all_scenes() { return kScenes; }

const SceneEntry& find_scene(std::string_view name) {
  const auto* const found = std::ranges::find(kScenes, name, &SceneEntry::name);
  if (found == kScenes.end()) {
    throw UsageError("no scene '" + std::string(name) + "'; the known ones are " + scene_names());
  }
  return *found;
}

std::string scene_names() { return joined(kScenes, ", ", &SceneEntry::name); }

}  // namespace iog::tools
