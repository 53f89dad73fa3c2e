// Cores as threads: the same bytes from any number of them, also when some are delayed or lost.
#include "work/team.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <thread>
#include <tuple>

#include "fakes/random.hpp"
#include "fakes/thread_cores.hpp"

namespace iog::work {
namespace {

using tests::ThreadCores;
using Phase = ThreadCores::Phase;

// For helpers that come in the end, however busy the PC is; and for those that never do.
constexpr std::uint32_t kAnyTimeUs = 60'000'000;
constexpr std::uint32_t kShortlyUs = 100'000;
constexpr std::size_t kItems = 64;

// A made-up item: what is read, 256 bytes that are written in two halves, and how often.
struct Item {
  std::uint64_t seed = 0;
  std::array<std::uint64_t, 32> bytes{};
  std::atomic<int> begun{0};
};

std::uint64_t word_of(std::uint64_t seed, std::size_t at) {
  return tests::Random(seed + at).next();
}

struct Pile {
  std::array<Item, kItems> items{};
  void (*half_way)(Pile& pile, std::size_t item) = [](Pile&, std::size_t) {};
  ThreadCores* cores = nullptr;

  void operator()(std::size_t number, std::size_t /*core*/) {
    Item& item = items[number];
    item.begun.fetch_add(1, std::memory_order_relaxed);
    for (std::size_t at = 0; at < item.bytes.size(); ++at) {
      item.bytes[at] = word_of(item.seed, at);
      if (at == item.bytes.size() / 2) {
        half_way(*this, number);
      }
    }
  }

  void renew(std::uint64_t round) {
    for (std::size_t number = 0; number < kItems; ++number) {
      items[number].seed = round * kItems + number;
      items[number].begun.store(0, std::memory_order_relaxed);
    }
  }

  [[nodiscard]] bool is_right(std::size_t count) const {
    for (std::size_t number = 0; number < count; ++number) {
      for (std::size_t at = 0; at < items[number].bytes.size(); ++at) {
        if (items[number].bytes[at] != word_of(items[number].seed, at)) {
          return false;
        }
      }
    }
    return true;
  }
};

struct Crew {
  Crew(std::size_t count, std::uint32_t patience_us) : cores(count), team(cores, patience_us) {
    pile.cores = &cores;
  }

  // Whether every item of a round is right.
  bool share(std::size_t items = kItems, Beside beside = {}) {
    pile.renew(++round);
    team.share(items, work_of(pile), beside);
    return pile.is_right(items);
  }

  // Declared before the cores: threads end before what they work on.
  Pile pile;
  std::uint64_t round = 0;
  ThreadCores cores;
  Team<ThreadCores> team;
};

class Cores : public testing::TestWithParam<std::size_t> {};

TEST_P(Cores, DoEveryItemOfEveryRoundOnce) {
  const auto crew = std::make_unique<Crew>(GetParam(), kAnyTimeUs);
  EXPECT_EQ(crew->team.start(GetParam()), GetParam());
  tests::Random random(GetParam());
  std::uint32_t items = 0;
  for (int round = 0; round < 500; ++round) {
    const std::size_t count = random.below(kItems + 1);
    ASSERT_TRUE(crew->share(count));
    for (std::size_t item = 0; item < kItems; ++item) {
      ASSERT_EQ(crew->pile.items[item].begun, item < count ? 1 : 0);
    }
    items += static_cast<std::uint32_t>(count);
  }
  // A helper counts an item after its flag.
  while (crew->team.items(0) + crew->team.items(1) + crew->team.items(2) + crew->team.items(3) !=
         items) {
    crew->cores.pause();
  }
  EXPECT_EQ(crew->team.cores(), GetParam());
  EXPECT_EQ(crew->team.redone(), 0U);
}

TEST_P(Cores, GiveTheSameBytesWhenItemsTakeAnyTime) {
  const auto crew = std::make_unique<Crew>(GetParam(), kAnyTimeUs);
  crew->team.start(GetParam());
  crew->pile.half_way = [](Pile& pile, std::size_t item) {
    tests::Random random(pile.items[item].seed + ThreadCores::current());
    std::this_thread::sleep_for(std::chrono::microseconds(random.below(200)));
  };
  for (int round = 0; round < 30; ++round) {
    ASSERT_TRUE(crew->share());
  }
  EXPECT_EQ(crew->team.cores(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(OneToFour, Cores, testing::Values(1U, 2U, 3U, 4U));

TEST(Team, IsNoLargerThanTheMachineAndNoLargerThanWanted) {
  Crew crew(2, kAnyTimeUs);
  EXPECT_EQ(crew.team.start(4), 2U);
  EXPECT_EQ(crew.team.loss(2), Loss::kNotAsked);
  Crew small(4, kAnyTimeUs);
  EXPECT_EQ(small.team.start(1), 1U);
  EXPECT_EQ(small.team.loss(1), Loss::kNotAsked);
}

// From which helper on all of them are lost, and how: all, two or one of three.
using Fate = std::tuple<std::size_t, Phase>;
class LostAt : public testing::TestWithParam<Fate> {};

TEST_P(LostAt, CostsNothingButTime) {
  const auto [first, phase] = GetParam();
  const auto crew = std::make_unique<Crew>(4, kShortlyUs);
  for (std::size_t core = first; core < 4; ++core) {
    crew->cores.hang_at(core, phase);
  }
  EXPECT_EQ(crew->team.start(4), phase == Phase::kStart ? first : 4U);
  const Loss expected = phase == Phase::kStart ? Loss::kNotUp : Loss::kSilent;
  for (std::size_t core = first; core < 4; ++core) {
    while (crew->team.loss(core) != expected) {
      ASSERT_TRUE(crew->share());
    }
  }
  ASSERT_TRUE(crew->share());
}

INSTANTIATE_TEST_SUITE_P(EachPhase, LostAt,
                         testing::Combine(testing::Values(1U, 2U, 3U),
                                          testing::Values(Phase::kStart, Phase::kAwake,
                                                          Phase::kLeft)));

TEST(Team, WhoWasSilentMayComeBack) {
  const auto crew = std::make_unique<Crew>(2, kShortlyUs);
  crew->team.start(2);
  crew->cores.hang_at(1, Phase::kAwake);
  while (crew->team.loss(1) != Loss::kSilent) {
    ASSERT_TRUE(crew->share());
  }
  EXPECT_EQ(crew->team.troubles(), 1U);
  EXPECT_EQ(crew->team.cores(), 2U);
  crew->cores.hang_at(1, Phase::kNever);
  const std::uint32_t before = crew->team.items(1);
  while (crew->team.loss(1) != Loss::kNone || crew->team.items(1) == before) {
    ASSERT_TRUE(crew->share());
  }
}

// Core 0 leaves the first items to the helpers, so that they get some.
void leave_some(std::size_t item) {
  if (ThreadCores::current() == 0 && item < 3) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

TEST(Team, AFaultInAnItemIsFoundAtOnceAndTheItemIsDoneAgain) {
  const auto crew = std::make_unique<Crew>(3, kAnyTimeUs);
  crew->team.start(3);
  crew->pile.half_way = [](Pile& pile, std::size_t item) {
    leave_some(item);
    if (ThreadCores::current() == 2) {
      pile.cores->fault();
    }
  };
  while (crew->team.loss(2) == Loss::kNone) {
    ASSERT_TRUE(crew->share());
  }
  EXPECT_EQ(crew->team.loss(2), Loss::kFaulted);
  EXPECT_EQ(crew->team.redone(), 1U);
  EXPECT_EQ(crew->team.cores(), 2U);
  ASSERT_TRUE(crew->share());
}

TEST(Team, WhoHangsInAnItemIsStoppedAndTheItemIsDoneAgain) {
  const auto crew = std::make_unique<Crew>(3, kShortlyUs);
  crew->team.start(3);
  crew->pile.half_way = [](Pile& pile, std::size_t item) {
    leave_some(item);
    if (ThreadCores::current() == 1) {
      pile.cores->hang();
    }
  };
  while (crew->team.loss(1) == Loss::kNone) {
    ASSERT_TRUE(crew->share());
  }
  EXPECT_EQ(crew->team.loss(1), Loss::kStuck);
  EXPECT_GE(crew->team.redone(), 1U);
  ASSERT_TRUE(crew->share());
}

TEST(Team, AllHelpersMayBeLostInTheSameRound) {
  const auto crew = std::make_unique<Crew>(4, kShortlyUs);
  crew->team.start(4);
  crew->pile.half_way = [](Pile& pile, std::size_t item) {
    leave_some(item);
    if (ThreadCores::current() != 0) {
      pile.cores->hang();
    }
  };
  while (crew->team.cores() > 1) {
    ASSERT_TRUE(crew->share());
  }
  EXPECT_GE(crew->team.redone(), 1U);
  ASSERT_TRUE(crew->share());
}

// Core 0 does it once, and helpers need not wait for it: an item is done before it ends.
TEST_P(Cores, DoWhatIsBesideOnceWhileItemsAreDone) {
  const auto crew = std::make_unique<Crew>(GetParam(), kAnyTimeUs);
  crew->team.start(GetParam());
  for (int round = 1; round <= 50; ++round) {
    int times = 0;
    std::size_t core = GetParam();
    bool was_before = false;
    auto beside = [&] {
      ++times;
      core = ThreadCores::current();
      const auto is_done = [&] {
        return std::ranges::any_of(crew->pile.items,
                                   [](const Item& item) { return item.begun > 0; });
      };
      was_before = !is_done();
      while (GetParam() > 1 && !is_done()) {
        crew->cores.pause();
      }
    };
    ASSERT_TRUE(crew->share(kItems, beside_of(beside)));
    ASSERT_EQ(times, 1);
    ASSERT_EQ(core, 0U);
    ASSERT_TRUE(GetParam() > 1 || was_before) << "alone it comes first";
  }
}

TEST(Team, WhatIsBesideIsDoneWithoutItems) {
  const auto crew = std::make_unique<Crew>(2, kAnyTimeUs);
  crew->team.start(2);
  int times = 0;
  auto beside = [&] { ++times; };
  for (std::size_t items = 0; items < 3; ++items) {
    ASSERT_TRUE(crew->share(items, beside_of(beside)));
  }
  EXPECT_EQ(times, 3);
}

TEST(Team, WhoHangsBesideSomethingIsStoppedAndItIsDoneOnce) {
  const auto crew = std::make_unique<Crew>(2, kShortlyUs);
  crew->team.start(2);
  crew->pile.half_way = [](Pile& pile, std::size_t item) {
    leave_some(item);
    if (ThreadCores::current() == 1) {
      pile.cores->hang();
    }
  };
  int times = 0;
  auto beside = [&] { ++times; };
  int rounds = 0;
  while (crew->team.loss(1) == Loss::kNone) {
    ASSERT_TRUE(crew->share(kItems, beside_of(beside)));
    ++rounds;
  }
  EXPECT_EQ(crew->team.loss(1), Loss::kStuck);
  EXPECT_EQ(times, rounds);
}

// Nobody has work for them: they come when they are called, and are counted.
TEST_P(Cores, ComeWhenTheyAreCalledWithoutWork) {
  const auto crew = std::make_unique<Crew>(GetParam(), kAnyTimeUs);
  crew->team.start(GetParam());
  for (std::uint32_t call = 1; call <= 20; ++call) {
    crew->team.call();
    for (std::size_t core = 1; core < GetParam(); ++core) {
      while (crew->team.comes(core) < call) {
        crew->cores.pause();
      }
    }
  }
  EXPECT_TRUE(crew->share()) << "and a round is as ever";
  EXPECT_EQ(crew->team.troubles(), 0U);
}

TEST(Team, OneThatHangsIdleDoesNotComeWhenItIsCalled) {
  const auto crew = std::make_unique<Crew>(3, kAnyTimeUs);
  crew->team.start(3);
  crew->cores.hang_at(2, Phase::kAwake);
  for (std::uint32_t call = 1; call <= 5; ++call) {
    crew->team.call();
    while (crew->team.comes(1) < call) {
      crew->cores.pause();
    }
  }
  EXPECT_EQ(crew->team.comes(2), 0U);
  EXPECT_TRUE(crew->team.is_asked(2)) << "it is up, as far as anybody knows";
  crew->cores.hang_at(2, Phase::kNever);
}

}  // namespace
}  // namespace iog::work
