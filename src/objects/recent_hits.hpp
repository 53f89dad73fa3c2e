// Remembers where hits were recently: one byte per cell, one bit for each of the last eight epochs
// of 80 ms.
//
// Cell coordinates are taken modulo 1024, the size of the window. An epoch remembers kMostOfAnEpoch
// cells. If there are more, the farthest hits of a frame are not recorded.
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

  // How many epochs ago one of the nine cells around `cell` was first hit, at most kEpochs - 1. 0:
  // not before the current epoch, which is that of the last add().
  [[nodiscard]] int oldest(geometry::Cell cell) const;
  // Whether one of the nine cells around `cell` was hit in the current epoch or the one before.
  [[nodiscard]] bool is_hit_lately(geometry::Cell cell) const;

  // Adds the hits of a frame at its end. Time may run back only after forget().
  void add(std::uint64_t now_us, std::span<const FrameHit> hits);

  void forget();

 private:
  static constexpr std::uint32_t kSide = 1024;

  [[nodiscard]] static std::uint32_t place_of(std::int32_t x, std::int32_t y) {
    return (static_cast<std::uint32_t>(y) % kSide) * kSide + static_cast<std::uint32_t>(x) % kSide;
  }
  // Of the nine cells around a cell. Bit i is of the epoch 7 - i before the current one.
  [[nodiscard]] std::uint8_t epochs_around(geometry::Cell cell) const;
  [[nodiscard]] std::uint32_t three_from(std::int32_t x, std::int32_t y) const;
  void drop(std::size_t epoch);

  std::uint64_t epoch_ = 0;
  std::array<std::uint8_t, std::size_t{kSide} * kSide> bits_{};
  std::array<std::array<std::uint32_t, kMostOfAnEpoch>, kEpochs> places_{};
  std::array<std::size_t, kEpochs> counts_{};
};

}  // namespace iog::objects
