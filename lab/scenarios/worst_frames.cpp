#include "lab/scenarios/worst_frames.hpp"

#include <algorithm>
#include <array>

#include "lidar/ibeo_lux.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/simulate/scanners/lux_burst.hpp"
#include "tools/simulate/scanners/lux_scanner.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "vehicle/beam.hpp"

namespace iog::lab {
namespace {

using vehicle::Sensor;

constexpr std::int32_t kTurnTicks = lidar::IbeoLux::kTicksPerTurn;
constexpr std::uint16_t kFarCm = 4900;       // on the grid in every direction, for every scanner
constexpr std::uint16_t kNearCm = 200;       // off the car in every direction
constexpr std::uint16_t kBeyondCm = 20'000;  // a LUX sees no further
constexpr std::size_t kBeams = tools::kLuxAzimuths * tools::kLuxLayers;

// Layers 2 and 3 look up, and are still below 2.20 m at the end of their range: the height band
// cuts nothing off them.
std::uint8_t upper_layer(std::size_t i) { return static_cast<std::uint8_t>(2 + i % 2); }

std::int16_t raster_ticks(std::size_t column) {
  return static_cast<std::int16_t>(tools::kLuxEdgeTicks -
                                   static_cast<std::int32_t>(column) * tools::kLuxStepTicks);
}

std::uint16_t whole_cm(double range_cm) { return static_cast<std::uint16_t>(range_cm); }

bool is_used(const Sensor& sensor, const tools::LuxPoint& point) {
  const auto azimuth = static_cast<std::uint16_t>((point.angle_ticks + kTurnTicks) % kTurnTicks);
  const lidar::ScanPoint scan_point{
      .range_mm = point.range_cm * 10U, .azimuth_ticks = azimuth, .layer = point.layer};
  const vehicle::Beam beam = vehicle::aim(sensor, point.layer, azimuth);
  return vehicle::classify(sensor, beam, scan_point).fate == vehicle::Fate::kUsed;
}

// The furthest range, up to 49 m, at which an echo of this beam is inside the height band.
std::uint16_t furthest_cm(const Sensor& sensor, tools::LuxPoint point) {
  std::uint16_t used = kNearCm;
  std::uint16_t out = kFarCm + 1;
  while (used + 1 < out) {
    point.range_cm = static_cast<std::uint16_t>((used + out) / 2);
    (is_used(sensor, point) ? used : out) = point.range_cm;
  }
  return used;
}

// The scan of a LUX: add(point, column, furthest range) for each beam, without its range.
template <typename Add>
void for_each_beam(const Sensor& sensor, Add&& add) {
  for (std::size_t column = 0; column < tools::kLuxAzimuths; ++column) {
    for (std::size_t layer = 0; layer < tools::kLuxLayers; ++layer) {
      const tools::LuxPoint point{.layer = static_cast<std::uint8_t>(layer),
                                  .angle_ticks = raster_ticks(column)};
      add(point, column, furthest_cm(sensor, point));
    }
  }
}

std::vector<tools::LuxPoint> full_range(const Sensor& sensor, tools::Random& /*random*/) {
  std::vector<tools::LuxPoint> points;
  for_each_beam(sensor, [&](tools::LuxPoint point, std::size_t /*column*/, std::uint16_t furthest) {
    point.range_cm = furthest;
    points.push_back(point);
  });
  return points;
}

std::vector<tools::LuxPoint> random_ranges(const Sensor& sensor, tools::Random& random) {
  std::vector<tools::LuxPoint> points;
  for_each_beam(sensor, [&](tools::LuxPoint point, std::size_t /*column*/, std::uint16_t furthest) {
    point.range_cm = whole_cm(random.between(kNearCm, furthest));
    points.push_back(point);
  });
  return points;
}

// One, two, three and four quarters of the layer's furthest range: about 12, 25, 37 and 49 m.
std::vector<tools::LuxPoint> layers_apart(const Sensor& sensor, tools::Random& random) {
  const std::size_t turn = random.below(tools::kLuxLayers);
  std::vector<tools::LuxPoint> points;
  for_each_beam(sensor, [&](tools::LuxPoint point, std::size_t column, std::uint16_t furthest) {
    const std::size_t quarters = 1 + (turn + column + point.layer) % tools::kLuxLayers;
    point.range_cm = static_cast<std::uint16_t>(furthest * quarters / tools::kLuxLayers);
    points.push_back(point);
  });
  return points;
}

std::vector<tools::LuxPoint> beyond_range(const Sensor& sensor, tools::Random& /*random*/) {
  std::vector<tools::LuxPoint> points;
  for_each_beam(sensor,
                [&](tools::LuxPoint point, std::size_t /*column*/, std::uint16_t /*furthest*/) {
                  point.range_cm = kBeyondCm;
                  points.push_back(point);
                });
  return points;
}

std::vector<tools::LuxPoint> three_echoes(const Sensor& sensor, tools::Random& /*random*/) {
  constexpr std::uint16_t kApartCm = 100;
  std::vector<tools::LuxPoint> points;
  for_each_beam(sensor, [&](tools::LuxPoint point, std::size_t /*column*/, std::uint16_t furthest) {
    for (point.echo = 0; point.echo < lidar::IbeoLux::kMaxEchoes; ++point.echo) {
      const int behind = lidar::IbeoLux::kMaxEchoes - 1 - point.echo;
      point.range_cm = static_cast<std::uint16_t>(furthest - behind * kApartCm);
      points.push_back(point);
    }
  });
  return points;
}

std::vector<tools::LuxPoint> missing_returns(const Sensor& sensor, tools::Random& random) {
  std::vector<tools::LuxPoint> points;
  for_each_beam(sensor, [&](tools::LuxPoint point, std::size_t /*column*/, std::uint16_t furthest) {
    point.range_cm = furthest;
    if (random.chance(0.5)) {
      points.push_back(point);
    }
  });
  return points;
}

// As many points as a scan has beams, at 49 m, of directions that no half degree meets.
std::vector<tools::LuxPoint> random_azimuths(const Sensor& /*sensor*/, tools::Random& random) {
  std::vector<tools::LuxPoint> points;
  for (std::size_t i = 0; i < kBeams; ++i) {
    const std::size_t step = random.below(tools::kLuxAzimuths - 1);
    const std::size_t between = 1 + random.below(tools::kLuxStepTicks - 1);
    points.push_back({.layer = upper_layer(i),
                      .angle_ticks = static_cast<std::int16_t>(raster_ticks(step) -
                                                               static_cast<std::int32_t>(between)),
                      .range_cm = kFarCm});
  }
  return points;
}

// Every direction of the sector, those whose lines cross the fewest borders of cells first: along
// the rows or columns of the grid. Last are the diagonals.
std::vector<std::int16_t> from_straight_to_diagonal(const Sensor& sensor) {
  const auto borders = [&](std::int16_t ticks) {
    const auto azimuth = static_cast<std::uint16_t>((ticks + kTurnTicks) % kTurnTicks);
    const vehicle::BeamLine line = vehicle::aim(sensor, upper_layer(0), azimuth).line;
    return line.x().length() + line.y().length();
  };
  std::vector<std::int16_t> directions;
  for (std::int32_t ticks = -tools::kLuxEdgeTicks; ticks <= tools::kLuxEdgeTicks; ++ticks) {
    directions.push_back(static_cast<std::int16_t>(ticks));
  }
  std::ranges::stable_sort(directions, {}, borders);
  return directions;
}

// That many first echoes at one range, dealt out among as many of the most diagonal directions as a
// layer has.
std::vector<tools::LuxPoint> diagonals(const Sensor& sensor, std::size_t count,
                                       std::uint16_t range_cm) {
  const std::vector<std::int16_t> directions = from_straight_to_diagonal(sensor);
  std::vector<tools::LuxPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back({.layer = upper_layer(i),
                      .angle_ticks = directions[directions.size() - 1 - i % tools::kLuxAzimuths],
                      .range_cm = range_cm});
  }
  return points;
}

std::vector<tools::LuxPoint> diagonal(const Sensor& sensor, tools::Random& /*random*/) {
  return diagonals(sensor, kBeams, kFarCm);
}

// Two packets with the same first and last point are one that came twice; the pulse width, which
// nobody looks at, tells these apart.
std::vector<tools::LuxPoint> one_direction(const Sensor& sensor, tools::Random& random) {
  const std::int16_t straight = from_straight_to_diagonal(sensor).front();
  std::vector<tools::LuxPoint> points;
  for (std::size_t i = 0; i < kBeams; ++i) {
    points.push_back({.layer = upper_layer(i),
                      .angle_ticks = straight,
                      .range_cm = whole_cm(random.between(kFarCm - kNearCm, kFarCm)),
                      .pulse_width_cm = static_cast<std::uint16_t>(i)});
  }
  return points;
}

std::vector<tools::LuxPoint> short_beams(const Sensor& sensor, tools::Random& /*random*/) {
  std::vector<tools::LuxPoint> points;
  for (std::size_t i = 0; i < sensor.max_points_per_scan; ++i) {
    tools::LuxPoint point{.layer = upper_layer(i),
                          .angle_ticks = raster_ticks(i % tools::kLuxAzimuths)};
    point.range_cm = static_cast<std::uint16_t>(sensor.range_min_mm / 10);
    while (!is_used(sensor, point)) {
      ++point.range_cm;
    }
    points.push_back(point);
  }
  return points;
}

std::vector<tools::LuxPoint> flood(const Sensor& sensor, tools::Random& /*random*/) {
  return diagonals(sensor, sensor.max_points_per_scan,
                   static_cast<std::uint16_t>(sensor.range.mm() / 10));
}

constexpr auto kWorstFrames = std::to_array<WorstFrame>({
    {"full_range", "long lines: every beam to 49 m, or to where it leaves the height band", false,
     full_range},
    {"random_ranges", "nothing shared by the layers of a direction but the line", false,
     random_ranges},
    {"layers_apart", "the layers of a direction end at four ranges, in another order in the next",
     false, layers_apart},
    {"beyond_range", "echoes at 200 m: carved to 50 m, cut off at the grid and the height band",
     false, beyond_range},
    {"three_echoes", "the most marks: three echoes of every beam, all of them far", false,
     three_echoes},
    {"missing_returns", "every second beam is missing, at random, so that no group is whole", false,
     missing_returns},
    {"random_azimuths", "no table and no shared line: every beam has a direction of its own", true,
     random_azimuths},
    {"diagonal", "the most cells a metre: every beam to 49 m along a diagonal of the grid", true,
     diagonal},
    {"one_direction", "few tiles: all beams of a sensor through the same row of cells", true,
     one_direction},
    {"short_beams", "points that carve next to nothing, as many as a scan may have", true,
     short_beams},
    {"flood", "as many first echoes as a scan may have, all to 50 m along a diagonal", true, flood},
});

std::string known_names() {
  std::string names;
  for (const WorstFrame& worst : kWorstFrames) {
    names += (names.empty() ? "" : ", ") + std::string(worst.name);
  }
  return names;
}

// Some points are nearer, or farther away where they are near already: all stay points that are
// believed.
void vary(std::vector<tools::LuxPoint>& points, tools::Random& random) {
  constexpr std::size_t kEach = 4;
  constexpr std::uint16_t kNearestCm = 1'000;
  for (std::size_t i = 0; i < points.size(); i += kEach) {
    const auto by_cm = static_cast<std::uint16_t>(random.below(8));
    std::uint16_t& range_cm = points[i].range_cm;
    range_cm =
        static_cast<std::uint16_t>(range_cm > kNearestCm ? range_cm - by_cm : range_cm + by_cm);
  }
}

}  // namespace

std::span<const WorstFrame> all_worst_frames() { return kWorstFrames; }

const WorstFrame& find_worst_frame(std::string_view name) {
  const auto* const found = std::ranges::find(kWorstFrames, name, &WorstFrame::name);
  if (found == kWorstFrames.end()) {
    throw tools::UsageError("no worst frame '" + std::string(name) + "'; the known ones are " +
                            known_names());
  }
  return *found;
}

std::vector<tools::CapturedDatagram> worst_datagrams(const WorstFrame& worst, std::uint64_t seed,
                                                     std::uint32_t frame) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  return tools::lux_burst(car, frame, [&](std::size_t sensor) {
    tools::Random random(seed, std::uint64_t{frame} * vehicle::kMaxSensors + sensor);
    std::vector<tools::LuxPoint> points = worst.points(car.vehicle->sensors[sensor], random);
    vary(points, random);
    return points;
  });
}

tools::PoseFeed poses_of_worst_frames(std::uint32_t frames) {
  constexpr double kSpeed = 15;
  constexpr std::uint64_t kPeriodUs = 10'000;
  constexpr std::uint32_t kAgeUs = 2'000;
  std::vector<tools::PoseSample> samples;
  for (std::uint64_t at_us = 0; at_us <= (frames + 1) * tools::kLuxPeriodUs; at_us += kPeriodUs) {
    samples.push_back({.time_us = tools::kDriveStartUs + at_us,
                       .age_us = kAgeUs,
                       .x_m = kSpeed * static_cast<double>(at_us) / 1e6,
                       .speed_mps = kSpeed,
                       .sigma_m = 0.02,
                       .sigma_heading_rad = 0.001});
  }
  return tools::PoseFeed(std::move(samples));
}

}  // namespace iog::lab
