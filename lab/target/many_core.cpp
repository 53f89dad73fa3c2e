// many_core: instructions for one frame of two LUX, front left and front right, on the Cortex-A9:
// the many-core paper's two approaches (its table I) in double precision on 50 m x 30 m before the
// car, and the product's fusion. Runs in QEMU with instruction counting (lab/target/run_image);
// prints a line of key=value pairs for each.
//
//   many_core <capture of the reference car>
//
// All three begin with decoded scan points and end with a grid. The two approaches call newlib's
// atan2(), exp(), floor() and ceil().
#include "lab/reference/many_core.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>

#include "capture.hpp"
#include "first_frame.hpp"
#include "fusion/frame_fusion.hpp"
#include "instruction_counter.hpp"
#include "playback.hpp"
#include "require/require.hpp"
#include "vehicles/cars.hpp"

namespace iog::lab {
namespace {

// The two LUX, by their numbers, and their mounts as the file of the car has them.
constexpr std::size_t kLeft = 0;
constexpr std::size_t kRight = 2;
constexpr description::MountConfig kLeftMount{.x_m = 1.95, .y_m = 0.60, .z_m = 0.42, .yaw_deg = 40};
constexpr description::MountConfig kRightMount{
    .x_m = 1.95, .y_m = -0.60, .z_m = 0.42, .yaw_deg = -40};

bool stands_at(const vehicle::Sensor& sensor, const description::MountConfig& mount) {
  constexpr double kOrigin = double{geometry::kOriginCell} * geometry::kResolution;
  return std::abs(kOrigin + mount.x_m * geometry::kSubcellsPerMetre - sensor.origin.x) < 1 &&
         std::abs(kOrigin + mount.y_m * geometry::kSubcellsPerMetre - sensor.origin.y) < 1;
}

std::span<const vehicle::Sensor> sensors() {
  static const std::array two = [] {
    const auto all = vehicles::cars()[0].vehicle.sensors;
    require(stands_at(all[kLeft], kLeftMount) && stands_at(all[kRight], kRightMount));
    return std::array{all[kLeft], all[kRight]};
  }();
  return two;
}

// The car with these two alone.
const vehicle::Vehicle& car() {
  static const vehicle::Vehicle two = [] {
    vehicle::Vehicle vehicle = vehicles::cars()[0].vehicle;
    vehicle.sensors = sensors();
    return vehicle;
  }();
  return two;
}

constexpr std::size_t kLayers = reference::LuxScans::kLayers;
constexpr std::size_t kMaxCells = 500 * 300;

constexpr reference::PlaneGrid plane(std::int32_t cell_mm) {
  return {.x_min_m = 0,
          .y_min_m = -15,
          .cell_m = cell_mm / 1000.0,
          .columns = 50'000 / cell_mm,
          .rows = 30'000 / cell_mm};
}

// The scans of both sensors.
class Scans {
 public:
  explicit Scans(std::span<const SensorPoint> points) {
    for (const SensorPoint& each : points) {
      (each.sensor == &sensors()[0] ? left_ : right_).add(each.point);
    }
    const auto rest = std::ranges::copy(left_.scans(), scans_.begin()).out;
    std::ranges::copy(right_.scans(), rest);
  }

  [[nodiscard]] std::span<const reference::PlaneScan> all() const { return scans_; }

 private:
  reference::LuxScans left_{kLeftMount};
  reference::LuxScans right_{kRightMount};
  std::array<reference::PlaneScan, 2 * kLayers> scans_;
};

void print(const char* key, std::uint64_t value) {
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
  std::printf(" %s=%llu", key, value);
}

template <typename Approach>
void measure_approach(InstructionCounter& counter, const char* name, std::int32_t cell_mm,
                      Approach&& approach) {
  static std::array<double, kMaxCells> probabilities;
  const reference::PlaneGrid grid = plane(cell_mm);
  const std::span cells = std::span(probabilities).first(grid.cells());
  const std::uint32_t start = counter.now();
  const reference::Operations operations = approach(grid, cells);
  const std::uint32_t instructions = counter.now() - start - counter.of_nothing();
  std::printf("many_core approach=%s", name);
  print("cell_mm", static_cast<std::uint64_t>(cell_mm));
  print("cells", grid.cells());
  print("searches", operations.searches);
  print("models", operations.models);
  print("fusions", operations.fusions);
  print("instructions", instructions);
  std::puts("");
}

void measure_product(InstructionCounter& counter, std::span<const SensorPoint> points) {
  static fusion::FrameFusion fusion(car());
  std::uint32_t used = 0;
  const std::uint32_t start = counter.now();
  fusion.clear();
  for (const SensorPoint& each : points) {
    used += fusion.add(*each.sensor, each.point) == vehicle::Fate::kUsed ? 1U : 0U;
  }
  fusion.finish();
  const std::uint32_t instructions = counter.now() - start - counter.of_nothing();
  std::printf("many_core approach=integer");
  print("cell_mm", geometry::kCellMm);
  print("cells", geometry::kCellCount);
  print("points", points.size());
  print("points_used", used);
  print("instructions", instructions);
  std::puts("");
}

int run(const char* path) {
  static InstructionCounter counter;
  static Capture capture;
  static FirstFrame frame(car());
  counter.start();
  if (!counter.is_exact()) {
    std::puts("many_core: instructions are not counted; is this -icount shift=4,sleep=off?");
    return 1;
  }
  if (!capture.open(path)) {
    std::printf("many_core: %s cannot be read as a pcap of Ethernet frames\n", path);
    return 1;
  }
  play(capture, car(), counter, frame);
  static const Scans scans(frame.points());
  static const reference::AnalyticModel model = reference::lux_model();
  for (const std::int32_t cell_mm : {100, 200}) {
    measure_approach(counter, "cbc", cell_mm, [&](const auto& grid, std::span<double> cells) {
      return reference::cell_by_cell(grid, scans.all(), model, cells);
    });
    measure_approach(counter, "bbb", cell_mm, [&](const auto& grid, std::span<double> cells) {
      return reference::beam_by_beam(grid, scans.all(), model, reference::kLuxStopBehindM, cells);
    });
  }
  measure_product(counter, frame.points());
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  if (argc != 2) {
    std::puts("many_core: expected one argument, a capture");
    return 2;
  }
  return iog::lab::run(argv[1]);
}
