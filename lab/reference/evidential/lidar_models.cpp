#include "lab/reference/evidential/lidar_models.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace iog::lab::reference::evidential {
namespace {

// The share of a standard normal distribution below x.
double normal_below(double x) { return std::erfc(-x * std::sqrt(0.5)) / 2; }

std::vector<SourceMass> precise_masses(std::span<const double> echoes_m, double nearest_m,
                                       double cell_m, std::size_t cells,
                                       const LidarParameters& parameters) {
  std::vector<SourceMass> masses(cells);
  const double before = std::floor(nearest_m / cell_m);
  for (std::size_t i = 0; i < cells && static_cast<double>(i) < before; ++i) {
    masses[i].free = parameters.free_mass;
  }
  for (const double echo_m : echoes_m) {
    if (const auto i = static_cast<std::size_t>(echo_m / cell_m); i < cells) {
      double& occupied = masses[i].occupied;
      occupied = parameters.model == LidarModel::kReinforced
                     ? 1 - (1 - occupied) * (1 - parameters.occupied_mass)
                     : parameters.occupied_mass;
    }
  }
  return masses;
}

std::vector<SourceMass> imprecise_masses(std::span<const double> echoes_m, double nearest_m,
                                         double cell_m, std::size_t cells,
                                         const LidarParameters& parameters) {
  std::vector<SourceMass> masses(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    const double low_m = static_cast<double>(i) * cell_m;
    const double high_m = low_m + cell_m;
    const auto share_below = [&](double limit_m, double echo_m) {
      return normal_below((limit_m - echo_m) / parameters.sigma_m);
    };
    masses[i].free = parameters.free_mass * (1 - share_below(high_m, nearest_m));
    for (const double echo_m : echoes_m) {
      const double inside = share_below(high_m, echo_m) - share_below(low_m, echo_m);
      masses[i] = joined(masses[i], {.occupied = parameters.occupied_mass * inside});
    }
  }
  return masses;
}

SourceMass between(const SourceMass& one, const SourceMass& other, double share) {
  return {.free = one.free + share * (other.free - one.free),
          .occupied = one.occupied + share * (other.occupied - one.occupied)};
}

}  // namespace

std::vector<SourceMass> sector_masses(std::span<const double> echoes_m, double cell_m,
                                      std::size_t cells, const LidarParameters& parameters) {
  const auto nearest = std::ranges::min_element(echoes_m);
  const double nearest_m =
      nearest == echoes_m.end() ? std::numeric_limits<double>::infinity() : *nearest;
  return parameters.model == LidarModel::kImprecise
             ? imprecise_masses(echoes_m, nearest_m, cell_m, cells, parameters)
             : precise_masses(echoes_m, nearest_m, cell_m, cells, parameters);
}

PolarGrid::PolarGrid(const Layout& layout, std::span<const std::vector<double>> echoes_m,
                     const LidarParameters& parameters)
    : layout_(layout) {
  masses_.reserve(layout.sectors * layout.cells);
  for (const std::vector<double>& echoes : echoes_m) {
    const auto sector = sector_masses(echoes, layout.cell_m, layout.cells, parameters);
    masses_.insert(masses_.end(), sector.begin(), sector.end());
  }
}

SourceMass PolarGrid::at(double range_m, double azimuth_rad) const {
  const double cell = std::max(range_m / layout_.cell_m - 0.5, 0.0);
  const double sector = (azimuth_rad - layout_.first_rad) / layout_.step_rad;
  if (!(sector >= 0 && sector < static_cast<double>(layout_.sectors - 1) &&
        cell < static_cast<double>(layout_.cells - 1))) {
    return {};
  }
  const auto s = static_cast<std::size_t>(sector);
  const auto c = static_cast<std::size_t>(cell);
  const double further = cell - static_cast<double>(c);
  const auto along = [&](std::size_t of) {
    return between(this->cell(of, c), this->cell(of, c + 1), further);
  };
  return between(along(s), along(s + 1), sector - static_cast<double>(s));
}

SourceMass joined(const SourceMass& one, const SourceMass& other) {
  const double one_unknown = 1 - one.free - one.occupied;
  const double other_unknown = 1 - other.free - other.occupied;
  const double agreed = 1 - one.free * other.occupied - one.occupied * other.free;
  return {
      .free = (one.free * (other.free + other_unknown) + one_unknown * other.free) / agreed,
      .occupied = (one.occupied * (other.occupied + other_unknown) + one_unknown * other.occupied) /
                  agreed};
}

}  // namespace iog::lab::reference::evidential
