// The profile of a sensor: a small table of the occupancy indexes of the local 1D grid around a
// scan point.
//
// See docs/model.md section 4 and Table 4.3 of the thesis. A profile describes the whole local grid
// of a beam by three things: the index of all cells well before the scan point, the indexes of the
// few cells around it, and 0 beyond.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "index/occupancy_index.hpp"
#include "index/recursive_set.hpp"
#include "sensor_model/single_target.hpp"

namespace iog::sensor_model {

struct ProfileConfig {
  double sigma_m = 0.10;        // standard deviation of the range
  double cell_length_m = 0.10;  // Delta, the length of a 1D cell: the sensor's precision
  double epsilon = 0.05;        // of the recursive set
  double floor = 0.05;          // smaller ISM values are raised to this (thesis section 4.3.1.1)
  index::Quantisation quantisation = index::Quantisation::kBlurring;
};

// Maximum number of cells on one side of the scan point whose index is neither the free one nor 0.
inline constexpr std::size_t kMaxNearCells = 8;

template <typename Cell>
struct BasicProfile {
  Cell free = 0;                                  // 1D cells before the near ones; below 0
  std::uint8_t near_before_count = 0;             // how many of near_before are in use
  std::array<Cell, kMaxNearCells> near_before{};  // [j]: 1D cell k - 1 - j; at most 0
  Cell hit = 0;                                   // 1D cell k; above 0
  std::uint8_t near_after_count = 0;              // how many of near_after are in use
  std::array<Cell, kMaxNearCells> near_after{};   // [j]: 1D cell k + 1 + j; at least 0

  // The index of the 1D cell at this offset from k.
  [[nodiscard]] constexpr Cell at(int offset) const {
    if (offset == 0) {
      return hit;
    }
    const auto distance = static_cast<std::size_t>(offset < 0 ? -offset : offset) - 1;
    if (offset < 0) {
      return distance < near_before_count ? near_before[distance] : free;
    }
    return distance < near_after_count ? near_after[distance] : Cell{0};
  }

  // Whether a frame can be fused with this profile: it carves before the scan point, marks at it,
  // and clears nothing behind it. A 1D cell much shorter than sigma cannot mark (thesis section
  // 4.2.1.2, figure 4.6d); such a sensor needs a longer one.
  [[nodiscard]] constexpr bool is_valid() const {
    bool valid = free < 0 && hit > 0;
    for (std::size_t j = 0; j < kMaxNearCells; ++j) {
      valid = valid && near_before[j] <= 0 && near_after[j] >= 0;
    }
    return valid;
  }

  friend constexpr bool operator==(const BasicProfile&, const BasicProfile&) = default;
};

using Profile = BasicProfile<index::OccupancyIndex>;

// No value if a near zone needs more than kMaxNearCells cells, or if an index does not fit its
// type.
template <typename Cell = index::OccupancyIndex>
constexpr std::optional<BasicProfile<Cell>> profile_of(const ProfileConfig& config) {
  const SingleTarget model{config.sigma_m, config.cell_length_m};
  const index::RecursiveSet set(config.epsilon);
  bool fits = true;
  const auto index_at = [&](int offset) {
    const double probability = model.probability(offset);
    const double raised = probability < config.floor ? config.floor : probability;
    const std::int32_t n = set.quantise(raised, config.quantisation);
    fits = fits && n <= index::kIndexMax<Cell> && n >= index::kIndexMin<Cell>;
    return static_cast<Cell>(n);
  };
  const int far = static_cast<int>(kMaxNearCells) + 1;
  BasicProfile<Cell> profile;
  profile.free = index_at(-far);
  profile.hit = index_at(0);
  fits = fits && index_at(far) == 0;
  for (int j = 0; j < static_cast<int>(kMaxNearCells); ++j) {
    const auto slot = static_cast<std::size_t>(j);
    profile.near_before[slot] = index_at(-1 - j);
    profile.near_after[slot] = index_at(1 + j);
    if (profile.near_before[slot] != profile.free) {
      profile.near_before_count = static_cast<std::uint8_t>(j + 1);
    }
    if (profile.near_after[slot] != 0) {
      profile.near_after_count = static_cast<std::uint8_t>(j + 1);
    }
  }
  return fits ? std::optional(profile) : std::nullopt;
}

// Neither constexpr nor defined: calling it stops the compilation with its name in the message.
void the_profile_does_not_fit_its_table_or_its_cell_type();

// Like profile_of(), for a profile that is known to fit. If it does not fit, the code does not
// compile.
template <typename Cell = index::OccupancyIndex>
constexpr BasicProfile<Cell> make_profile(const ProfileConfig& config) {
  const auto profile = profile_of<Cell>(config);
  if (!profile) {
    the_profile_does_not_fit_its_table_or_its_cell_type();
  }
  return *profile;
}

}  // namespace iog::sensor_model
