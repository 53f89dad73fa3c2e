// A crew is a reference to the executor of a round: a work::Team, a platform that has a work::Team,
// or core 0 alone. Code that splits its work can therefore run on any executor.
#pragma once

#include <concepts>
#include <cstddef>

#include "work/round.hpp"

namespace iog::work {

// A Sharer provides cores() and share(), as work::Team does.
template <typename T>
concept Sharer = requires(T& sharer, std::size_t items, Work work, Beside beside) {
  { sharer.cores() } -> std::same_as<std::size_t>;
  { sharer.share(items, work, beside) } -> std::same_as<void>;
};

class Crew {
 public:
  // Creates a crew that consists of core 0 alone.
  Crew() = default;

  // `sharer` must outlive the crew.
  template <Sharer S>
  explicit Crew(S& sharer)
      : sharer_(&sharer),
        cores_([](void* its) { return static_cast<S*>(its)->cores(); }),
        share_([](void* its, std::size_t items, Work work, Beside beside) {
          static_cast<S*>(its)->share(items, work, beside);
        }) {}

  // Returns the number of cores that may currently work, including core 0.
  [[nodiscard]] std::size_t cores() const { return sharer_ == nullptr ? 1 : cores_(sharer_); }
  [[nodiscard]] bool is_one() const { return cores() == 1; }

  // Calls do_item(item, core) for every item. `items` is at most Round::kMaxItems. Returns when all
  // items are done.
  template <typename DoItem>
  void share(std::size_t items, DoItem do_item) const {
    share_work(items, work_of(do_item), Beside{});
  }
  // Like share() without `beside`, but core 0 also runs the extra task `beside` once.
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

// Returns how many items of `in_each` elements are needed for `things` elements. The last item may
// contain fewer.
[[nodiscard]] constexpr std::size_t items_of(std::size_t things, std::size_t in_each) {
  return (things + in_each - 1) / in_each;
}

}  // namespace iog::work
