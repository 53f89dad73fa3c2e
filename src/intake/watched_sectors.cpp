#include "intake/watched_sectors.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "geometry/grid.hpp"
#include "lidar/scanner_facts.hpp"
#include "numeric/arctangent.hpp"
#include "numeric/sine_table.hpp"
#include "require/require.hpp"

namespace iog::intake {
namespace {

constexpr std::int32_t kDistanceM = 20;

struct Vector {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

std::int64_t cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }

// Vector from the sensor to the circle in one of 64 directions, in subcells, below 2^20.
Vector from_sensor(const vehicle::Sensor& sensor, std::uint32_t direction) {
  constexpr auto kTable = numeric::kSineTable<kSectors>;
  const std::int64_t distance = sensor.grid.subcells(kDistanceM * 1000);
  const auto along = [&](std::int32_t share, std::int64_t origin_cell) {
    return origin_cell * geometry::kResolution +
           distance * share / (std::int64_t{1} << numeric::kSineFractionBits);
  };
  return {.x = along(kTable.cosine(direction), sensor.grid.origin_column) - sensor.origin.x,
          .y = along(kTable.sine(direction), sensor.grid.origin_row) - sensor.origin.y};
}

// The axes of the sensor on the plane. Their lengths are arbitrary, below 2^31.
struct Axes {
  Vector forward;
  Vector left;

  explicit Axes(const vehicle::Layer& layer)
      : forward{.x = layer.x.forward, .y = layer.y.forward},
        left{.x = layer.x.left, .y = layer.y.left} {}

  [[nodiscard]] bool are_upside_down() const { return cross(forward, left) < 0; }
};

// The azimuth at which the sensor sees d, where d = u forward + v left. Only the direction of (u,
// v) matters, so Cramer's rule is used without its divisor, except for the sign. Products stay
// below 2^52.
std::uint32_t azimuth_ticks(const Axes& axes, const Vector& d, std::uint32_t ticks_per_turn) {
  const std::int64_t sign = axes.are_upside_down() ? -1 : 1;
  const std::int64_t u = sign * cross(d, axes.left);
  const std::int64_t v = sign * cross(axes.forward, d);
  const auto longest = static_cast<std::uint64_t>(std::max(u < 0 ? -u : u, v < 0 ? -v : v));
  const int shift = std::max(0, static_cast<int>(std::bit_width(longest)) - 30);
  const std::uint64_t angle = numeric::angle_of(static_cast<std::int32_t>(u >> shift),
                                                static_cast<std::int32_t>(v >> shift));
  return static_cast<std::uint32_t>((angle * ticks_per_turn + (1U << 15)) >> 16) % ticks_per_turn;
}

bool reaches(const vehicle::Sensor& sensor, const Vector& d) {
  const std::int64_t range = sensor.grid.subcells(static_cast<std::int32_t>(sensor.range.mm()));
  return d.x * d.x + d.y * d.y <= range * range;
}

}  // namespace

SectorView view_of(const vehicle::Sensor& sensor) {
  SectorView view{};
  const std::uint32_t turn = sensor.azimuths.ticks_per_turn();
  const Axes axes(sensor.layers[0]);
  for (std::uint32_t i = 0; i < kSectors; ++i) {
    const Vector begin = from_sensor(sensor, i);
    const Vector end = from_sensor(sensor, (i + 1) % kSectors);
    if (!reaches(sensor, begin) || !reaches(sensor, end)) {
      continue;
    }
    std::uint32_t first = azimuth_ticks(axes, begin, turn);
    std::uint32_t last = azimuth_ticks(axes, end, turn);
    if (axes.are_upside_down()) {
      std::swap(first, last);
    }
    // For a sensor outside the circle, a part of the circle runs the other way round.
    const std::uint32_t width = (last + turn - first) % turn;
    if (width < turn / 2) {
      view[i] = {.first_ticks = static_cast<std::uint16_t>(first),
                 .width_ticks = static_cast<std::uint16_t>(width)};
    }
  }
  return view;
}

WatchedSectors::WatchedSectors(std::span<const vehicle::Sensor> sensors) : sensors_(sensors) {
  require(sensors.size() <= views_.size());
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    views_[i] =
        lidar::facts_of(sensors[i].format).marks_arcs() ? SectorView{} : view_of(sensors[i]);
    blocked_[i] = BlockedSectors(sensors[i], views_[i]);
  }
}

void WatchedSectors::add(std::size_t sensor, const Packet& packet) {
  swept_[sensor].reset();
  if (!lidar::facts_of(sensors_[sensor].format).marks_arcs()) {
    blocked_[sensor].add(packet);
  }
}

std::uint64_t WatchedSectors::find_swept(std::size_t sensor, const Intake& intake) const {
  if (intake.swept_ticks(sensor) == 0) {
    return 0;
  }
  const std::uint32_t most_missing = lidar::turns(sensors_[sensor].format) ? 4 : 1;  // of eight
  std::uint64_t swept = 0;
  for (std::size_t i = 0; i < kSectors; ++i) {
    const lidar::Sector& sector = views_[sensor][i];
    const std::uint32_t most_ticks = most_missing * sector.width_ticks / 8;
    const bool is_swept =
        sector.width_ticks > 0 && !intake.misses_more_than(most_ticks, sensor, sector);
    swept |= std::uint64_t{is_swept ? 1U : 0U} << i;
  }
  return swept;
}

Surroundings WatchedSectors::at_end(const Intake& intake, std::uint64_t now_us) {
  Surroundings surroundings{.unwatched = ~std::uint64_t{0}};
  for (std::size_t sensor = 0; sensor < sensors_.size(); ++sensor) {
    const std::uint64_t swept = swept_by(sensor, intake);
    const BlockedSectors::State state =
        blocked_[sensor].after_frame(intake.swept_ticks(sensor), swept);
    std::uint64_t watched = blocked_[sensor].has_returns() ? swept : 0;
    for (std::size_t i = 0; i < kSectors; ++i) {
      const bool is_fresh = now_us - swept_us_[sensor][i] <= kTurnUs;
      watched |= is_fresh ? was_swept_[sensor] & std::uint64_t{1} << i : 0;
    }
    surroundings.unwatched &= ~(watched & ~state.blocked);
    surroundings.blocked |= state.blocked;
    surroundings.sensors[sensor] = state.blocked == 0            ? Blocked::kNot
                                   : state.blocked == state.seen ? Blocked::kWhole
                                                                 : Blocked::kPartly;
  }
  return surroundings;
}

void WatchedSectors::end_frame(const Intake& intake, std::uint64_t now_us) {
  for (std::size_t sensor = 0; sensor < sensors_.size(); ++sensor) {
    const std::uint64_t swept = swept_by(sensor, intake);
    const std::uint64_t watched = blocked_[sensor].has_returns() ? swept : 0;
    swept_[sensor].reset();
    blocked_[sensor].end_frame(intake.swept_ticks(sensor), swept);
    if (!lidar::turns(sensors_[sensor].format)) {
      continue;
    }
    was_swept_[sensor] |= watched;
    for (std::size_t i = 0; i < kSectors; ++i) {
      swept_us_[sensor][i] = (watched >> i & 1U) != 0 ? now_us : swept_us_[sensor][i];
    }
  }
}

}  // namespace iog::intake
