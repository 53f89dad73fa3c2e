// A platform (app/platform.hpp) whose cores are threads, one of which may meet with an accident.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <thread>
#include <vector>

#include "app/platform.hpp"
#include "fakes/random.hpp"
#include "fakes/store_trap.hpp"
#include "fakes/thread_cores.hpp"
#include "work/team.hpp"

namespace iog::app::testing {

// For helpers that come in the end, however busy the PC is; and for those that never do.
inline constexpr std::uint32_t kAnyTimeUs = 60'000'000;
inline constexpr std::uint32_t kShortlyUs = 100'000;

// What befalls the core of the last number, around an item that it does.
enum class Accident : std::uint8_t { kNone, kFaultBefore, kFaultAfter, kHangBefore, kHangAfter };

// Keeps every message, and lets a team do what is shared.
class SharingPlatform {
 public:
  using Message = std::vector<std::byte>;

  SharingPlatform(std::size_t cores, std::uint32_t patience_us)
      : victim_(cores - 1), cores_(cores), team_(cores_, patience_us) {
    team_.start(cores);
  }

  [[nodiscard]] bool send_message(std::span<const std::byte> message) {
    messages.emplace_back(message.begin(), message.end());
    return true;
  }
  std::uint32_t ticks() { return 0; }
  std::uint32_t ticks_hz() { return 1; }
  Vitals vitals(const FrameTimes& /*times*/) { return {}; }
  std::uint32_t run_number() { return 1; }
  [[nodiscard]] std::size_t cores() const { return asked_ > 0 && asked_-- > 0 ? 3 : team_.cores(); }

  void share(std::size_t items, work::Work work, work::Beside beside = {}) {
    const bool is_due = items > 1 && rounds >= first_round_ && team_.cores() > 1;
    const std::size_t first_item = items * item_percent_ / 100;
    auto endangered = [this, work, is_due, first_item](std::size_t item, std::size_t core) {
      const bool is_endangered = is_due && item >= first_item;
      if (is_endangered) {
        let_victim_begin(core);
        meet(Accident::kFaultBefore, Accident::kHangBefore, core);
      }
      dawdle();
      work.run(work.context, item, core);
      dawdle();
      if (is_endangered) {
        meet(Accident::kFaultAfter, Accident::kHangAfter, core);
      }
    };
    team_.share(items, work::work_of(endangered), beside);
    if (trap_ != nullptr) {
      trap_->open();
    }
    rounds += items > 1 ? 1U : 0U;
  }

  // From this round on, of those with several items: the victim meets with it in its next item
  // behind that part of them.
  void let_happen(Accident accident, std::size_t round = 0, std::size_t item_percent = 0) {
    accident_ = accident;
    first_round_ = round;
    item_percent_ = item_percent;
  }
  // In such an item it ends when it stores into its next page of the trap but so many.
  void let_trap(tests::StoreTrap& trap, int pages) {
    trap_ = &trap;
    trap.aim_at(cores_, victim_, pages);
  }
  // Each item is delayed at either end by up to so much, by chance.
  void delay(std::uint32_t most_us) { most_delay_us_ = most_us; }

  // It does all alone, and has lost its helpers when it has been asked so often for its cores.
  void have_helpers_when_asked(int times) { asked_ = times; }

  [[nodiscard]] std::uint32_t items_of_helpers() const {
    return team_.items(1) + team_.items(2) + team_.items(3);
  }
  [[nodiscard]] std::uint32_t redone() const { return team_.redone(); }
  [[nodiscard]] work::Loss fate_of_victim() const { return team_.loss(victim_); }

  std::vector<Message> messages;
  std::size_t rounds = 0;  // of several items

 private:
  // Core 0 waits for it, but not if others have left nothing to it.
  void let_victim_begin(std::size_t core) {
    if (core == victim_ && !victim_has_begun_.exchange(true) && trap_ != nullptr) {
      trap_->close();
    }
    for (int waits = 0; core == 0 && !victim_has_begun_ && waits < 10'000; ++waits) {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  }

  void meet(Accident fault, Accident hang, std::size_t core) {
    if (core == 0 || core != victim_) {
      return;
    }
    if (accident_ == fault) {
      cores_.fault();
    }
    if (accident_ == hang) {
      cores_.hang();
    }
  }

  void dawdle() const {
    if (most_delay_us_ > 0) {
      static thread_local tests::Random random(tests::ThreadCores::current());
      const auto us = random.below(most_delay_us_);
      std::this_thread::sleep_for(std::chrono::microseconds(us));
    }
  }

  std::size_t victim_;
  Accident accident_ = Accident::kNone;
  std::size_t first_round_ = 0;
  std::size_t item_percent_ = 0;
  tests::StoreTrap* trap_ = nullptr;
  std::uint32_t most_delay_us_ = 0;
  mutable int asked_ = 0;
  std::atomic<bool> victim_has_begun_ = false;
  tests::ThreadCores cores_;
  work::Team<tests::ThreadCores> team_;
};
static_assert(Platform<SharingPlatform>);

}  // namespace iog::app::testing
