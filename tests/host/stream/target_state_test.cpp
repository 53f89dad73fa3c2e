// The counters by name: their places are those of docs/spec.md 3.7 in version 5 of the stream.
#include "stream/target_state.hpp"

#include <gtest/gtest.h>

namespace iog::stream {
namespace {

static_assert(place_of("frames received") == 0);
static_assert(place_of("short") == 7);
static_assert(place_of("peer unresolved") == 7 + 19);
static_assert(place_of("port received") == 7 + 19 + 3);
static_assert(place_of("fragments joined") == 7 + 19 + 3 + 5);
static_assert(place_of("cores at work") == 7 + 19 + 3 + 5 + 8);
static_assert(place_of("port without room") == 42 + 6);
static_assert(place_of("starts since power-up") == 42 + 6 + 4);
static_assert(place_of("fuse") == 42 + 6 + 4 + 3);
static_assert(place_of("late") == 55 + 5 * 13);
static_assert(place_of(Group::kLater) == 55 + 10 * 13);
static_assert(place_of(Group::kDiscovery) == 185 + 16);
static_assert(place_of(Group::kCommand) == 201 + 14);
static_assert(place_of("commands MAC") == 215 + 10);
static_assert(kMaxLinkCounters == 215 + 12);

TEST(TargetState, NamesOfAGroupAreInTheirOrder) {
  EXPECT_EQ(names_of<Group::kStage>(),
            (std::array<std::string_view, 4>{"fuse", "mark", "publish", "perceive"}));
}

// Two of the port and one of the network, in an order of their own.
struct Some {
  std::uint32_t restarts = 0;
  std::array<std::uint32_t, 2> mac{};
  std::uint32_t misuse = 0;
  static constexpr std::array<std::string_view, 3> kNames{"port restarts", "commands MAC",
                                                          "misuse"};
};

TEST(TargetState, EachCounterGoesWhereItsNameIs) {
  LinkCounters counters{};
  put(Some{.restarts = 1, .mac = {2, 3}, .misuse = 4}, counters);
  LinkCounters expected{};
  expected[49] = 1;
  expected[225] = 2;
  expected[226] = 3;
  expected[28] = 4;
  EXPECT_EQ(counters, expected);
}

TEST(TargetState, WhoCountsReadsItsCountersAgain) {
  LinkCounters counters{};
  counters[225] = 2;
  counters[226] = 3;
  const auto some = get<Some>(counters, kMaxLinkCounters);
  ASSERT_TRUE(some.has_value());
  EXPECT_EQ(some->mac, (std::array<std::uint32_t, 2>{2, 3}));
  EXPECT_FALSE(get<Some>(counters, kMaxLinkCounters - 1)) << "the target does not say the last";
  EXPECT_FALSE(get<Some>(counters, 0));
}

constexpr bool is_counted(const Counter& counter) {
  return is_link(counter) && counter.kind != Kind::kRoom;
}
struct All {
  std::array<std::uint32_t, kMaxLinkCounters - kSpareWords> words{};
  static constexpr auto kNames = [] {
    std::array<std::string_view, std::ranges::count_if(kCounters, is_counted)> names{};
    auto name = names.begin();
    for (const Counter& counter : kCounters) {
      if (is_counted(counter)) {
        *name++ = counter.name;
      }
    }
    return names;
  }();
};
struct One {
  std::uint32_t word = 0;
  static constexpr std::array<std::string_view, 1> kNames{"misuse"};
};

struct Spare {
  std::array<std::uint32_t, kSpareWords> words{};
  static constexpr std::array<std::string_view, 1> kNames{"spare"};
};

TEST(TargetState, ACounterIsCountedByOneAlone) {
  static_assert(is_each_counted_once<All>());
  static_assert(!is_each_counted_once<One>(), "the others are missing");
  static_assert(!is_each_counted_once<All, Some>(), "three are there twice");
  static_assert(!is_each_counted_once<All, Spare>(), "those have no name yet");
}

// docs/spec.md 3.2: datagrams dropped, whatever the cause.
TEST(TargetState, LostDatagramsAreTheSumOfTheirCauses) {
  LinkCounters counters{};
  counters.fill(1);
  EXPECT_EQ(losses_of(counters), 13U);
  counters = {};
  counters[place_of("bad UDP checksum")] = 5;
  counters[place_of("received lost by restarts")] = 7;
  counters[place_of("port restarts")] = 100;
  EXPECT_EQ(losses_of(counters), 12U);
}

}  // namespace
}  // namespace iog::stream
