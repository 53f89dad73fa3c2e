#include "tools/formats/points/turn_sectors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "lidar/points.hpp"

namespace iog::tools {
namespace {

constexpr double kTurn = lidar::PointsPacket::kPartsPerTurn;

// The shorter way, -1/2 to 1/2 of a turn.
double wrapped(double parts) { return std::remainder(parts, kTurn); }

// Empty if the points lie all around.
std::optional<double> mean_azimuth(std::span<const WirePoint> points) {
  constexpr double kLeast = 0.5;
  double x = 0;
  double y = 0;
  for (const WirePoint& point : points) {
    const double angle = point.first * (2 * std::numbers::pi / kTurn);
    x += std::cos(angle);
    y += std::sin(angle);
  }
  if (std::hypot(x, y) < kLeast * static_cast<double>(points.size())) {
    return std::nullopt;
  }
  return std::atan2(y, x) * (kTurn / (2 * std::numbers::pi));
}

// The mean azimuths of the datagrams, without jumps at a whole turn. Empty if they go to and fro,
// or around more than once.
std::vector<double> mean_azimuths(std::span<const WirePoint> points, std::size_t most) {
  constexpr double kBack = kTurn / 64;
  std::vector<double> means;
  bool goes_left = false;
  bool goes_right = false;
  for (std::size_t first = 0; first < points.size(); first += most) {
    const std::optional<double> mean =
        mean_azimuth(points.subspan(first, std::min(most, points.size() - first)));
    if (!mean) {
      return {};
    }
    const double step = means.empty() ? 0 : wrapped(*mean - means.back());
    goes_left = goes_left || step > kBack;
    goes_right = goes_right || step < -kBack;
    means.push_back(means.empty() ? *mean : means.back() + step);
  }
  const bool is_a_turn = !(goes_left && goes_right) && !means.empty() &&
                         std::abs(means.back() - means.front()) < kTurn / 4 * 5;
  return is_a_turn ? means : std::vector<double>();
}

// One more than there are datagrams.
std::vector<double> borders_of(const std::vector<double>& means) {
  std::vector<double> borders{means.front() - (means[1] - means.front()) / 2};
  for (std::size_t i = 1; i < means.size(); ++i) {
    borders.push_back((means[i - 1] + means[i]) / 2);
  }
  borders.push_back(means.back() + (means.back() - means[means.size() - 2]) / 2);
  const double turned = borders.back() - borders.front();
  const double missing = (kTurn - std::abs(turned)) / 2;
  if (missing > 0 && missing <= kTurn / 8) {
    borders.front() -= std::copysign(missing, turned);
    borders.back() += std::copysign(missing, turned);
  }
  return borders;
}

}  // namespace

std::vector<PointsSector> sectors_of_turn(std::span<const WirePoint> points, std::size_t most) {
  const std::vector<double> means = mean_azimuths(points, most);
  if (means.size() < 2) {
    return {};
  }
  const std::vector<double> borders = borders_of(means);
  std::vector<PointsSector> sectors;
  for (std::size_t i = 0; i < means.size(); ++i) {
    auto [low, high] = std::minmax({borders[i], borders[i + 1]});
    const std::size_t first = i * most;
    for (const WirePoint& point : points.subspan(first, std::min(most, points.size() - first))) {
      const double at = means[i] + wrapped(point.first - means[i]);
      low = std::min(low, at);
      high = std::max(high, at);
    }
    if (high - low > kTurn / 2) {
      return {};
    }
    const double begin = std::floor(low);
    const double in_turn = begin - kTurn * std::floor(begin / kTurn);
    sectors.push_back({.begin = static_cast<std::uint32_t>(in_turn),
                       .width = static_cast<std::uint32_t>(std::ceil(high) - begin)});
  }
  return sectors;
}

}  // namespace iog::tools
