// The azimuths of a turn that have been swept, stored as one bit per tick. Even a narrow sector is
// therefore counted in full, and ticks where two sectors overlap are counted only once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lidar/scan_point.hpp"

namespace iog::intake {

class SweptSectors {
 public:
  // The maximum number of ticks per turn in any format (Ouster).
  static constexpr std::uint32_t kMaxTicksPerTurn = 46'080;

  // `ticks_per_turn` must be at most kMaxTicksPerTurn. Sectors must lie within one turn.
  explicit SweptSectors(std::uint32_t ticks_per_turn);
  SweptSectors() = default;

  void add(const lidar::Sector& sector);
  void clear();

  // Returns the number of ticks that have been swept.
  [[nodiscard]] std::uint32_t count() const { return count_; }

  // Returns true if more than `ticks` ticks of the sector have not been swept.
  [[nodiscard]] bool misses_more_than(std::uint32_t ticks, const lidar::Sector& sector) const;

 private:
  static constexpr std::uint32_t kWordTicks = 32;
  static constexpr std::size_t kWords = (kMaxTicksPerTurn + kWordTicks - 1) / kWordTicks;

  // Calls visit(word, bits) for each word that the sector overlaps, until visit() returns false.
  // `bits` contains the bits of the word that belong to the sector.
  template <typename Visit>
  void for_each_word(const lidar::Sector& sector, Visit&& visit) const;

  std::uint32_t ticks_per_turn_ = 1;
  std::uint32_t count_ = 0;
  std::array<std::uint32_t, kWords> words_{};
};

}  // namespace iog::intake
