// turning_cost: what a scan point of a level lidar that turns costs the Cortex-A9, whatever its
// wire format: made-up layers and azimuths, points straight into the fusion. Prints one line of
// key=value pairs; instructions are means over the frames.
//
//   turning_cost <layers> <azimuths> <pattern> <band> <frames>
//
// Layers are at most 128, from -25 to 25 degrees, and ranges are drawn from 5 to 50 m. Patterns are
// by what a sensor does while it turns: "column" fires all layers at one azimuth, "spread" one
// after the other until the next azimuth (HDL-32E, VLP-16), "offsets" at four azimuths (Ouster
// OS1). The band is "open", where it cuts nothing off, or "car", from 0.3 to 2.2 m. One frame more
// goes before, to warm up.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "fusion/frame_fusion.hpp"
#include "instruction_counter.hpp"
#include "lab/a9_model/marker.hpp"
#include "number_in.hpp"
#include "tools/car/scanners.hpp"
#include "tools/car/tables.hpp"
#include "tools/simulate/random.hpp"

namespace iog::lab {
namespace {

constexpr std::int32_t kTicksPerTurn = 36'000;

constexpr description::Description described(double z_min_m, double z_max_m) {
  return {.name = "turning",
          .footprint = {.x_min_m = -2.04, .x_max_m = 2.04, .y_min_m = -0.87, .y_max_m = 0.87},
          .z_min_m = z_min_m,
          .z_max_m = z_max_m};
}

consteval std::array<lidar::Laser, vehicle::kMaxLayers> make_lasers() {
  std::array<lidar::Laser, vehicle::kMaxLayers> lasers{};
  for (std::size_t i = 0; i < lasers.size(); ++i) {
    lasers[i].elevation_deg = -25 + 50.0 * static_cast<double>(i) / (lasers.size() - 1);
  }
  return lasers;
}

// A VLP-16 with as many layers as a vehicle can have, which no packet of its format has. Called
// once.
vehicle::Vehicle vehicle_in_band(const description::Description& car) {
  static constexpr auto kLasers = make_lasers();
  static std::array<vehicle::Sensor, 1> sensors;
  description::SensorConfig config = description::scanner_of(lidar::kFormat<lidar::VelodyneVlp16>);
  config.name = "roof";
  config.udp_port = 2368;
  config.mount = {.x_m = 0.123, .y_m = 0.456, .z_m = 1.8};
  config.range_max_mm = 50'000;
  config.precision_mm = 100;
  config.sigma_m = 0.10;
  config.lasers = kLasers;
  sensors[0] = description::sensor_of(config, car);
  return description::vehicle_of(car, sensors);
}

enum class Pattern : std::uint8_t { kColumn, kSpread, kOffsets };

struct Request {
  std::uint32_t layers = 0;
  std::uint32_t azimuths = 0;
  Pattern pattern = Pattern::kColumn;
  const vehicle::Vehicle* vehicle = nullptr;
  std::uint32_t frames = 0;
};

class Turns {
 public:
  explicit Turns(const Request& request) : request_(request) {}

  // The same for every layout of the same numbers, in 0.01 degrees, counter-clockwise.
  [[nodiscard]] lidar::ScanPoint point(std::uint32_t azimuth, std::uint32_t layer) {
    const std::uint32_t places = request_.azimuths * request_.layers;
    std::uint32_t at = azimuth * request_.layers;
    if (request_.pattern == Pattern::kSpread) {
      at += layer;
    }
    std::uint32_t ticks = static_cast<std::uint32_t>(std::uint64_t{at} * kTicksPerTurn / places);
    if (request_.pattern == Pattern::kOffsets) {
      ticks += layer % 4 * 211;
    }
    return {.range_mm = static_cast<std::uint32_t>(5'000 + random_.below(45'000)),
            .azimuth_ticks = static_cast<std::uint16_t>(ticks % kTicksPerTurn),
            .layer = static_cast<std::uint8_t>(layer * (vehicle::kMaxLayers - 1) /
                                               (request_.layers - 1))};
  }

 private:
  const Request& request_;
  tools::Random random_{1, 1};
};

struct Cost {
  std::uint64_t fuse = 0;
  std::uint64_t mark = 0;
  std::uint64_t points = 0;
  std::uint64_t used = 0;
};

// Points of a column are made first, so that only the fusion is counted.
void fuse_turn(const Request& request, Turns& turns, fusion::FrameFusion& fusion,
               InstructionCounter& counter, Cost& cost) {
  const vehicle::Sensor& sensor = request.vehicle->sensors[0];
  static std::array<lidar::ScanPoint, vehicle::kMaxLayers> column;
  for (std::uint32_t azimuth = 0; azimuth < request.azimuths; ++azimuth) {
    for (std::uint32_t layer = 0; layer < request.layers; ++layer) {
      column[layer] = turns.point(azimuth, layer);
    }
    const std::uint32_t start = counter.now();
    a9_model::begin_region<1>();
    for (std::uint32_t layer = 0; layer < request.layers; ++layer) {
      const vehicle::Fate fate = fusion.add(sensor, column[layer]);
      cost.used += fate == vehicle::Fate::kUsed ? 1U : 0U;
    }
    a9_model::end_region<1>();
    cost.fuse += counter.now() - start - counter.of_nothing();
    cost.points += request.layers;
  }
  const std::uint32_t start = counter.now();
  a9_model::begin_region<2>();
  fusion.finish();
  a9_model::end_region<2>();
  cost.mark += counter.now() - start - counter.of_nothing();
  fusion.clear();
}

void print(const char* key, std::uint64_t value) {
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
  std::printf(" %s=%llu", key, value);
}

int run(const Request& request) {
  static InstructionCounter counter;
  static fusion::FrameFusion fusion(*request.vehicle);
  counter.start();
  if (!counter.is_exact()) {
    std::puts("turning_cost: instructions are not counted; is this -icount shift=4,sleep=off?");
    return 1;
  }
  Turns turns(request);
  Cost cost;
  for (std::uint32_t frame = 0; frame <= request.frames; ++frame) {
    fuse_turn(request, turns, fusion, counter, cost);
    if (frame == 0) {
      a9_model::forget_so_far();
      cost = {};
    }
  }
  if (request.frames == 0 || cost.points == 0) {
    std::puts("turning_cost: no turn was fused");
    return 1;
  }
  std::printf("turning_cost");
  print("layers", request.layers);
  print("azimuths", request.azimuths);
  print("frames", request.frames);
  print("points", cost.points / request.frames);
  print("points_used", cost.used / request.frames);
  print("fuse", cost.fuse / request.frames);
  print("mark", cost.mark / request.frames);
  print("instructions_a_point", (cost.fuse + cost.mark) / cost.points);
  std::puts("");
  return 0;
}

bool read(char** argv, Request& request) {
  const std::string_view pattern = argv[3];
  const std::string_view band = argv[4];
  static const vehicle::Vehicle car =
      vehicle_in_band(band == "car" ? described(0.3, 2.2) : described(-100, 100));
  request = {.layers = static_cast<std::uint32_t>(number_in(argv[1], vehicle::kMaxLayers)),
             .azimuths = static_cast<std::uint32_t>(number_in(argv[2], 4'096)),
             .pattern = pattern == "spread"    ? Pattern::kSpread
                        : pattern == "offsets" ? Pattern::kOffsets
                                               : Pattern::kColumn,
             .vehicle = &car,
             .frames = static_cast<std::uint32_t>(number_in(argv[5], 1'000))};
  return request.layers > 1 && request.azimuths > 0 && request.frames > 0 &&
         request.layers * request.azimuths <= grid::kMaxMarks &&
         (pattern == "column" || request.pattern != Pattern::kColumn) &&
         (band == "open" || band == "car");
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  iog::lab::Request request;
  if (argc != 6 || !iog::lab::read(argv, request)) {
    std::puts(
        "turning_cost: expected layers, azimuths, column, spread or offsets, open or car, and "
        "frames, within the limits of the core");
    return 2;
  }
  return iog::lab::run(request);
}
