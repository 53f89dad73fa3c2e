// What one lidar's scan says of free and occupied space: the SourceGrid, in polar cells and from
// there in world cells (Kurdej 2015, sections 4.5 and 5.1).
//
// A sector is an angle at which a lidar measures, with all of its layers. Its cells are counted
// from the sensor outwards: cell i holds ranges from i to i + 1 times the cell's length.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace iog::lab::reference::evidential {

// Masses of {F} and {O}; the rest is ignorance, or by the conjunctive rule conflict.
struct SourceMass {
  double free = 0;
  double occupied = 0;
};

enum class LidarModel : std::uint8_t {
  kMultiEcho,   // algorithm 1: however many echoes a cell has
  kReinforced,  // section 4.5.2.2: each echo of a cell makes it surer
  // Section 4.5.2.3 without its continuum: reinforced, and an echo speaks for the cells around it
  // by the share of its normal distribution that lies in each; a cell is free by the share that
  // lies beyond it.
  kImprecise,
};

struct LidarParameters {
  LidarModel model = LidarModel::kMultiEcho;
  double free_mass = 0.70;      // mu_F of table 7.1
  double occupied_mass = 0.80;  // mu_O
  double sigma_m = 0.10;        // of a range, for the imprecise model
};

// The masses of a sector's cells of these echoes, in any order. Free is what lies before the
// nearest one; without an echo that is all, as every obstacle is taken to reflect.
[[nodiscard]] std::vector<SourceMass> sector_masses(std::span<const double> echoes_m, double cell_m,
                                                    std::size_t cells,
                                                    const LidarParameters& parameters);

// A scan: sectors of equal width next to each other.
class PolarGrid {
 public:
  struct Layout {
    double first_rad = 0;  // where the first sector's middle is, counter-clockwise from ahead
    double step_rad = 0;
    std::size_t sectors = 0;
    double cell_m = 0;
    std::size_t cells = 0;
  };

  // echoes_m: by sector.
  PolarGrid(const Layout& layout, std::span<const std::vector<double>> echoes_m,
            const LidarParameters& parameters);

  // Interpolated bilinearly between the middles of cells and sectors, from the sensor to the last
  // middle. Nothing is known outside of the sectors' middles.
  [[nodiscard]] SourceMass at(double range_m, double azimuth_rad) const;

 private:
  [[nodiscard]] const SourceMass& cell(std::size_t sector, std::size_t number) const {
    return masses_[sector * layout_.cells + number];
  }

  Layout layout_;
  std::vector<SourceMass> masses_;  // sector after sector
};

// Several lidars of one cell: the conjunctive rule, normalised (equation 5.1, and 5.2 without a
// map). Not both may be certain and contradict each other.
[[nodiscard]] SourceMass joined(const SourceMass& one, const SourceMass& other);

}  // namespace iog::lab::reference::evidential
