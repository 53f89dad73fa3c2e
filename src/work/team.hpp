// The cores that work together: core 0, which deals out rounds, and the helpers.
//
// Core 0 takes items like any helper, so a round ends without any of them. A helper that faults or
// hangs in an item is ended and never asked again, and core 0 does its item. One that does not come
// holds none, and may come later. So nothing but time is lost. No wait is longer than the patience,
// unless items are.
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

// Why a core does not work.
enum class Loss : std::uint8_t {
  kNone,
  kNotAsked,  // the machine does not have it, or fewer were wanted
  kNotUp,     // it did not come up
  kFaulted,   // an exception or a broken requirement ended it
  kStuck,     // it did not end what it had begun
  kSilent,    // it was woken and has not come yet; it is woken again
};

// Since the start, modulo 2^32.
struct TeamCounts {
  std::uint32_t at_work = 0;                          // cores, now
  std::uint32_t for_lost = 0;                         // items that core 0 did for lost ones
  std::array<std::uint32_t, hal::kMaxCores> items{};  // done by each core

  // In the stream (stream/target_table.hpp).
  static constexpr auto kNames =
      std::to_array<std::string_view>({"cores at work", "items for lost cores", "items of core 0",
                                       "items of core 1", "items of core 2", "items of core 3"});
};

template <hal::Cores C>
class Team {
 public:
  // cores outlive the team. patience_us: how long a helper may take for what all others have done,
  // and to come when it is woken; longer than any item.
  Team(C& cores, std::uint32_t patience_us) : cores_(&cores), patience_us_(patience_us) {
    loss_.fill(Loss::kNotAsked);
    loss_[0] = Loss::kNone;
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  // Once: starts helpers until `wanted` cores work, core 0 included, if there are as many. How many
  // do.
  std::size_t start(std::size_t wanted) {
    const std::size_t count = std::min(wanted, cores_->count());
    for (std::size_t core = 1; core < hal::kMaxCores && core < count; ++core) {
      seats_[core].place.store(round_.look().number(), std::memory_order_relaxed);
      const bool is_up = cores_->start(core, {.run = &Team::help_from, .context = this});
      loss_[core] = is_up ? Loss::kNone : Loss::kNotUp;
    }
    return cores();
  }

  // Does every item, on whatever core, and returns when all are done. Core 0 does what is beside
  // them first, while helpers begin.
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

  // Between rounds: wakes every helper that may come, though there is nothing to do, so that
  // comes() can tell which live.
  void call() {
    lose_faulted();
    for_each_helper([this](std::size_t core) { cores_->wake(core); });
  }

  // How many cores work or may come, core 0 included.
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

  // Whether a helper should come when it is woken: it is up, and not known to be gone.
  [[nodiscard]] bool is_asked(std::size_t core) const {
    return loss_[core] == Loss::kNone || loss_[core] == Loss::kSilent;
  }
  // Since the start, modulo 2^32: how often a helper came when it was woken, and has gone again.
  [[nodiscard]] std::uint32_t comes(std::size_t core) const {
    return seats_[core].comes.load(std::memory_order_relaxed);
  }

  // Since the start, modulo 2^32: what a core has done, and what core 0 did for lost ones.
  [[nodiscard]] std::uint32_t items(std::size_t core) const {
    return seats_[core].items.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint32_t redone() const { return redone_; }
  [[nodiscard]] TeamCounts counts() const {
    return {.at_work = static_cast<std::uint32_t>(cores()),
            .for_lost = redone(),
            .items = {items(0), items(1), items(2), items(3)}};
  }

  // Grows with each core that is lost, or silent for the first time.
  [[nodiscard]] std::uint32_t troubles() const { return troubles_; }

 private:
  // Beyond the numbers of rounds: the helper looks for items.
  static constexpr std::uint32_t kInside = 1U << 16;

  // Written by its core alone, on a cache line of its own.
  struct alignas(64) Seat {
    std::atomic<std::uint32_t> place{0};  // kInside, or the round that it found without items
    std::atomic<std::uint32_t> items{0};
    std::atomic<std::uint32_t> comes{0};
  };

  static void help_from(void* context, std::size_t core) {
    Team& team = *static_cast<Team*>(context);
    Seat& seat = team.seats_[core];
    // Released by claiming the first item.
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

  // A helper that has ended is lost; one that did not come in time when it was woken is silent. One
  // that has come is about to be woken again.
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

  // Until every item is done or no helper is left that does one. All are taken by now, and a helper
  // that has one is inside.
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

  // A core that cannot be ended could write over what is done in its place: then the run ends.
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
