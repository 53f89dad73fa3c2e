#include "tools/tables/a9_frame.hpp"

#include "tools/simulate/scene_catalogue.hpp"
#include "tools/tables/cortex_a9.hpp"
#include "tools/tables/markdown.hpp"

namespace iog::tools {
namespace {

constexpr double kClockHz = 1e9;

// The runs of the default scene do not name it.
std::string run_name(std::string_view scene, int sensors) {
  std::string name = "frame_cost ";
  if (scene != kDefaultScene) {
    name.append("scene=").append(scene).append(" ");
  }
  return name.append("sensors=").append(std::to_string(sensors));
}

}  // namespace

A9Frame a9_frame(std::string_view scene, int sensors) {
  const std::string run = run_name(scene, sensors);
  const auto value = [&](const char* key) { return measured_on_a9(run, key); };
  const double frames = value("frames");
  return {.sensors = sensors,
          .points = value("points") / frames,
          .points_used = value("points_used") / frames,
          .cells = value("cells") / frames,
          .fused = (value("fuse_sum") + value("mark_sum") + value("clear_sum")) / frames,
          .whole = value("frame_sum") / frames,
          .largest = value("frame_max")};
}

double modelled_hz(double instructions, double per_cycle) {
  return kClockHz * per_cycle / instructions;
}

std::string range(double slow, double quick, int decimals) {
  return fixed(slow, decimals) + " to " + fixed(quick, decimals);
}

Verdict verdict_on(double paper, double slow) {
  return slow > paper ? Verdict::kBeats : Verdict::kFallsShort;
}

}  // namespace iog::tools
