// The profile of a sensor. A profile is a small table that contains the occupancy indexes of the
// local 1D grid around a scan point.
//
// See docs/model.md section 4 and Table 4.3 of the thesis. A profile describes the entire local
// grid of a beam. It contains one index for all cells well before the scan point, and separate
// indexes for the few cells around it. All cells beyond these have index 0.
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
  double cell_length_m = 0.10;  // Delta, the length of a 1D cell, which is the sensor's precision
  double epsilon = 0.05;        // epsilon of the recursive set
  double floor = 0.05;          // lower limit of the ISM values (thesis section 4.3.1.1)
  index::Quantisation quantisation = index::Quantisation::kBlurring;
};

// The maximum number of near cells on each side of the scan point. The index of a near cell is
// neither the free index nor 0.
inline constexpr std::size_t kMaxNearCells = 8;

template <typename Cell>
struct BasicProfile {
  Cell free = 0;                                  // index of 1D cells before the near ones; below 0
  std::uint8_t near_before_count = 0;             // number of entries of near_before in use
  std::array<Cell, kMaxNearCells> near_before{};  // entry j is for 1D cell k - 1 - j; at most 0
  Cell hit = 0;                                   // index of 1D cell k; above 0
  std::uint8_t near_after_count = 0;              // number of entries of near_after in use
  std::array<Cell, kMaxNearCells> near_after{};   // entry j is for 1D cell k + 1 + j; at least 0

  // Returns the index of the 1D cell at the given offset from k.
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

  // Returns true if this profile can be used for fusion. A valid profile carves before the scan
  // point, marks at the scan point, and clears nothing behind it. If a 1D cell is much shorter than
  // sigma, it cannot be marked (thesis section 4.2.1.2, figure 4.6d). In this case, the sensor
  // needs longer 1D cells.
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

// Returns nothing if a near zone needs more than kMaxNearCells cells, or if an index does not fit
// in its type.
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

// The function is not constexpr and has no definition. A call to it therefore stops the compilation
// with an error message that contains its name.
void the_profile_does_not_fit_its_table_or_its_cell_type();

// Returns the same result as profile_of(), for a profile that is known to fit. If the profile does
// not fit, the code does not compile.
template <typename Cell = index::OccupancyIndex>
constexpr BasicProfile<Cell> make_profile(const ProfileConfig& config) {
  const auto profile = profile_of<Cell>(config);
  if (!profile) {
    the_profile_does_not_fit_its_table_or_its_cell_type();
  }
  return *profile;
}

}  // namespace iog::sensor_model
