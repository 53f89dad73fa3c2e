#include "tools/car/defaults.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "lidar/formats.hpp"
#include "lidar/scanner_facts.hpp"
#include "tools/car/tables.hpp"
#include "vehicle/derived.hpp"

namespace iog::description {
namespace {

using lidar::facts_of;

// By the beginnings of the types' names; a LUX's is that of its TCP server.
constexpr std::uint16_t kPortOfLux = 12'002;
constexpr std::array<std::pair<std::string_view, std::uint16_t>, 6> kUsualPorts{{
    {"continental", 42'102},
    {"hesai", 2'368},
    {"mavlink", 14'551},
    {"ouster", 7'502},
    {"points", 9'870},
    {"velodyne", 2'368},
}};

// A turn of so many layers hits more cells than the tracker has room for.
constexpr std::size_t kDenseLayers = 40;

// The farthest with cells of 50 mm; a tilted mirror's beams are longer than its range.
constexpr std::uint16_t kFineCellMm = 50;
constexpr std::uint32_t kFineRangeMm = 72'407;
constexpr std::uint32_t kFineTiltedRangeMm = 71'293;

// Below that a unit sees little of the ground.
constexpr double kLowestOverGroundM = 0.5;

bool turns(const SensorConfig& sensor) { return facts_of(sensor.format).turns; }

bool shares_lines(const SensorConfig& sensor) {
  return turns(sensor) && sensor.mount.pitch_deg == 0 && sensor.mount.roll_deg == 0;
}

bool is_dense(const SensorConfig& sensor) {
  const std::size_t layers = std::max(facts_of(sensor.format).layers, sensor.lasers.size());
  return turns(sensor) && layers >= kDenseLayers &&
         sensor.format != lidar::kFormat<lidar::VelodyneVls128>;
}

}  // namespace

std::uint32_t usual_turn_us(const SensorConfig& sensor) {
  return sensor.mode.is_valid() ? 1'000'000 / sensor.mode.turns_per_second : 100'000;
}

std::uint16_t usual_port(std::string_view type) {
  const auto* const found = std::ranges::find_if(
      kUsualPorts, [&](const auto& port) { return type.starts_with(port.first); });
  return found == kUsualPorts.end() ? kPortOfLux : found->second;
}

double top_m_over(double mount_z_m) { return std::max(2.20, std::min(mount_z_m + 0.20, 10.0)); }

std::uint32_t usual_range_max_mm(const SensorConfig& sensor, std::uint16_t cell_mm) {
  const bool is_tilted = facts_of(sensor.format).has_beam_tilt;
  return cell_mm > kFineCellMm
             ? sensor.range_max_mm
             : std::min(sensor.range_max_mm, is_tilted ? kFineTiltedRangeMm : kFineRangeMm);
}

std::optional<GroundConfig> usual_ground(const SensorConfig& sensor) {
  if (!turns(sensor) || !(sensor.mount.z_m >= kLowestOverGroundM)) {
    return std::nullopt;
  }
  return GroundConfig{.top_m = top_m_over(sensor.mount.z_m)};
}

MovedConfig usual_moved(const std::optional<GroundConfig>& ground) {
  if (!ground) {
    return {};
  }
  return {.low_m = std::max(MovedConfig{}.low_m, ground->low_m + 0.1), .tall_m = 0.4};
}

vehicle::Grids usual_grids(const Description& car, std::span<const SensorConfig> sensors) {
  const bool has_arcs = std::ranges::any_of(
      sensors, [](const SensorConfig& sensor) { return facts_of(sensor.format).marks_arcs(); });
  return has_arcs || grid_of(car.grid) != geometry::Grid{} ||
                 car.rule != vehicle::FusionRule::kHitsWin ||
                 car.quantisation != index::Quantisation::kBlurring
             ? vehicle::Grids::kIndexes
             : vehicle::Grids::kBoth;
}

std::uint32_t usual_frame_period_us(std::span<const SensorConfig> sensors, vehicle::Grids grids) {
  const bool are_dense = std::ranges::any_of(sensors, is_dense);
  if (vehicle::have_classes(grids) && are_dense) {
    return Description{}.frame_period_us;
  }
  std::uint32_t longest_us = 0;
  for (const SensorConfig& sensor : sensors) {
    if (turns(sensor)) {
      longest_us = std::max(longest_us, usual_turn_us(sensor));
    } else if (!facts_of(sensor.format).marks_arcs()) {
      return Description{}.frame_period_us;
    }
  }
  return longest_us == 0 ? Description{}.frame_period_us : longest_us + longest_us / 2;
}

void share_turn_lines(std::span<SensorConfig> sensors, std::uint16_t cell_mm) {
  const auto lines_with = [&](std::uint32_t most) {
    return std::accumulate(sensors.begin(), sensors.end(), std::uint32_t{0},
                           [&](std::uint32_t sum, const SensorConfig& sensor) {
                             const bool is_said = sensor.azimuth_steps_per_turn != 0;
                             return sum + (!shares_lines(sensor) ? 0
                                           : is_said             ? steps_of(sensor, cell_mm)
                                                     : std::min(steps_of(sensor, cell_mm), most));
                           });
  };
  std::uint32_t most = vehicle::kMostAzimuthSteps;
  while (lines_with(most) > vehicle::kMaxTurnLines && most > vehicle::kFewestAzimuthSteps) {
    most /= 2;
  }
  for (SensorConfig& sensor : sensors) {
    if (shares_lines(sensor) && sensor.azimuth_steps_per_turn == 0) {
      sensor.azimuth_steps_per_turn = std::min(steps_of(sensor, cell_mm), most);
    }
  }
}

}  // namespace iog::description
