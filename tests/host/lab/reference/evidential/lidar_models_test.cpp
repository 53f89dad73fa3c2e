// The lidar models of the thesis's section 4.5, by hand.
#include "lab/reference/evidential/lidar_models.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "lab/reference/evidential/perception.hpp"
#include "lab/reference/evidential/random_mass.hpp"

namespace iog::lab::reference::evidential {
namespace {

using tests::random_share;

constexpr std::array kNoEcho = std::array<double, 0>{};

// Algorithm 1: free before the nearest echo alone, 0.8 in the cell of an echo however many it has,
// and between echoes nothing.
TEST(SectorMasses, OfAlgorithm1) {
  const std::array echoes_m{2.6, 1.2, 2.9};
  const auto masses = sector_masses(echoes_m, 0.5, 7, {});
  const std::array free{0.7, 0.7, 0.0, 0.0, 0.0, 0.0, 0.0};
  const std::array occupied{0.0, 0.0, 0.8, 0.0, 0.0, 0.8, 0.0};
  ASSERT_EQ(masses.size(), free.size());
  for (std::size_t i = 0; i < masses.size(); ++i) {
    EXPECT_EQ(masses[i].free, free[i]) << i;
    EXPECT_EQ(masses[i].occupied, occupied[i]) << i;
  }
}

// "Every obstacle reflects."
TEST(SectorMasses, WithoutAnEchoAreFree) {
  for (const auto model :
       {LidarModel::kMultiEcho, LidarModel::kReinforced, LidarModel::kImprecise}) {
    for (const SourceMass& mass : sector_masses(kNoEcho, 0.5, 5, {.model = model})) {
      EXPECT_EQ(mass.free, 0.7);
      EXPECT_EQ(mass.occupied, 0);
    }
  }
}

TEST(SectorMasses, OfAnEchoBeyondTheGridAreFree) {
  const std::array echoes_m{80.0};
  for (const SourceMass& mass : sector_masses(echoes_m, 0.5, 5, {})) {
    EXPECT_EQ(mass.free, 0.7);
  }
}

// 1 - 0.2^k (section 4.5.2.2); as algorithm 1 where no cell has two.
TEST(SectorMasses, OfReinforcedEchoes) {
  const LidarParameters reinforced{.model = LidarModel::kReinforced};
  const std::array three_m{1.1, 1.2, 1.3};
  EXPECT_NEAR(sector_masses(three_m, 0.5, 4, reinforced)[2].occupied, 0.992, 1e-15);
  const std::array apart_m{1.1, 1.7};
  const auto plain = sector_masses(apart_m, 0.5, 4, {});
  const auto same = sector_masses(apart_m, 0.5, 4, reinforced);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(plain[i].free, same[i].free);
    EXPECT_NEAR(plain[i].occupied, same[i].occupied, 1e-15);
  }
}

// In the middle of a cell of two sigmas 68.27 % of a normal distribution lie in it, 15.73 % in each
// of the next and 0.13 % in those beyond.
TEST(SectorMasses, OfAnImpreciseEcho) {
  const std::array echoes_m{1.1};
  const auto masses =
      sector_masses(echoes_m, 0.2, 11, {.model = LidarModel::kImprecise, .sigma_m = 0.1});
  EXPECT_NEAR(masses[3].occupied, 0.8 * 0.00135 * (1 - 0.7 * 0.99865), 1e-5);
  EXPECT_NEAR(masses[4].occupied,
              0.8 * 0.1573 / (1 - 0.7 * 0.8413 * 0.8 * 0.1573) * (1 - 0.7 * 0.8413), 1e-4);
  EXPECT_NEAR(masses[5].occupied,
              0.8 * 0.6827 * (1 - 0.7 * 0.1587) / (1 - 0.7 * 0.1587 * 0.8 * 0.6827), 1e-4);
  EXPECT_NEAR(masses[6].occupied, 0.8 * 0.1573, 2e-4);
  EXPECT_NEAR(masses[0].free, 0.7, 1e-4);
  EXPECT_NEAR(masses[10].free, 0, 1e-4);
}

// A sigma that is nothing to the cell.
TEST(SectorMasses, OfAPreciseEchoAreReinforcedOnes) {
  const std::array echoes_m{1.1, 1.3, 2.2};
  const auto sharp =
      sector_masses(echoes_m, 0.5, 6, {.model = LidarModel::kImprecise, .sigma_m = 1e-3});
  const auto reinforced = sector_masses(echoes_m, 0.5, 6, {.model = LidarModel::kReinforced});
  for (std::size_t i = 0; i < sharp.size(); ++i) {
    EXPECT_NEAR(sharp[i].free, reinforced[i].free, 1e-12) << i;
    EXPECT_NEAR(sharp[i].occupied, reinforced[i].occupied, 1e-12) << i;
  }
}

// Two sectors a tenth of a radian apart; only the second has an echo, in its cell of 1 to 2 m.
PolarGrid two_sectors() {
  const std::array<std::vector<double>, 2> echoes_m{std::vector<double>{}, {1.5}};
  return {{.first_rad = 0, .step_rad = 0.1, .sectors = 2, .cell_m = 1, .cells = 4}, echoes_m, {}};
}

TEST(PolarGrid, IsItsCellsInTheirMiddles) {
  const PolarGrid grid = two_sectors();
  EXPECT_NEAR(grid.at(1.5, 0).free, 0.7, 1e-15);
  EXPECT_NEAR(grid.at(1.5, 0.1 * (1 - 1e-12)).occupied, 0.8, 1e-9);
  EXPECT_NEAR(grid.at(0.5, 0.1 * (1 - 1e-12)).free, 0.7, 1e-9);
}

TEST(PolarGrid, IsBilinearBetweenThem) {
  const SourceMass mass = two_sectors().at(1.75, 0.05);
  EXPECT_NEAR(mass.occupied, 0.5 * 0.75 * 0.8, 1e-12);
  EXPECT_NEAR(mass.free, 0.5 * 0.7, 1e-12);
}

TEST(PolarGrid, KnowsNothingOutside) {
  const PolarGrid grid = two_sectors();
  for (const auto& [range_m, azimuth_rad] :
       {std::pair{1.5, -0.001}, {1.5, 0.1}, {3.6, 0.05}, {1.5, std::nan("")}}) {
    const SourceMass mass = grid.at(range_m, azimuth_rad);
    EXPECT_EQ(mass.free + mass.occupied, 0) << range_m << ", " << azimuth_rad;
  }
}

// Equations 5.1 and 5.2: Dempster's rule over all sets.
TEST(JoinedSources, AreThoseOfDempstersRule) {
  tests::Random random(51);
  for (int round = 0; round < 100; ++round) {
    const double free = random_share(random) * 0.9;
    const SourceMass one{free, (1 - free) * random_share(random) * 0.9};
    const SourceMass other{0.3, random_share(random) * 0.6};
    const SourceMass both = joined(one, other);
    const MassFunction expected = dempster(source_evidence(one.free, one.occupied),
                                           source_evidence(other.free, other.occupied));
    EXPECT_NEAR(both.free, expected[kFree], 1e-14);
    EXPECT_NEAR(both.occupied, expected[kOccupied], 1e-14);
  }
}

}  // namespace
}  // namespace iog::lab::reference::evidential
