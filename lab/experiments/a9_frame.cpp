#include "lab/experiments/a9_frame.hpp"

#include <string>

#include "lab/experiments/cortex_a9.hpp"
#include "tools/simulate/scene_catalogue.hpp"

namespace iog::lab {
namespace {

// The runs of the default scene do not name it.
std::string run_name(std::string_view scene, int sensors) {
  std::string name = "frame_cost ";
  if (scene != tools::kDefaultScene) {
    name.append("scene=").append(scene).append(" ");
  }
  return name.append("sensors=").append(std::to_string(sensors));
}

A9Frame frame_of_run(const std::string& run, int sensors) {
  const double frames = measured_on_a9(run, "frames");
  const auto mean = [&](const char* key) { return measured_on_a9(run, key) / frames; };
  return {.sensors = sensors,
          .points = mean("points"),
          .points_used = mean("points_used"),
          .cells = mean("cells"),
          .tiles = mean("tiles"),
          .receive = mean("receive_sum"),
          .fuse = mean("fuse_sum"),
          .mark = mean("mark_sum"),
          .publish = mean("publish_sum"),
          .fused = mean("fuse_sum") + mean("mark_sum") + mean("clear_sum"),
          .whole = mean("frame_sum"),
          .largest = measured_on_a9(run, "frame_max")};
}

}  // namespace

A9Frame a9_frame(std::string_view scene, int sensors) {
  return frame_of_run(run_name(scene, sensors), sensors);
}

A9Frame a9_worst_frame(std::string_view name) {
  constexpr int kAllSensors = 4;
  return frame_of_run(std::string("frame_cost worst=").append(name), kAllSensors);
}

}  // namespace iog::lab
