// The watchdog is served while everybody lives; who does not ends the run in time, and is named.
#include "app/life.hpp"

#include <gtest/gtest.h>
#include <string_view>
#include <vector>

#include "app/loop.hpp"
#include "fake_machine.hpp"
#include "net/frames.hpp"

namespace iog::app {
namespace {

using testing::FakeMachine;

constexpr std::uint64_t kPassUs = 1000;
constexpr std::uint32_t bit(Alive who) { return 1U << static_cast<unsigned>(who); }

// A loop of which everybody does his part, unless a test says who does not.
class Bench {
 public:
  explicit Bench(std::size_t cores = 4)
      : platform_(machine_with(cores), net::testing::kConfig, cores) {
    machine.ethernet().excuse(false);
  }

  // Until the run ends, or for this long; after how many microseconds it has ended, 0: it has not.
  std::uint64_t run(std::uint64_t duration_us) {
    const std::uint64_t begin_us = now_us();
    while (now_us() - begin_us < duration_us) {
      pass();
      if (!machine.ends.empty()) {
        return now_us() - begin_us;
      }
      machine.clock().time_us += kPassUs;
    }
    return 0;
  }

  // Whoever does not show from now on that he lives.
  std::uint32_t silent = 0;
  FakeMachine machine;

 private:
  [[nodiscard]] bool shows(Alive who) const { return (silent & bit(who)) == 0; }
  [[nodiscard]] std::uint64_t now_us() { return machine.clock().now_us(); }

  FakeMachine& machine_with(std::size_t cores) {
    machine.cores().machine_has = cores;
    return machine;
  }

  void pass() {
    for (const Alive who : {Alive::kDatagrams, Alive::kTime, Alive::kNetwork, Alive::kLine}) {
      if (shows(who)) {
        life_.lives(who, now_us());
      }
    }
    if (shows(Alive::kFrames)) {
      static_cast<void>(platform_.vitals({}));
    }
    if (shows(Alive::kMemory)) {
      static_cast<void>(check_.step(now_us()));
    }
    if (shows(Alive::kPort)) {
      machine.ethernet().arrive(net::testing::linux_arp_reply());
      static_cast<void>(machine.ethernet().receive());
      machine.ethernet().release();
    }
    for (std::size_t core = 1; core < hal::kMaxCores; ++core) {
      const auto who = static_cast<Alive>(static_cast<std::size_t>(Alive::kCore1) + core - 1);
      machine.cores().comes[core] = shows(who);
    }
    life_.end_pass(machine, platform_, check_);
  }

  MachinePlatform<FakeMachine> platform_;
  health::MemoryCheck check_{{}};
  Life life_{machine.clock().now_us()};
};

TEST(Life, TheWatchdogIsServedInEachPassWhileAllLive) {
  Bench bench;
  EXPECT_EQ(bench.run(60'000'000), 0U);
  EXPECT_EQ(bench.machine.watchdog().services, 60'000U);
}

// docs/safety.md: within 5 s, and 10 s of the check of memory; a call's period of cores and port.
TEST(Life, WhoeverFallsSilentEndsTheRunInHisWindowAndIsNamed) {
  const std::array<std::string_view, kAliveCount> names = {
      "datagrams",           "time",   "network", "serial line", "frames", "check of memory",
      "Ethernet controller", "core 1", "core 2",  "core 3"};
  for (std::size_t i = 0; i < kAliveCount; ++i) {
    const auto who = static_cast<Alive>(i);
    Bench bench;
    ASSERT_EQ(bench.run(3'000'000), 0U);
    bench.silent = bit(who);
    const std::uint64_t window_us = who == Alive::kMemory ? 10'000'000 : 5'000'000;
    const std::uint64_t ended_us = bench.run(20'000'000);
    EXPECT_GT(ended_us, window_us - health::MemoryCheck::kRoundUs) << names.at(i);
    EXPECT_LE(ended_us, window_us + 2 * Life::kCallUs) << names.at(i);
    ASSERT_EQ(bench.machine.ends.size(), 1U);
    EXPECT_EQ(bench.machine.ends[0], (hal::End{hal::EndCause::kLate, bit(who)})) << names.at(i);
    EXPECT_EQ(bench.machine.last_words, names.at(i));
  }
}

TEST(Life, TheWatchdogIsNotServedInThePassThatEndsTheRun) {
  Bench bench;
  bench.silent = bit(Alive::kNetwork);
  ASSERT_GT(bench.run(10'000'000), 0U);
  const std::uint32_t passes = 5'000'000 / kPassUs + 1;
  EXPECT_EQ(bench.machine.watchdog().services, passes);
}

// docs/cores.md: it is reported, the others do its work.
TEST(Life, ACoreThatIsKnownToBeGoneIsExcused) {
  for (const hal::CoreState state : {hal::CoreState::kFaulted, hal::CoreState::kStopped}) {
    Bench bench;
    ASSERT_EQ(bench.run(1'000'000), 0U);
    bench.silent = bit(Alive::kCore2);
    bench.machine.cores().states[2] = state;
    EXPECT_EQ(bench.run(30'000'000), 0U);
  }
}

TEST(Life, CoresThatTheMachineDoesNotHaveAreNotMissed) {
  Bench bench(1);
  bench.silent = bit(Alive::kCore1) | bit(Alive::kCore2) | bit(Alive::kCore3);
  EXPECT_EQ(bench.run(30'000'000), 0U);
}

TEST(Life, APortThatSaysWhyItIsSilentIsExcused) {
  Bench bench;
  bench.silent = bit(Alive::kPort);
  bench.machine.ethernet().excuse(true);
  EXPECT_EQ(bench.run(30'000'000), 0U);
}

// docs/safety.md: within a round and a pass, with the number of what has changed.
TEST(Life, MemoryThatHasChangedEndsTheRun) {
  FakeMachine machine;
  std::vector<std::byte> code(100'000);
  std::vector<std::byte> tables(5000);
  const std::vector<health::Region> regions = {
      {.name = "code", .bytes = code, .crc = health::crc_of(code)},
      {.name = "tables", .bytes = tables, .crc = health::crc_of(tables)}};
  health::MemoryCheck check(regions);
  const auto run_until_ended = [&](std::uint64_t most_us) {
    const std::uint64_t end_us = machine.clock().now_us() + most_us;
    while (machine.ends.empty() && machine.clock().now_us() < end_us) {
      check_memory(machine, check);
      machine.idle();
    }
  };
  run_until_ended(3 * health::MemoryCheck::kRoundUs);
  EXPECT_TRUE(machine.ends.empty());
  tables[4999] ^= std::byte{0x80};
  run_until_ended(health::MemoryCheck::kRoundUs + 1000);
  ASSERT_EQ(machine.ends.size(), 1U);
  EXPECT_EQ(machine.ends[0].cause, hal::EndCause::kMemory);
  EXPECT_EQ(machine.ends[0].detail, 1U);
  EXPECT_EQ(machine.last_words, "tables");
}

}  // namespace
}  // namespace iog::app
