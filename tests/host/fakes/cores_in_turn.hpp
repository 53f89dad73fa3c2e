// Cores without threads: they do the items of a round one after the other, in any order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "fakes/random.hpp"
#include "work/crew.hpp"

namespace iog::tests {

// A crew's sharer (work/crew.hpp). In each round one of the helpers may be lost behind an item that
// it has done; core 0 does that item again when all others are done. It is back in the next round.
class CoresInTurn {
 public:
  CoresInTurn(std::size_t cores, bool are_lost, std::uint64_t seed)
      : cores_(cores), are_lost_(are_lost), random_(seed) {}

  [[nodiscard]] std::size_t cores() const { return cores_; }

  // What is beside them comes at any time.
  void share(std::size_t items, work::Work work, work::Beside beside = {}) {
    std::vector<std::size_t> order(items);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = items; i > 1; --i) {
      std::swap(order[i - 1], order[random_.below(i)]);
    }
    const std::size_t victim = are_lost_ && cores_ > 1 ? 1 + random_.below(cores_ - 1) : 0;
    std::size_t items_left = items > 0 ? random_.below(items) / cores_ : 0;  // of the victim
    std::vector<std::size_t> again;
    const std::size_t beside_at = beside.run == nullptr ? 0 : random_.below(items + 1);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::size_t item = order[i];
      if (i == beside_at) {
        beside();
      }
      const std::size_t core = random_.below(cores_);
      const bool is_gone = !again.empty() && core == victim;
      work.run(work.context, item, is_gone ? 0 : core);
      if (victim != 0 && core == victim && again.empty() && items_left-- == 0) {
        again.push_back(item);
      }
    }
    if (beside_at == items) {
      beside();
    }
    for (const std::size_t item : again) {
      work.run(work.context, item, 0);
      ++redone_;
    }
  }

  [[nodiscard]] std::size_t redone() const { return redone_; }

 private:
  std::size_t cores_;
  bool are_lost_;
  Random random_;
  std::size_t redone_ = 0;
};
static_assert(work::Sharer<CoresInTurn>);

}  // namespace iog::tests
