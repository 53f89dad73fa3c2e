// Splits a sequence into runs (guided chunks). Each run is an item of a round. The first runs are
// long, and later runs become shorter and shorter.
//
// Cores claim the runs in order. As a result, a sequence is split into few runs, and the last runs
// are so short that no core waits long for another. The algorithm is guided self-scheduling
// (Polychronopoulos and Kuck, IEEE Transactions on Computers C-36, 1987), except that the runs are
// half as long.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/cores.hpp"
#include "require/require.hpp"
#include "work/round.hpp"

namespace iog::work {

struct Run {
  std::size_t first = 0;
  std::size_t end = 0;
  friend bool operator==(const Run&, const Run&) = default;
};

class Runs {
 public:
  struct Lengths {
    std::size_t shortest = 1;  // at least 1; only the last run may be shorter
    std::size_t longest = Round::kMaxItems;
  };

  // `things` is the length of the sequence, at most Round::kMaxItems.
  Runs(std::size_t things, Lengths lengths) {
    require(things <= Round::kMaxItems && lengths.shortest > 0);
    for (std::size_t first = 0; first < things;) {
      const std::size_t left = things - first;
      const std::size_t share = std::min(left / (2 * hal::kMaxCores), lengths.longest);
      first += std::min(left, std::max(share, lengths.shortest));
      ends_[count_++] = static_cast<std::uint16_t>(first);
    }
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] Run operator[](std::size_t item) const {
    return {.first = item == 0 ? 0U : std::size_t{ends_[item - 1]}, .end = ends_[item]};
  }

 private:
  std::size_t count_ = 0;
  std::array<std::uint16_t, Round::kMaxItems> ends_;  // only the first `count_` are valid
};

}  // namespace iog::work
