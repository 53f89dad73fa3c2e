#include "tools/simulate/scenes/hills_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "numeric/elementary.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/scenes/hills.hpp"

namespace iog::tools {
namespace {

// Where the road's slope changes, from its begin on: between two of these it does so evenly.
struct Bend {
  double station;
  double slope;
};
constexpr std::array kBends{
    Bend{0, 0},      Bend{10, 0},     Bend{25, 0.1763}, Bend{45, 0.1763},
    Bend{60, 0},     Bend{75, -0.13}, Bend{95, -0.13},  Bend{108, 0},
    Bend{112, 0.15}, Bend{122, 0.15}, Bend{126, 0},     Bend{140, 0},
    Bend{155, 0},    Bend{185, 0},    Bend{200, 0},     Bend{kHillsActM, 0}};
constexpr std::size_t kLastFall = 12;  // and the one behind it: as steep as leads back to 0

// A point of a cross section, and the next one, between which the ground is even.
struct Corner {
  double aside;
  double height;
};
// To the left: the road, which falls by 2 %; a verge; a bank; what is behind it.
constexpr std::array kLeft{Corner{0, 0},       Corner{kHillsLeftEdge, -0.078},
                           Corner{4.6, -0.15}, Corner{7.5, -0.1},
                           Corner{12.5, 2.4},  Corner{40, 3.4},
                           Corner{300, 3.4}};
// To the right: the road with its parking strip; the kerb, whose face is a solid; the pavement; a
// verge; a bank; what is behind it.
constexpr double kGutter = -0.02 * (kHillsKerb - kHillsKerbWidth / 2);
constexpr std::array kRight{Corner{0, 0},
                            Corner{kHillsKerb - kHillsKerbWidth / 2, kGutter},
                            Corner{kHillsKerb + kHillsKerbWidth / 2, kGutter + kHillsKerbHeight},
                            Corner{8.3, kGutter + kHillsKerbHeight + 0.046},
                            Corner{11.3, -0.2},
                            Corner{17, -2.4},
                            Corner{40, -3},
                            Corner{300, -3}};

// Tufts and molehills grow from where the verge begins.
constexpr double kRough = 0.05;
constexpr double kRoughFromLeft = 4.3;
constexpr double kRoughFromRight = 8.5;

double height_of(std::span<const Corner> section, double aside) {
  const auto next = std::ranges::upper_bound(section, aside, {}, &Corner::aside);
  if (next == section.end()) {
    return section.back().height;
  }
  const Corner& a = *(next - 1);
  return a.height + (aside - a.aside) / (next->aside - a.aside) * (next->height - a.height);
}

double roughness(double station, double left) {
  const double beside = left > 0 ? left - kRoughFromLeft : -left - kRoughFromRight;
  if (beside <= 0) {
    return 0;
  }
  constexpr double kTurn = 2 * numeric::kPi;
  return std::min(1.0, beside) * kRough * numeric::sin(kTurn * station / 2.9) *
         numeric::sin(kTurn * (left + 0.4 * station) / 2.3);
}

// The height that is gained by a bend's end, of which `way` metres have been gone.
double gained(const Bend& a, const Bend& b, double way) {
  return way * (a.slope + (b.slope - a.slope) * way / (2 * (b.station - a.station)));
}

std::array<Bend, kBends.size()> closed_bends() {
  std::array<Bend, kBends.size()> bends = kBends;
  double height = 0;
  for (std::size_t i = 1; i < bends.size(); ++i) {
    height += gained(bends[i - 1], bends[i], bends[i].station - bends[i - 1].station);
  }
  const double length = (bends[kLastFall + 2].station - bends[kLastFall - 1].station +
                         bends[kLastFall + 1].station - bends[kLastFall].station) /
                        2;
  bends[kLastFall].slope = -height / length;
  bends[kLastFall + 1].slope = -height / length;
  return bends;
}

}  // namespace

double HillsGround::along(double station) const {
  static const std::array<Bend, kBends.size()> bends = closed_bends();
  const double act = std::floor(station / kHillsActM);
  Random random(seed_, 40 + static_cast<std::uint64_t>(static_cast<std::int64_t>(act)));
  const double scale = random.between(0.8, 1);
  const double in_act = station - act * kHillsActM;
  double height = 0;
  for (std::size_t i = 1; i < bends.size(); ++i) {
    const Bend& a = bends[i - 1];
    const Bend& b = bends[i];
    const double way = std::min(in_act, b.station) - a.station;
    if (way <= 0) {
      break;
    }
    height += gained(a, b, way);
  }
  return scale * height;
}

double HillsGround::across(double station, double left) {
  return (left >= 0 ? height_of(kLeft, left) : height_of(kRight, -left)) + roughness(station, left);
}

}  // namespace iog::tools
