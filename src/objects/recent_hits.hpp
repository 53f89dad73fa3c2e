// Where hits were lately: by cell, a bit for each of the last eight epochs of 80 ms.
//
// Cells are counted modulo 1024 in both directions, which is the window's size. Of an epoch
// kMostOfAnEpoch cells are remembered; more, the farthest of a frame, are not.
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

  // How many epochs before the present one something was first hit in the nine cells around a cell,
  // at most kEpochs - 1; 0: not before the present one. That of the newest add() is the present
  // one.
  [[nodiscard]] int oldest(geometry::Cell cell) const;

  // Ends a frame. Time does not go back but by forget().
  void add(std::uint64_t now_us, std::span<const FrameHit> hits);

  void forget();

 private:
  static constexpr std::uint32_t kSide = 1024;

  [[nodiscard]] static std::uint32_t place_of(std::int32_t x, std::int32_t y) {
    return (static_cast<std::uint32_t>(y) % kSide) * kSide + static_cast<std::uint32_t>(x) % kSide;
  }
  [[nodiscard]] std::uint32_t three_from(std::int32_t x, std::int32_t y) const;
  void drop(std::size_t epoch);

  std::uint64_t epoch_ = 0;
  std::array<std::uint8_t, std::size_t{kSide} * kSide> bits_{};
  std::array<std::array<std::uint32_t, kMostOfAnEpoch>, kEpochs> places_{};
  std::array<std::size_t, kEpochs> counts_{};
};

}  // namespace iog::objects
