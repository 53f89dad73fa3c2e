// The worker pool consists of core 0, which opens rounds, and the helpers.
//
// Core 0 claims items like any helper, so a round is completed even without helpers. If a helper
// faults or hangs while it runs an item, it is stopped and never used again, and core 0 repeats the
// item. A helper that does not answer a wake-up has not claimed an item, and may answer later.
// Losing a core therefore costs only time. A wait exceeds `patience_us` only if an item takes
// longer.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/cores.hpp"
#include "require/require.hpp"
#include "work/round.hpp"

namespace iog::work {

// Why a core is not working.
enum class Loss : std::uint8_t {
  kNone,
  kNotAsked,  // the machine does not have this core, or fewer cores were requested
  kNotUp,     // it did not start
  kFaulted,   // an exception or a broken requirement ended it
  kStuck,     // it did not finish its item
  kSilent,    // it has not answered a wake-up yet, and will be woken again
};

// Counts since start-up, modulo 2^32.
struct TeamCounts {
  std::uint32_t at_work = 0;                          // cores that currently work
  std::uint32_t for_lost = 0;                         // items of lost cores that core 0 did
  std::array<std::uint32_t, hal::kMaxCores> items{};  // completed by each core

  // The names of the counters in the stream (stream/target_table.hpp).
  static constexpr auto kNames =
      std::to_array<std::string_view>({"cores at work", "items for lost cores", "items of core 0",
                                       "items of core 1", "items of core 2", "items of core 3"});
};

template <hal::Cores C>
class Team {
 public:
  // `cores` must outlive the team. A helper must answer a wake-up within `patience_us`. Once core 0
  // finds no more items, every helper must finish its item within `patience_us`. Every item must
  // take less than `patience_us`.
  Team(C& cores, std::uint32_t patience_us) : cores_(&cores), patience_us_(patience_us) {
    loss_.fill(Loss::kNotAsked);
    loss_[0] = Loss::kNone;
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  // Starts helpers until `wanted` cores (including core 0) are working or the machine has no more
  // cores. Returns the number of working cores. Call start() once.
  std::size_t start(std::size_t wanted) {
    const std::size_t count = std::min(wanted, cores_->count());
    for (std::size_t core = 1; core < hal::kMaxCores && core < count; ++core) {
      seats_[core].place.store(round_.look().number(), std::memory_order_relaxed);
      const bool is_up = cores_->start(core, {.run = &Team::help_from, .context = this});
      loss_[core] = is_up ? Loss::kNone : Loss::kNotUp;
    }
    return cores();
  }

  // Runs every item on any core, and returns when all items are done. Core 0 runs `beside` first.
  // Meanwhile, the helpers run items.
  void share(std::size_t items, Work work, Beside beside = {}) {
    look_around();
    if (items < 2 || cores() == 1) {
      do_alone(items, work, beside);
      count_up(seats_[0].items, static_cast<std::uint32_t>(items));
      return;
    }
    round_.open(items, work);
    for_each_helper([this](std::size_t core) { cores_->wake(core); });
    beside();
    round_.help(0, seats_[0].items);
    wait();
    redone_ += static_cast<std::uint32_t>(round_.redo());
  }

  // Wakes every available helper without giving it work. Each helper that is alive then increments
  // its comes() counter. Use call() between rounds.
  void call() {
    lose_faulted();
    for_each_helper([this](std::size_t core) { cores_->wake(core); });
  }

  // Returns the number of cores that are working or may still answer, including core 0.
  [[nodiscard]] std::size_t cores() const {
    std::size_t cores = 0;
    for (std::size_t core = 0; core < loss_.size(); ++core) {
      cores += is_asked(core) ? 1U : 0U;
    }
    return cores;
  }
  [[nodiscard]] Loss loss(std::size_t core) const { return loss_[core]; }
  [[nodiscard]] std::string_view last_word(std::size_t core) const {
    return cores_->last_word(core);
  }

  // Returns true if a helper is expected to answer a wake-up because it has started and is not
  // known to be lost.
  [[nodiscard]] bool is_asked(std::size_t core) const {
    return loss_[core] == Loss::kNone || loss_[core] == Loss::kSilent;
  }
  // Returns how many wake-ups a helper has answered since start-up, modulo 2^32. A wake-up is
  // counted when the helper is idle again.
  [[nodiscard]] std::uint32_t comes(std::size_t core) const {
    return seats_[core].comes.load(std::memory_order_relaxed);
  }

  // `items()` returns the number of items that a core has completed. `redone()` returns the number
  // of items that core 0 completed for lost cores. Both are counts since start-up, modulo 2^32.
  [[nodiscard]] std::uint32_t items(std::size_t core) const {
    return seats_[core].items.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint32_t redone() const { return redone_; }
  [[nodiscard]] TeamCounts counts() const {
    return {.at_work = static_cast<std::uint32_t>(cores()),
            .for_lost = redone(),
            .items = {items(0), items(1), items(2), items(3)}};
  }

  // Returns the number of lost cores plus the number of cores that have ever failed to answer a
  // wake-up in time.
  [[nodiscard]] std::uint32_t troubles() const { return troubles_; }

 private:
  // While a helper is looking for items, its `place` is kInside, which differs from every round
  // number.
  static constexpr std::uint32_t kInside = 1U << 16;

  // Each seat has its own cache line. Once a core has started, only that core writes to its seat.
  struct alignas(64) Seat {
    std::atomic<std::uint32_t> place{0};  // kInside, or the round in which the core found no more
                                          // items
    std::atomic<std::uint32_t> items{0};
    std::atomic<std::uint32_t> comes{0};
  };

  static void help_from(void* context, std::size_t core) {
    Team& team = *static_cast<Team*>(context);
    Seat& seat = team.seats_[core];
    // Claiming the first item is a release operation, so the claim also publishes this store.
    seat.place.store(kInside, std::memory_order_relaxed);
    const Round::Ticket last = team.round_.help(core, seat.items);
    count_up(seat.comes, 1);
    seat.place.store(last.number(), std::memory_order_release);
  }

  template <typename Visit>
  void for_each_helper(Visit&& visit) {
    for (std::size_t core = 1; core < loss_.size(); ++core) {
      if (is_asked(core)) {
        visit(core);
      }
    }
  }

  // Updates the state of each helper. A helper that has stopped counts as lost. A helper that has
  // not answered its wake-up in time counts as silent. A silent helper that answers later counts as
  // working again.
  void look_around() {
    const std::uint64_t now_us = cores_->now_us();
    lose_faulted();
    for_each_helper([this, now_us](std::size_t core) {
      const bool has_come = place(core) == round_.look().number();
      if (has_come) {
        asked_us_[core] = now_us;
        loss_[core] = Loss::kNone;
      } else if (now_us - asked_us_[core] > patience_us_) {
        loss_[core] = Loss::kSilent;
        troubles_ += was_silent_[core] ? 0U : 1U;
        was_silent_[core] = true;
      }
    });
  }

  void lose_faulted() {
    for_each_helper([this](std::size_t core) {
      if (cores_->state(core) != hal::CoreState::kRunning) {
        lose(core, Loss::kFaulted);
      }
    });
  }

  // Waits until every item is done or no helper is running an item. All items have already been
  // claimed. While a helper runs an item, its `place` is kInside.
  void wait() {
    const std::uint64_t begin_us = cores_->now_us();
    bool is_anyone_inside = true;
    while (is_anyone_inside) {
      lose_faulted();
      is_anyone_inside = false;
      for_each_helper([&](std::size_t core) { is_anyone_inside |= place(core) == kInside; });
      if (round_.is_done()) {
        return;
      }
      if (cores_->now_us() - begin_us > patience_us_) {
        lose_stuck();
        return;
      }
      cores_->pause();
    }
  }

  // Stops helpers that hang. If a helper cannot be stopped, the run ends, because the helper could
  // overwrite the output of the repeated item.
  void lose_stuck() {
    for_each_helper([this](std::size_t core) {
      if (place(core) == kInside) {
        require(cores_->stop(core));
        lose(core, Loss::kStuck);
      }
    });
  }

  void lose(std::size_t core, Loss loss) {
    loss_[core] = loss;
    ++troubles_;
  }

  [[nodiscard]] std::uint32_t place(std::size_t core) const {
    return seats_[core].place.load(std::memory_order_acquire);
  }

  C* cores_;
  std::uint32_t patience_us_;
  std::uint32_t redone_ = 0;
  std::uint32_t troubles_ = 0;
  std::array<Loss, hal::kMaxCores> loss_{};
  std::array<bool, hal::kMaxCores> was_silent_{};
  std::array<std::uint64_t, hal::kMaxCores> asked_us_{};
  Round round_;
  std::array<Seat, hal::kMaxCores> seats_{};
};

}  // namespace iog::work
