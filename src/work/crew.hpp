// The cores that do the items of a round: a team, a platform that has one, or core 0 alone.
//
// A reference, so that a room that divides its work need not know by whom it is done.
#pragma once

#include <concepts>
#include <cstddef>

#include "work/round.hpp"

namespace iog::work {

// As work::Team.
template <typename T>
concept Sharer = requires(T& sharer, std::size_t items, Work work, Beside beside) {
  { sharer.cores() } -> std::same_as<std::size_t>;
  { sharer.share(items, work, beside) } -> std::same_as<void>;
};

class Crew {
 public:
  // Core 0 alone.
  Crew() = default;

  // sharer outlives the crew.
  template <Sharer S>
  explicit Crew(S& sharer)
      : sharer_(&sharer),
        cores_([](void* its) { return static_cast<S*>(its)->cores(); }),
        share_([](void* its, std::size_t items, Work work, Beside beside) {
          static_cast<S*>(its)->share(items, work, beside);
        }) {}

  // How many cores may work now, core 0 included.
  [[nodiscard]] std::size_t cores() const { return sharer_ == nullptr ? 1 : cores_(sharer_); }
  [[nodiscard]] bool is_one() const { return cores() == 1; }

  // Does every item, at most Round::kMaxItems: do_item(item, core). Returns when all are done.
  template <typename DoItem>
  void share(std::size_t items, DoItem do_item) const {
    share_work(items, work_of(do_item), Beside{});
  }
  // The same, and core 0 does what is beside them, once.
  template <typename DoItem>
  void share(std::size_t items, DoItem do_item, Beside beside) const {
    share_work(items, work_of(do_item), beside);
  }

 private:
  void share_work(std::size_t items, Work work, Beside beside) const {
    if (sharer_ == nullptr) {
      do_alone(items, work, beside);
    } else {
      share_(sharer_, items, work, beside);
    }
  }

  void* sharer_ = nullptr;
  std::size_t (*cores_)(void* sharer) = nullptr;
  void (*share_)(void* sharer, std::size_t items, Work work, Beside beside) = nullptr;
};

// How many items hold so many things, if each holds `in_each` but perhaps the last.
[[nodiscard]] constexpr std::size_t items_of(std::size_t things, std::size_t in_each) {
  return (things + in_each - 1) / in_each;
}

}  // namespace iog::work
