// Records which cells were hit recently. Each cell has one byte, with one bit for each of the last
// eight epochs of 80 ms.
//
// Cell coordinates are taken modulo 1024, which is the size of the window. At most kMostOfAnEpoch
// cells are recorded per epoch. If more cells are hit, the farthest hits of the frame are not
// recorded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/rules.hpp"

namespace iog::objects {

class RecentHits {
 public:
  static constexpr int kEpochs = 8;
  static constexpr std::size_t kMostOfAnEpoch = 2 * kMostHits;

  // Returns the number of epochs since `cell` or one of its eight neighbours was first hit. The
  // result is at most kEpochs - 1. The current epoch is the epoch of the last add(). If neither
  // `cell` nor a neighbour was hit before the current epoch, the result is 0.
  [[nodiscard]] int oldest(geometry::Cell cell) const;
  // Returns true if `cell` or one of its eight neighbours was hit in the current or the previous
  // epoch.
  [[nodiscard]] bool is_hit_lately(geometry::Cell cell) const;

  // Adds the hits of a frame. Call add() at the end of each frame. If time goes backwards between
  // two frames, call forget() before add().
  void add(std::uint64_t now_us, std::span<const FrameHit> hits);

  void forget();

 private:
  static constexpr std::uint32_t kSide = 1024;

  [[nodiscard]] static std::uint32_t place_of(std::int32_t x, std::int32_t y) {
    return (static_cast<std::uint32_t>(y) % kSide) * kSide + static_cast<std::uint32_t>(x) % kSide;
  }
  // Returns the epochs in which the cell or one of its eight neighbours was hit. Bit 7 represents
  // the current epoch, and bit i represents the epoch that was 7 - i epochs earlier.
  [[nodiscard]] std::uint8_t epochs_around(geometry::Cell cell) const;
  [[nodiscard]] std::uint32_t three_from(std::int32_t x, std::int32_t y) const;
  void drop(std::size_t epoch);

  std::uint64_t epoch_ = 0;
  std::array<std::uint8_t, std::size_t{kSide} * kSide> bits_{};
  std::array<std::array<std::uint32_t, kMostOfAnEpoch>, kEpochs> places_{};
  std::array<std::size_t, kEpochs> counts_{};
};

}  // namespace iog::objects
