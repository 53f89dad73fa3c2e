// A round: work split into items that any core may take. Every item gets done.
//
// One word, the ticket, contains the number of the round and how many items are left. A core takes
// an item by decrementing the ticket (LDREX and STREX on the Cortex-A9), runs the item and sets its
// flag. Core 0 opens a round only when every item of the previous round has its flag. So the data
// of a round do not change between taking an item and setting its flag. docs/cores.md describes the
// memory order.
//
// Items may run in any order and at the same time, so no item may write what another reads or
// writes. A core may also be stopped within an item, which core 0 then repeats from its start. So
// no item may read its own output, unless it has written it before.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace iog::work {

// The function that runs each item, with the number of the core that runs it.
struct Work {
  void (*run)(void* context, std::size_t item, std::size_t core) = nullptr;
  void* context = nullptr;
};

// A task that core 0 runs once, before it takes items. It must not write what an item reads, nor
// read what an item writes. Core 0 is never lost, so the task is never repeated.
struct Beside {
  void (*run)(void* context) = nullptr;
  void* context = nullptr;

  void operator()() const {
    if (run != nullptr) {
      run(context);
    }
  }
};

// Runs everything on core 0.
inline void do_alone(std::size_t items, Work work, Beside beside = {}) {
  beside();
  for (std::size_t item = 0; item < items; ++item) {
    work.run(work.context, item, 0);
  }
}

// A callable as Work. It must outlive the round.
template <typename Callable>
[[nodiscard]] Work work_of(Callable& callable) {
  return {.run = [](void* context, std::size_t item,
                    std::size_t core) { (*static_cast<Callable*>(context))(item, core); },
          .context = &callable};
}

// The same for Beside.
template <typename Callable>
[[nodiscard]] Beside beside_of(Callable& callable) {
  return {.run = [](void* context) { (*static_cast<Callable*>(context))(); }, .context = &callable};
}

// Adds to a counter that only one core writes and others may read. A load and a store are enough,
// because no other core writes in between. They also avoid an exclusive access, which could follow
// a store to a device.
inline void count_up(std::atomic<std::uint32_t>& counter, std::uint32_t more) {
  counter.store(counter.load(std::memory_order_relaxed) + more, std::memory_order_relaxed);
}

class Round {
 public:
  static constexpr std::size_t kMaxItems = 1024;

  // The number of the round, modulo 2^16, and the number of items left.
  struct Ticket {
    std::uint32_t word = 0;

    [[nodiscard]] std::uint16_t number() const { return static_cast<std::uint16_t>(word >> 16); }
    [[nodiscard]] std::size_t left() const { return word & 0xFFFFU; }
  };

  // Core 0 calls it when the previous round is done. Begins a round of at most kMaxItems items.
  void open(std::size_t items, Work work);

  // For any core. look() returns the current ticket. claim() takes an item if the ticket has not
  // changed and an item is left. Otherwise `seen` becomes the current ticket.
  [[nodiscard]] Ticket look() const { return {ticket_.load(std::memory_order_acquire)}; }
  [[nodiscard]] std::optional<std::size_t> claim(Ticket& seen);
  // For the core that claimed the item.
  void run(std::size_t item, std::size_t core) { work_.run(work_.context, item, core); }
  void finish(std::size_t item) { is_done_[item].store(true, std::memory_order_release); }

  // Runs items on this core until none is left, and returns the last ticket. Adds the number of
  // items to `done`, which only this core may write.
  Ticket help(std::size_t core, std::atomic<std::uint32_t>& done);

  // For core 0: whether every item has its flag. If so, all stores of the items are visible.
  [[nodiscard]] bool is_done();

  // Core 0 calls it when no other core runs items. Runs those without a flag, and returns how many.
  std::size_t redo();

 private:
  // On one cache line, because a core that takes an item needs the work next. Only core 0 writes
  // the members after the ticket, while no item is left.
  alignas(64) std::atomic<std::uint32_t> ticket_{0};
  std::size_t items_ = 0;
  std::size_t checked_ = 0;  // for core 0: all items below this one have their flags
  Work work_;
  alignas(64) std::array<std::atomic<bool>, kMaxItems> is_done_{};
};

}  // namespace iog::work
