// Every order in which three cores can take their steps, over two rounds of two items.
//
// The round is the real one. What Team does around it stands here as steps, each with one access to
// what cores share, so that all their orders can be tried: a helper may be ended before any of its
// steps, and core 0 may lose patience whenever it waits. States that were met before are not gone
// on from. Memory is sequential here: what may be seen late is ThreadSanitizer's business.
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "fakes/effort.hpp"
#include "work/round.hpp"

namespace iog::work {
namespace {

constexpr std::size_t kCores = 3;
constexpr std::size_t kItems = tests::effort(2, 1);
constexpr int kRounds = 2;
constexpr int kHalfWritten = -1;
constexpr std::size_t kNobody = 99;

// Where a core is: what its next step does.
enum class At : std::uint8_t {
  kAsleep,  // helpers: come when woken
  kLook,
  kClaim,
  kBegin,
  kRun,
  kFinish,
  kLeave,  // helpers: say which round has nothing left
  kOpen,   // core 0, from here on
  kWake,
  kFindLost,
  kFindInside,
  kAsk,
  kRedo,
  kCheck,
  kEnded,
};

// A choice is a core that takes a step, a helper that ends, or core 0 that has no more patience.
constexpr std::size_t kEndOfHelper = kCores - 1;  // + core
constexpr std::size_t kNoPatience = kEndOfHelper + kCores;
constexpr std::size_t kChoices = kNoPatience + 1;

class Schedule {
 public:
  Schedule() { cores_[0].at = At::kOpen; }
  Schedule(const Schedule&) = delete;
  Schedule& operator=(const Schedule&) = delete;

  [[nodiscard]] bool can(std::size_t choice) const {
    if (choice < kCores) {
      const Core& core = cores_[choice];
      return core.at != At::kEnded && (core.at != At::kAsleep || core.is_woken);
    }
    if (choice < kNoPatience) {
      return ended_ == 0 && cores_[choice - kEndOfHelper].at != At::kEnded;
    }
    return cores_[0].at == At::kFindLost;
  }

  void take(std::size_t choice) {
    if (choice < kCores) {
      step(choice);
    } else if (choice < kNoPatience) {
      cores_[choice - kEndOfHelper].at = At::kEnded;
      ++ended_;
    } else {
      stop_who_is_inside();
      cores_[0].at = At::kRedo;
    }
  }

  [[nodiscard]] bool is_over() const { return cores_[0].at == At::kEnded; }
  [[nodiscard]] const std::string& fault() const { return fault_; }

  // All that decides what may still happen, a byte for each value.
  [[nodiscard]] std::string state() const {
    std::string state;
    const auto add = [&state](std::size_t value) { state += static_cast<char>(value); };
    const auto add_ticket = [&add](Round::Ticket ticket) {
      add(ticket.number());  // at most kRounds
      add(ticket.left());
    };
    for (const Core& core : cores_) {
      add(static_cast<std::size_t>(core.at));
      add_ticket(core.seen);
      add(core.item);
      add((core.is_woken ? 1U : 0U) + (core.is_inside ? 2U : 0U) + (core.is_lost ? 4U : 0U));
    }
    for (std::size_t item = 0; item < kItems; ++item) {
      add(static_cast<std::size_t>(made_[item]) + 1);
      add(is_finished_[item] ? 1 : 0);
      add(owner_[item]);
    }
    add_ticket(round_.look());
    add(static_cast<std::size_t>(number_));
    add(ended_ + (is_anyone_inside_ ? 10U : 0U));
    add(next_woken_);
    return state;
  }

 private:
  struct Core {
    At at = At::kAsleep;
    Round::Ticket seen{};
    std::size_t item = 0;
    bool is_woken = false;
    bool is_inside = false;
    bool is_lost = false;  // as core 0 knows
  };

  void blame(const char* what) { fault_ = fault_.empty() ? what : fault_; }

  void step(std::size_t number) {
    Core& core = cores_[number];
    switch (core.at) {
      case At::kAsleep:
        core.is_woken = false;
        core.is_inside = true;
        core.at = At::kLook;
        return;
      case At::kLook:
        core.seen = round_.look();
        core.at = core.seen.left() > 0 ? At::kClaim : done_with_items(number);
        return;
      case At::kClaim:
        claim(number, core);
        return;
      case At::kBegin:
        begin(number, core.item);
        core.at = At::kRun;
        return;
      case At::kRun:
        round_.run(core.item, number);
        core.at = At::kFinish;
        return;
      case At::kFinish:
        owner_[core.item] = kNobody;
        is_finished_[core.item] = true;
        round_.finish(core.item);
        core.at = At::kLook;
        return;
      case At::kLeave:
        core.is_inside = false;
        core.at = At::kAsleep;
        return;
      default:
        lead(core);
    }
  }

  static At done_with_items(std::size_t number) { return number == 0 ? At::kFindLost : At::kLeave; }

  void claim(std::size_t number, Core& core) {
    if (const std::optional<std::size_t> item = round_.claim(core.seen)) {
      core.item = *item;
      core.at = At::kBegin;
    } else if (core.seen.left() == 0) {
      core.at = done_with_items(number);
    }
  }

  // The steps of core 0 alone.
  void lead(Core& core) {
    switch (core.at) {
      case At::kOpen:
        open(core);
        return;
      case At::kWake:
        ++next_woken_;
        cores_[next_woken_].is_woken |= !cores_[next_woken_].is_lost;
        core.at = next_woken_ + 1 < kCores ? At::kWake : At::kLook;
        return;
      case At::kFindLost:
        for (Core& other : cores_) {
          other.is_lost |= other.at == At::kEnded;
        }
        core.at = At::kFindInside;
        return;
      case At::kFindInside:
        is_anyone_inside_ = false;
        for (const Core& other : cores_) {
          is_anyone_inside_ |= other.is_inside && !other.is_lost;
        }
        core.at = At::kAsk;
        return;
      case At::kAsk:
        core.at = round_.is_done() ? At::kCheck : is_anyone_inside_ ? At::kFindLost : At::kRedo;
        return;
      case At::kRedo:
        round_.redo();
        core.at = At::kCheck;
        return;
      default:
        check();
        core.at = At::kOpen;
    }
  }

  void open(Core& core) {
    if (number_ == kRounds) {
      core.at = At::kEnded;
      return;
    }
    ++number_;
    is_finished_ = {};
    next_woken_ = 0;
    is_anyone_inside_ = false;
    round_.open(kItems, work_of(make_));
    core.at = At::kWake;
  }

  void begin(std::size_t number, std::size_t item) {
    if (owner_[item] != kNobody && cores_[owner_[item]].at != At::kEnded) {
      blame("two cores do an item");
    }
    owner_[item] = number;
    made_[item] = kHalfWritten;
  }

  // The work, of a claimed item or of one that is done again.
  void make(std::size_t item, std::size_t core) {
    if (is_finished_[item]) {
      blame("a finished item is done");
    }
    const std::size_t owner = owner_[item];
    if (owner != kNobody && owner != core && cores_[owner].at != At::kEnded) {
      blame("an item is done again while a core does it");
    }
    made_[item] = number_;
  }

  void check() {
    for (const int made : made_) {
      if (made != number_) {
        blame("a round ended with an item undone");
      }
    }
  }

  void stop_who_is_inside() {
    for (Core& core : cores_) {
      if (core.is_inside) {
        core.at = At::kEnded;
        core.is_lost = true;
      }
    }
  }

  static std::array<std::size_t, kItems> filled_with_nobody() {
    std::array<std::size_t, kItems> owners{};
    owners.fill(kNobody);
    return owners;
  }

  struct Make {
    Schedule* schedule;
    void operator()(std::size_t item, std::size_t core) const { schedule->make(item, core); }
  };

  Make make_{this};
  Round round_;
  std::array<Core, kCores> cores_{};
  std::array<int, kItems> made_{};
  std::array<bool, kItems> is_finished_{};
  std::array<std::size_t, kItems> owner_ = filled_with_nobody();
  std::size_t next_woken_ = 0;
  std::size_t ended_ = 0;  // by themselves
  bool is_anyone_inside_ = false;
  int number_ = 0;
  std::string fault_;
};

using Choices = std::vector<std::size_t>;

void replay(const Choices& choices, Schedule& schedule) {
  for (const std::size_t choice : choices) {
    schedule.take(choice);
  }
}

// Core 0 alone comes to the end, whatever the others are at.
std::string fault_alone(Schedule& schedule) {
  for (int steps = 0; steps < 100 && !schedule.is_over(); ++steps) {
    schedule.take(schedule.can(kNoPatience) ? kNoPatience : 0);
  }
  return schedule.is_over() ? schedule.fault() : "core 0 does not come to the end";
}

struct Exploration {
  std::unordered_set<std::string> states;
  std::string fault;
  Choices at;  // how it came to the fault
  std::size_t ends = 0;
};

// Goes on from every state that was not met before, the last one first.
Exploration explore() {
  Exploration all;
  std::vector<Choices> open{{}};
  while (!open.empty()) {
    const Choices choices = open.back();
    open.pop_back();
    Schedule schedule;
    replay(choices, schedule);
    if (!all.states.insert(schedule.state()).second) {
      continue;
    }
    all.ends += schedule.is_over() ? 1U : 0U;
    for (std::size_t choice = 0; choice < kChoices; ++choice) {
      if (!schedule.is_over() && schedule.can(choice)) {
        open.push_back(choices);
        open.back().push_back(choice);
      }
    }
    all.fault = schedule.fault().empty() ? fault_alone(schedule) : schedule.fault();
    if (!all.fault.empty()) {
      all.at = choices;
      return all;
    }
  }
  return all;
}

TEST(Protocol, DoesEveryItemOfEveryRoundInEveryOrder) {
  const Exploration all = explore();
  EXPECT_EQ(all.fault, "") << "after " << testing::PrintToString(all.at);
  EXPECT_GT(all.states.size(), 1000U);
  EXPECT_GT(all.ends, 0U);
  RecordProperty("states", std::to_string(all.states.size()));
}

}  // namespace
}  // namespace iog::work
