#include "tools/mount/plane_starts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace iog::tools {
namespace {

constexpr int kStepDeg = 2;
constexpr std::size_t kStarts = 8;
constexpr double kLayerM = 0.15;
constexpr auto kLayers = static_cast<std::size_t>(2 * kMostHeightErrorM / kLayerM);

struct Start {
  double weight = 0;
  GroundPlane plane;
};

// Of planes tilted so, the one with the most in two layers, between which it lies.
Start best_of(std::span<const RoadReturn> returns, const MetreWeights& weights, double lowest_m,
              double along, double across) {
  std::array<double, kLayers> layers{};
  for (const RoadReturn& point : returns) {
    const double layer = (point.z_m - along * point.x_m - across * point.y_m - lowest_m) / kLayerM;
    if (layer >= 0 && layer < static_cast<double>(kLayers)) {
      layers[static_cast<std::size_t>(layer)] += weights.of(point);
    }
  }
  Start best;
  for (std::size_t i = 1; i < kLayers; ++i) {
    if (const double weight = layers[i - 1] + layers[i]; weight > best.weight) {
      const double at_m = lowest_m + static_cast<double>(i) * kLayerM;
      best = {.weight = weight, .plane = {.along = along, .across = across, .below_m = -at_m}};
    }
  }
  return best;
}

double slope_of(int degrees) { return std::tan(degrees * std::numbers::pi / 180); }

}  // namespace

MetreWeights::MetreWeights(std::span<const RoadReturn> returns) {
  for (const RoadReturn& point : returns) {
    ++counts_[metre_of(point)];
  }
}

std::size_t MetreWeights::metre_of(const RoadReturn& point) {
  return std::min(kMetres - 1, static_cast<std::size_t>(std::hypot(point.x_m, point.y_m)));
}

std::size_t MetreWeights::metres() const {
  constexpr int kSome = 10;
  return static_cast<std::size_t>(
      std::ranges::count_if(counts_, [](int count) { return count >= kSome; }));
}

std::vector<GroundPlane> starts_of(std::span<const RoadReturn> returns, double expected_m) {
  const MetreWeights weights(returns);
  std::vector<Start> starts;
  for (int pitch = -kMostTiltDeg; pitch <= kMostTiltDeg; pitch += kStepDeg) {
    for (int roll = -kMostTiltDeg; roll <= kMostTiltDeg; roll += kStepDeg) {
      starts.push_back(best_of(returns, weights, -expected_m - kMostHeightErrorM, slope_of(pitch),
                               slope_of(roll)));
    }
  }
  std::ranges::stable_sort(starts, std::ranges::greater(), &Start::weight);
  std::vector<GroundPlane> planes(kStarts);
  std::ranges::transform(starts.begin(), starts.begin() + kStarts, planes.begin(), &Start::plane);
  return planes;
}

}  // namespace iog::tools
