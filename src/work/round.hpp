// A round is work that is split into items. Any core may claim an item, and every item is
// completed.
//
// One word, the ticket, contains the round number and the count of remaining items. A core claims
// an item by decrementing the ticket (LDREX and STREX on the Cortex-A9), runs the item and sets the
// item's flag. Core 0 opens a round only after all flags of the previous round have been set. From
// the time an item is claimed until its flag is set, the round's data therefore does not change.
// The memory order is described in docs/cores.md.
//
// Items may run in any order and concurrently, so an item must not write data that another item
// reads or writes. If a core is stopped while it runs an item, core 0 repeats the item from the
// start. An item may therefore read its own output only after writing it in the same run.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace iog::work {

// The function that runs an item. The arguments include the number of the core that runs the item.
struct Work {
  void (*run)(void* context, std::size_t item, std::size_t core) = nullptr;
  void* context = nullptr;
};

// A task that core 0 runs once, before it claims items. The task must not access data that an item
// writes, nor write data that an item reads. The task is never repeated because core 0 is never
// lost.
struct Beside {
  void (*run)(void* context) = nullptr;
  void* context = nullptr;

  void operator()() const {
    if (run != nullptr) {
      run(context);
    }
  }
};

// Runs all items and the extra task on core 0.
inline void do_alone(std::size_t items, Work work, Beside beside = {}) {
  beside();
  for (std::size_t item = 0; item < items; ++item) {
    work.run(work.context, item, 0);
  }
}

// Wraps a callable as Work. The callable must outlive the round.
template <typename Callable>
[[nodiscard]] Work work_of(Callable& callable) {
  return {.run = [](void* context, std::size_t item,
                    std::size_t core) { (*static_cast<Callable*>(context))(item, core); },
          .context = &callable};
}

// Wraps a callable as Beside.
template <typename Callable>
[[nodiscard]] Beside beside_of(Callable& callable) {
  return {.run = [](void* context) { (*static_cast<Callable*>(context))(); }, .context = &callable};
}

// Adds `more` to a counter that any core may read but only this core writes to. A load and a store
// are therefore enough. They also avoid an exclusive access, which could deadlock after a store to
// a device (docs/errata.md, 782772).
inline void count_up(std::atomic<std::uint32_t>& counter, std::uint32_t more) {
  counter.store(counter.load(std::memory_order_relaxed) + more, std::memory_order_relaxed);
}

class Round {
 public:
  static constexpr std::size_t kMaxItems = 1024;

  // The round number, modulo 2^16, and the count of remaining items.
  struct Ticket {
    std::uint32_t word = 0;

    [[nodiscard]] std::uint16_t number() const { return static_cast<std::uint16_t>(word >> 16); }
    [[nodiscard]] std::size_t left() const { return word & 0xFFFFU; }
  };

  // Begins a round of at most kMaxItems items. Core 0 calls open() when the previous round is done.
  void open(std::size_t items, Work work);

  // Any core may call these functions. `look()` returns the current ticket. `claim()` claims an
  // item if the ticket has not changed and items remain. Otherwise, claim() sets `seen` to the
  // current ticket.
  [[nodiscard]] Ticket look() const { return {ticket_.load(std::memory_order_acquire)}; }
  [[nodiscard]] std::optional<std::size_t> claim(Ticket& seen);
  // Only the core that claimed the item may call these functions.
  void run(std::size_t item, std::size_t core) { work_.run(work_.context, item, core); }
  void finish(std::size_t item) { is_done_[item].store(true, std::memory_order_release); }

  // Runs items on this core until none remain, and returns the last ticket. Adds the number of
  // completed items to `done`, which only this core may write to.
  Ticket help(std::size_t core, std::atomic<std::uint32_t>& done);

  // Returns true if the flags of all items are set. All stores made by the items are then visible.
  // Only core 0 may call is_done().
  [[nodiscard]] bool is_done();

  // Runs the items whose flag is not set, and returns how many it ran. Core 0 calls redo() when no
  // other core is running items.
  std::size_t redo();

 private:
  // The ticket and the work share a cache line because a core reads the work immediately after it
  // has claimed an item. Only core 0 writes `items_`, `checked_` and `work_`, and it does so only
  // when no items remain.
  alignas(64) std::atomic<std::uint32_t> ticket_{0};
  std::size_t items_ = 0;
  std::size_t checked_ = 0;  // for core 0: the flags of all items below this one are set
  Work work_;
  alignas(64) std::array<std::atomic<bool>, kMaxItems> is_done_{};
};

}  // namespace iog::work
