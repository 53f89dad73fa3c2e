// Operations on sixteen indexes or two rows of bits at a time, implemented in plain C++. This
// version is the reference for the other implementations. Machines without vector instructions use
// this version.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "lanes/lane_bytes.hpp"

namespace iog::lanes {

class PlainLanes {
 public:
  static PlainLanes load(const LaneBytes& from) { return PlainLanes(from); }
  static PlainLanes load_bytes(const std::int8_t* from) {
    LaneBytes lanes;
    std::copy_n(from, kLaneCount, lanes.bytes.begin());
    return PlainLanes(lanes);
  }
  static PlainLanes all(std::int8_t value) {
    LaneBytes lanes;
    lanes.bytes.fill(value);
    return PlainLanes(lanes);
  }
  void store(LaneBytes& to) const { to = lanes_; }
  void store_bytes(std::int8_t* to) const {
    std::copy(lanes_.bytes.begin(), lanes_.bytes.end(), to);
  }

  [[nodiscard]] PlainLanes bit_and(const PlainLanes& mask) const {
    return each(mask, [](std::int8_t a, std::int8_t b) { return static_cast<std::int8_t>(a & b); });
  }
  [[nodiscard]] PlainLanes and_not(const PlainLanes& mask) const {
    return each(mask,
                [](std::int8_t a, std::int8_t b) { return static_cast<std::int8_t>(a & ~b); });
  }
  [[nodiscard]] PlainLanes subtract(const PlainLanes& amount) const {
    return each(amount, subtract_saturated);
  }
  [[nodiscard]] PlainLanes add(const PlainLanes& other) const { return each(other, add_saturated); }
  // Sets all bits of lanes that are above 0, and clears all other lanes.
  [[nodiscard]] PlainLanes above_zero() const {
    return each(*this, [](std::int8_t a, std::int8_t /*same*/) {
      return static_cast<std::int8_t>(a > 0 ? -1 : 0);
    });
  }
  [[nodiscard]] PlainLanes max(const PlainLanes& least) const {
    return each(least, [](std::int8_t a, std::int8_t b) { return a < b ? b : a; });
  }
  [[nodiscard]] PlainLanes bit_or(const PlainLanes& other) const {
    return each(other,
                [](std::int8_t a, std::int8_t b) { return static_cast<std::int8_t>(a | b); });
  }
  [[nodiscard]] bool is_zero() const { return lanes_ == LaneBytes{}; }
  // The arguments are four rows, each split into two halves. The result has one bit per lane, which
  // is set if the lane is negative. Bit 0 is the leftmost lane.
  static std::array<std::uint32_t, 4> negative(const std::array<PlainLanes, 4>& left,
                                               const std::array<PlainLanes, 4>& right) {
    std::array<std::uint32_t, 4> rows{};
    for (std::size_t y = 0; y < rows.size(); ++y) {
      for (std::size_t i = 0; i < kLaneCount; ++i) {
        rows[y] |= (left[y].lanes_.bytes[i] < 0 ? 1U : 0U) << i;
        rows[y] |= (right[y].lanes_.bytes[i] < 0 ? 1U : 0U) << (kLaneCount + i);
      }
    }
    return rows;
  }

  // Transposes four blocks into rows. Row i contains quarter i of each block, for i = 0 ... 3.
  static std::array<PlainLanes, 4> rows_of(const LaneBytes* four) {
    std::array<LaneBytes, 4> rows;
    for (std::size_t i = 0; i < 4 * kLaneCount; ++i) {
      rows[i / 4 % 4].bytes[i / kLaneCount * 4 + i % 4] =
          four[i / kLaneCount].bytes[i % kLaneCount];
    }
    return {PlainLanes(rows[0]), PlainLanes(rows[1]), PlainLanes(rows[2]), PlainLanes(rows[3])};
  }

 private:
  explicit PlainLanes(const LaneBytes& lanes) : lanes_(lanes) {}

  template <typename Operation>
  [[nodiscard]] PlainLanes each(const PlainLanes& other, Operation&& operation) const {
    LaneBytes result;
    for (std::size_t i = 0; i < kLaneCount; ++i) {
      result.bytes[i] = operation(lanes_.bytes[i], other.lanes_.bytes[i]);
    }
    return PlainLanes(result);
  }

  LaneBytes lanes_;
};

class PlainRowPair {
 public:
  // Two consecutive rows.
  static PlainRowPair load(const std::uint64_t* from) { return {from[0], from[1]}; }
  void store(std::uint64_t* to) const {
    to[0] = first_;
    to[1] = second_;
  }

  // Stores bits 16 to 47 of both rows.
  void store_middle(std::uint32_t* to) const {
    to[0] = static_cast<std::uint32_t>(first_ >> 16);
    to[1] = static_cast<std::uint32_t>(second_ >> 16);
  }

  [[nodiscard]] PlainRowPair bit_and(PlainRowPair other) const {
    return {first_ & other.first_, second_ & other.second_};
  }
  [[nodiscard]] PlainRowPair bit_or(PlainRowPair other) const {
    return {first_ | other.first_, second_ | other.second_};
  }
  [[nodiscard]] PlainRowPair and_not(PlainRowPair other) const {
    return {first_ & ~other.first_, second_ & ~other.second_};
  }

  // `up()` shifts towards the higher bits, and down() shifts towards the lower bits. Both shift in
  // zeros.
  template <int kBits>
  [[nodiscard]] PlainRowPair up() const {
    return {first_ << kBits, second_ << kBits};
  }
  template <int kBits>
  [[nodiscard]] PlainRowPair down() const {
    return {first_ >> kBits, second_ >> kBits};
  }

 private:
  PlainRowPair(std::uint64_t first, std::uint64_t second) : first_(first), second_(second) {}

  std::uint64_t first_;
  std::uint64_t second_;
};

}  // namespace iog::lanes
