#include "tools/formats/points/turn_sectors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "lidar/points.hpp"

namespace iog::tools {
namespace {

constexpr std::int64_t kTurn = lidar::PointsPacket::kPartsPerTurn;

// The shorter way, more than -1/2 and at most 1/2 of a turn.
std::int64_t wrapped(std::int64_t parts) {
  const std::int64_t in_turn = (parts % kTurn + kTurn) % kTurn;
  return in_turn > kTurn / 2 ? in_turn - kTurn : in_turn;
}

// Empty if the points lie all around.
std::optional<std::int64_t> mean_azimuth(std::span<const WirePoint> points) {
  constexpr double kLeast = 0.5;
  constexpr double kRadians = 2 * std::numbers::pi / static_cast<double>(kTurn);
  double x = 0;
  double y = 0;
  for (const WirePoint& point : points) {
    const double angle = point.first * kRadians;
    x += std::cos(angle);
    y += std::sin(angle);
  }
  if (std::hypot(x, y) < kLeast * static_cast<double>(points.size())) {
    return std::nullopt;
  }
  return std::llround(std::atan2(y, x) / kRadians);
}

// The mean azimuths of the datagrams, without jumps at a whole turn. Empty if they stand still, go
// to and fro, or go around more than once.
std::vector<std::int64_t> mean_azimuths(std::span<const WirePoint> points, std::size_t most,
                                        std::int64_t width) {
  const std::int64_t back = width / 64;
  std::vector<std::int64_t> means;
  bool goes_left = false;
  bool goes_right = false;
  for (std::size_t first = 0; first < points.size(); first += most) {
    const std::optional<std::int64_t> mean =
        mean_azimuth(points.subspan(first, std::min(most, points.size() - first)));
    if (!mean) {
      return {};
    }
    const std::int64_t step = means.empty() ? 0 : wrapped(*mean - means.back());
    goes_left = goes_left || step > back;
    goes_right = goes_right || step < -back;
    means.push_back(means.empty() ? *mean : means.back() + step);
  }
  const std::int64_t turned = means.empty() ? 0 : std::abs(means.back() - means.front());
  const bool is_a_turn = !(goes_left && goes_right) && turned > back && turned < kTurn / 4 * 5;
  return is_a_turn ? means : std::vector<std::int64_t>();
}

// Of directions that no jump at a whole turn separates.
struct Field {
  std::int64_t low;
  std::int64_t high;
  bool is_turn;
};

Field field_around(std::int64_t azimuth, const PointsSector& field) {
  const std::int64_t middle = std::int64_t{field.begin} + field.width / 2;
  const std::int64_t low = azimuth + wrapped(middle - azimuth) - field.width / 2;
  return {low, low + field.width, field.width >= kTurn};
}

// One more than there are datagrams.
std::vector<std::int64_t> borders_of(const std::vector<std::int64_t>& means, const Field& field) {
  std::vector<std::int64_t> borders{means.front() - ((means[1] - means.front()) >> 1)};
  for (std::size_t i = 1; i < means.size(); ++i) {
    borders.push_back((means[i - 1] + means[i]) >> 1);
  }
  borders.push_back(means.back() + ((means.back() - means[means.size() - 2]) >> 1));
  if (!field.is_turn) {
    const bool is_left = means.back() > means.front();
    borders.front() = is_left ? field.low : field.high;
    borders.back() = is_left ? field.high : field.low;
    return borders;
  }
  const std::int64_t turned = borders.back() - borders.front();
  const std::int64_t missing = std::max<std::int64_t>(kTurn - std::abs(turned), 0);
  const std::int64_t sign = turned < 0 ? -1 : 1;
  borders.front() -= sign * (missing >> 1);
  borders.back() += sign * (missing - (missing >> 1));
  return borders;
}

}  // namespace

std::vector<PointsSector> sectors_of_scan(std::span<const WirePoint> points, std::size_t most,
                                          const PointsSector& scanned) {
  const std::vector<std::int64_t> means = mean_azimuths(points, most, scanned.width);
  if (means.empty()) {
    return {};
  }
  const Field field = field_around(means[means.size() / 2], scanned);
  const std::vector<std::int64_t> borders = borders_of(means, field);
  std::vector<PointsSector> sectors;
  std::int64_t covered = 0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    auto [low, high] = std::minmax({borders[i], borders[i + 1]});
    const std::size_t first = i * most;
    for (const WirePoint& point : points.subspan(first, std::min(most, points.size() - first))) {
      const std::int64_t at = means[i] + wrapped(point.first - means[i]);
      if (field.is_turn || (at >= field.low && at <= field.high)) {
        low = std::min(low, at);
        high = std::max(high, at);
      }
    }
    covered += high - low;
    if (high - low > kTurn / 2 || (!field.is_turn && 2 * covered > 3 * (field.high - field.low))) {
      return {};
    }
    sectors.push_back({.begin = static_cast<std::uint32_t>((low % kTurn + kTurn) % kTurn),
                       .width = static_cast<std::uint32_t>(high - low)});
  }
  return sectors;
}

}  // namespace iog::tools
