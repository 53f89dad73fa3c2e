// A round: work cut into items that any core may take, each of which is done.
//
// One word, the ticket, says which round it is and how many items are not taken yet. A core takes
// an item by lowering the ticket (LDREX and STREX on the Cortex-A9), does it, and sets the item's
// flag. Core 0 opens a round when every item of the round before has its flag, so what a core reads
// of a round between taking an item and its flag stays as it is. docs/cores.md has the order of
// memory.
//
// Items may be done in any order and at the same time, so none may write what another reads or
// writes. An item may also be begun by a core that is then stopped, and done again by core 0 from
// its start: so none may read what it writes itself, unless it has written it before.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace iog::work {

// What is done with each item, and which core does it.
struct Work {
  void (*run)(void* context, std::size_t item, std::size_t core) = nullptr;
  void* context = nullptr;
};

// What core 0 does beside a round, once, before it takes items. It writes nothing that an item
// reads, and reads nothing that an item writes; core 0 is never lost, so it is not done again.
struct Beside {
  void (*run)(void* context) = nullptr;
  void* context = nullptr;

  void operator()() const {
    if (run != nullptr) {
      run(context);
    }
  }
};

// All of it on core 0.
inline void do_alone(std::size_t items, Work work, Beside beside = {}) {
  beside();
  for (std::size_t item = 0; item < items; ++item) {
    work.run(work.context, item, 0);
  }
}

// A callable object as work; it outlives the round.
template <typename Callable>
[[nodiscard]] Work work_of(Callable& callable) {
  return {.run = [](void* context, std::size_t item,
                    std::size_t core) { (*static_cast<Callable*>(context))(item, core); },
          .context = &callable};
}

// The same of what is done beside.
template <typename Callable>
[[nodiscard]] Beside beside_of(Callable& callable) {
  return {.run = [](void* context) { (*static_cast<Callable*>(context))(); }, .context = &callable};
}

// Adds to what one core alone counts and others may read. A load and a store, because no other core
// writes in between; so there is no exclusive access that could follow a store to a device.
inline void count_up(std::atomic<std::uint32_t>& counter, std::uint32_t more) {
  counter.store(counter.load(std::memory_order_relaxed) + more, std::memory_order_relaxed);
}

class Round {
 public:
  static constexpr std::size_t kMaxItems = 1024;

  // Which round, modulo 2^16, and how many of its items are left to take.
  struct Ticket {
    std::uint32_t word = 0;

    [[nodiscard]] std::uint16_t number() const { return static_cast<std::uint16_t>(word >> 16); }
    [[nodiscard]] std::size_t left() const { return word & 0xFFFFU; }
  };

  // Core 0, when the round before is done: begins one of at most kMaxItems items.
  void open(std::size_t items, Work work);

  // Any core. look() tells the ticket of now. claim() takes an item if the ticket is still the one
  // that was seen and there is one left; if not, `seen` becomes the ticket of now.
  [[nodiscard]] Ticket look() const { return {ticket_.load(std::memory_order_acquire)}; }
  [[nodiscard]] std::optional<std::size_t> claim(Ticket& seen);
  // By the core that claimed the item.
  void run(std::size_t item, std::size_t core) { work_.run(work_.context, item, core); }
  void finish(std::size_t item) { is_done_[item].store(true, std::memory_order_release); }

  // This core: does items until none is left, and returns the ticket that said so. Adds to `done`,
  // which this core alone writes, what it did.
  Ticket help(std::size_t core, std::atomic<std::uint32_t>& done);

  // Core 0: whether every item has its flag. What was stored for them is then visible.
  [[nodiscard]] bool is_done();

  // Core 0, when no other core does items any more: does those without a flag. Returns how many.
  std::size_t redo();

 private:
  // On one cache line: a core that takes an item needs the work next. Behind the ticket all is
  // written by core 0 alone, while no item is left to take.
  alignas(64) std::atomic<std::uint32_t> ticket_{0};
  std::size_t items_ = 0;
  std::size_t checked_ = 0;  // of core 0: the items below it have their flags
  Work work_;
  alignas(64) std::array<std::atomic<bool>, kMaxItems> is_done_{};
};

}  // namespace iog::work
