// How well a grid tells what moves from what stands, and where one may drive from all other ground,
// whatever the threshold at which a class is named.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "lab/experiments/evidential/scores.hpp"

namespace iog::lab {

inline constexpr std::size_t kThresholds = 101;  // 0, 0.01 ... 1

// Points of a class and points of none, by the highest threshold that their scores reach.
class Curve {
 public:
  // score: 0 ... 1.
  void add(bool is_of_class, double score);

  struct Counts {
    std::uint64_t of_class = 0;
    std::uint64_t others = 0;
  };
  [[nodiscard]] Counts all() const { return at_least(0); }
  [[nodiscard]] Counts at_least(std::size_t hundredths) const;

 private:
  std::array<Counts, kThresholds> by_score_{};
};

// moving: echoes of what moves against those of what stands. drivable: ground of a road with
// nothing on it against all other ground, and against things.
struct Curves {
  Curve moving;
  Curve drivable;

  using Score = std::function<double(const TruePoint&)>;
  void add(const TrueScan& truth, const Score& moving_score, const Score& drivable_score);
};

// Of a class byte (docs/spec.md, 3.9): the middle of what its sureness tells of the mass, if it is
// of that class, else 0.
[[nodiscard]] double score_of(std::int8_t byte, std::uint8_t class_number);

}  // namespace iog::lab
