// Any crew, any accident, the same messages: what several cores make of a drive is, byte for byte,
// what one makes of it, however long they take and wherever one of them is lost.
#include <algorithm>
#include <array>
#include <cstddef>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/store_trap.hpp"
#include "shared_drives.hpp"

namespace iog::app {
namespace {

using testing::Accident;
using testing::kAnyTimeUs;
using testing::kShortlyUs;
using testing::Played;
using testing::SharingPlatform;

struct Case {
  const char* name;
  Played (*play)(SharingPlatform&);
  const Case* like = nullptr;  // by one core it gives the same as this one
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

constexpr Case kOnePart{"a packet a scan",
                        [](auto& p) { return testing::play_three_lux(p, 1, 3); }};
constexpr Case kFourParts{"four", [](auto& p) { return testing::play_three_lux(p, 4, 3); }};
constexpr Case kManyParts{"twenty", [](auto& p) { return testing::play_three_lux(p, 20, 3); }};
constexpr Case kManySlices{"more slices than parts of a round",
                           [](auto& p) { return testing::play_three_lux(p, 20, 0); }};
constexpr Case kCircle{"a circle", [](auto& p) { return testing::play_circle(p, {}); }};
constexpr Case kGradedCircle{
    "graded evidence", [](auto& p) { return testing::play_circle(p, testing::kGradedRules); }};
constexpr Case kOverBudget{
    "over budget", [](auto& p) { return testing::play_circle(p, {.group_budget = 3'000}); }};
constexpr Case kRectangle{"a window of 7 by 5 tiles", [](auto& p) {
                            return testing::play_circle(p, {.extent = {.columns = 7, .rows = 5}});
                          }};
constexpr Case kRectangleOverGround{"a window of 6 by 9 tiles over the ground", [](auto& p) {
                                      vehicle::Vehicle car = testing::ground_vlp16();
                                      car.window.extent = {.columns = 6, .rows = 9};
                                      return testing::play_parts_of_turns(p, car);
                                    }};
constexpr Case kShortSlices{"more slices than are placed at once", testing::play_short_slices};
constexpr Case kClassesOverGround{"classes over the ground", [](auto& p) {
                                    return testing::play_parts_of_turns(p, testing::ground_vlp16());
                                  }};
constexpr Case kTurns{"turns", [](auto& p) {
                        return testing::play_turns(p, tests::LevelVlp16::kVehicle,
                                                   testing::three_turns());
                      }};
constexpr Case kTurnsOverGround{"turns over the ground", [](auto& p) {
                                  return testing::play_turns(p, testing::ground_vlp16(),
                                                             testing::three_turns());
                                }};
constexpr Case kShuffled{"turns shuffled", testing::play_shuffled_turns, &kTurnsOverGround};
constexpr Case kFullFrames{"more parts than places", testing::play_full_frames};
constexpr Case kBayes{"evidence that does not join", testing::play_bayes};
constexpr Case kTiles{"tiles", testing::play_tiles};
constexpr Case kNewClasses{"classes that are all new",
                           [](auto& p) { return testing::play_class_tiles(p, false); }};
constexpr Case kClasses{"classes", [](auto& p) { return testing::play_class_tiles(p, true); },
                        &kNewClasses};
constexpr std::array kCases{kOnePart,
                            kFourParts,
                            kManyParts,
                            kManySlices,
                            kCircle,
                            kGradedCircle,
                            kOverBudget,
                            kShortSlices,
                            kClassesOverGround,
                            kRectangle,
                            kRectangleOverGround,
                            kTurns,
                            kTurnsOverGround,
                            kShuffled,
                            kFullFrames,
                            kBayes,
                            kTiles,
                            kClasses};

// By one core that nothing happens to: what the others are compared with.
const Played& alone(const Case& one) {
  static std::map<std::string, Played> all;
  const Case& its = one.like == nullptr ? one : *one.like;
  if (!all.contains(its.name)) {
    SharingPlatform platform(1, kAnyTimeUs);
    all.emplace(its.name, its.play(platform));
  }
  return all.at(its.name);
}

class Shared : public ::testing::TestWithParam<std::tuple<Case, std::size_t>> {};

TEST_P(Shared, ByCoresGivesWhatOneGives) {
  const auto& [one, cores] = GetParam();
  SharingPlatform platform(cores, kAnyTimeUs);
  EXPECT_TRUE(one.play(platform) == alone(one));
  EXPECT_GT(platform.items_of_helpers(), 0U);
}

INSTANTIATE_TEST_SUITE_P(TwoToFour, Shared,
                         ::testing::Combine(::testing::ValuesIn(kCases),
                                            ::testing::Values(2U, 3U, 4U)));

TEST(SharedByOne, CasesThatAreAlikeGiveTheSame) {
  for (const Case& one : {kShuffled, kClasses}) {
    SharingPlatform platform(1, kAnyTimeUs);
    EXPECT_TRUE(one.play(platform) == alone(one)) << one.name;
  }
}

struct Delay {
  Case one;
  std::size_t cores;
  std::uint32_t most_us;
};

TEST(SharedWithDelays, GivesWhatOneGives) {
  for (const auto& [one, cores, most_us] :
       {Delay{kFourParts, 4, 300}, Delay{kTurns, 4, 300}, Delay{kCircle, 2, 100},
        Delay{kCircle, 3, 100}, Delay{kCircle, 4, 100}}) {
    SharingPlatform platform(cores, kAnyTimeUs);
    platform.delay(most_us);
    EXPECT_TRUE(one.play(platform) == alone(one)) << one.name << cores;
  }
}

// The frames and ends of what was sent.
struct Said {
  stream::Header header;
  stream::FrameEnd end;
  std::optional<stream::ClassEnd> classes;
};
std::vector<Said> said_in(const Played& played) {
  std::vector<Said> frames(1);
  for (const auto& message : played.messages) {
    Said& frame = frames.back();
    std::span<const std::byte> body;
    const auto content = std::span(message).subspan(protection::kProtectionBytes);
    EXPECT_EQ(stream::read_header(content, frame.header, body), stream::ReadStatus::kOk);
    if (frame.header.type == stream::MessageType::kClassEnd) {
      EXPECT_EQ(stream::read_class_end(body, frame.classes.emplace()), stream::ReadStatus::kOk);
    } else if (frame.header.type == stream::MessageType::kFrameEnd) {
      EXPECT_EQ(stream::read_frame_end(body, frame.header.sensor_count, frame.end),
                stream::ReadStatus::kOk);
      frames.emplace_back();
    }
  }
  frames.pop_back();
  return frames;
}

TEST(SharedCases, WithClassesHaveWhatTheyAreFor) {
  for (const Case& one : {kOnePart, kFourParts, kManyParts, kManySlices}) {
    const std::vector<Said> frames = said_in(alone(one));
    ASSERT_GE(frames.size(), 5U);
    EXPECT_GT(frames[4].classes->tiles_sent, 10U);
  }
  EXPECT_FALSE(alone(kOverBudget) == alone(kCircle));
  EXPECT_GT(std::ranges::max(said_in(alone(kShortSlices)), {},
                             [](const Said& frame) { return frame.classes->slice_count; })
                .classes->slice_count,
            placing::FrameEvidence::kMostAtOnce);
  SharingPlatform level(1, kAnyTimeUs);
  EXPECT_FALSE(testing::play_parts_of_turns(level, tests::LevelVlp16::kVehicle) ==
               alone(kClassesOverGround));
  EXPECT_GT(level.messages.size(), 100U);
}

TEST(SharedCases, OfDenseLidarsHaveWhatTheyAreFor) {
  const std::vector<Said> turns = said_in(alone(kTurns));
  ASSERT_GE(turns.size(), 3U);
  EXPECT_EQ(turns[1].header.packets_fused, testing::kPacketsOfTurn);
  EXPECT_GT(alone(kTurns).messages.size(), 30U);
  const std::vector<Said> over_ground = said_in(alone(kTurnsOverGround));
  const auto count = [](const Said& frame, vehicle::Fate fate) {
    return frame.end.fates[static_cast<std::size_t>(fate)];
  };
  for (const vehicle::Fate fate :
       {vehicle::Fate::kGround, vehicle::Fate::kOverhang, vehicle::Fate::kUnderGround}) {
    EXPECT_GT(count(over_ground[1], fate), 0U);
    EXPECT_EQ(count(turns[1], fate), 0U);
  }
  EXPECT_EQ(count(over_ground[1], vehicle::Fate::kOutsideHeightBand), 0U);
  const std::vector<Said> full = said_in(alone(kFullFrames));
  EXPECT_GT(full.front().header.packets_fused * 384, fusion::kPartPlaces * 6'144);
  EXPECT_EQ(full.back().header.packets_dropped, 0U);
}

// 57,600 points of a turn, 6,144 a part: rounds of a part for each core while they come, one of
// what is left, one that joins; and those of encoding.
TEST(Shared, DenseFramesAreMostlyFusedBeforeTheyEnd) {
  vehicle::Vehicle car = tests::LevelVlp16::kVehicle;
  car.frame_period_us = 300'000;
  testing::Drive turn = testing::three_turns();
  turn.resize(testing::kPacketsOfTurn - 1);
  for (const std::size_t cores : {2U, 3U, 4U}) {
    SharingPlatform platform(cores, kAnyTimeUs);
    const auto pipeline =
        std::make_unique<Pipeline<SharingPlatform>>(car, testing::kReplayer, platform);
    pipeline->start(turn.front().now_us);
    for (const testing::TimedDatagram& datagram : turn) {
      testing::step(*pipeline, datagram);
    }
    EXPECT_EQ(platform.rounds, turn.size() * 384 / (cores * 6'144));
  }
}

// Evidence of both signs that is added one after the other does not join of parts: core 0 alone.
TEST(FusedTogether, AreFramesOfDenseLidarsByHitsWin) {
  EXPECT_TRUE(is_fused_together(tests::LevelVlp16::kVehicle));
  EXPECT_TRUE(is_fused_together(tests::MixedCar::kVehicle));
  EXPECT_FALSE(is_fused_together(tests::ThreeLux::kVehicle));
  vehicle::Vehicle bayes = tests::LevelVlp16::kVehicle;
  bayes.rule = vehicle::FusionRule::kBayes;
  EXPECT_FALSE(is_fused_together(bayes));
}

// While the rest is encoded.
TEST(Shared, PartOfTheClassesIsSentBeforeAllAreEncoded) {
  SharingPlatform platform(2, kAnyTimeUs);
  MessageSender<SharingPlatform> messages(platform);
  const auto sender = std::make_unique<TileSender<SharingPlatform, stream::ClassHash>>(
      platform, messages, Coding::kShortest);
  testing::MadeUpTiles tiles(3);
  sender->begin({}, stream::ClassWindow{});
  for (std::size_t i = 0; i < testing::MadeUpTiles::kCount; ++i) {
    tiles.change(i, 0, 71);
    sender->add_classes(i, tiles.at(i), 0, 1);
  }
  std::size_t before = 1;
  sender->encode_in_two([&] { before = platform.messages.size(); });
  const std::size_t between = platform.messages.size();
  static_cast<void>(sender->finish_encoded());
  EXPECT_EQ(before, 0U);
  EXPECT_GT(between, 4U);
  EXPECT_NEAR(static_cast<double>(platform.messages.size()), 2.0 * static_cast<double>(between),
              0.4 * static_cast<double>(between));
}

struct Mishap {
  Case one;
  Accident accident;
  std::size_t round;
};
void PrintTo(const Mishap& mishap, std::ostream* out) {
  *out << mishap.one.name << ", accident " << static_cast<int>(mishap.accident) << " in round "
       << mishap.round;
}

// With classes round 0 of the first frame with packets fuses, round 1 joins. Of three cores' first
// turn, rounds 0 to 2 fuse parts as they come, 3 what is left, 4 joins. Classes: in the first
// frame, and when much is known already.
std::vector<Mishap> mishaps() {
  std::vector<Mishap> all;
  for (const Accident accident : {Accident::kFaultBefore, Accident::kFaultAfter,
                                  Accident::kHangBefore, Accident::kHangAfter}) {
    const auto add = [&](const Case& one, std::initializer_list<std::size_t> rounds) {
      for (const std::size_t round : rounds) {
        all.push_back({one, accident, round});
      }
    };
    add(kFourParts, {0, 1});
    add(kTurns, {0, 1, 3, 4});
    add(kTurnsOverGround, {0, 1, 3, 4});
    add(kTiles, {0});
    if (accident == Accident::kFaultBefore || accident == Accident::kFaultAfter) {
      add(kClasses, {0, 9});
    }
  }
  return all;
}

class SharedDespite : public ::testing::TestWithParam<Mishap> {};

TEST_P(SharedDespite, TheLossOfACoreGivesWhatOneGives) {
  constexpr int kAttempts = 10;
  const auto& [one, accident, round] = GetParam();
  // On a busy PC, the victim may get no item of a short round, so that nothing happens to it.
  work::Loss fate = work::Loss::kNone;
  for (int attempt = 0; attempt < kAttempts && fate == work::Loss::kNone; ++attempt) {
    SharingPlatform platform(3, kShortlyUs);
    platform.let_happen(accident, round);
    EXPECT_TRUE(one.play(platform) == alone(one));
    fate = platform.fate_of_victim();
  }
  EXPECT_NE(fate, work::Loss::kNone);
}

INSTANTIATE_TEST_SUITE_P(Mishaps, SharedDespite, ::testing::ValuesIn(mishaps()));

// Tiles that are in the batch by then: none, one, some, nearly all of a batch.
TEST(SharedDespiteAll, ABatchThatLosesItsHelpersGivesWhatOneGives) {
  for (const int asked : {0, 1, 50, 191}) {
    SharingPlatform platform(1, kAnyTimeUs);
    platform.have_helpers_when_asked(asked);
    EXPECT_TRUE(kTiles.play(platform) == alone(kTiles)) << asked;
  }
}

// The rounds of the last frame on the circle but one, so that there is something to do it wrong to,
// and a frame in which it shows.
struct Rounds {
  std::size_t begin = 0;
  std::size_t end = 0;
};
Rounds rounds_of_a_frame() {
  static const Rounds rounds = [] {
    SharingPlatform platform(2, kAnyTimeUs);
    testing::ClassBench bench(platform, testing::car_on_circle({}));
    Rounds found;
    int frames = 0;
    for (const testing::TimedDatagram& datagram : testing::circle()) {
      const std::size_t before = platform.rounds;
      bench.pipeline->take({testing::kReplayer, datagram.port, datagram.bytes}, datagram.now_us);
      if (platform.rounds != before && ++frames == testing::kFramesOnCircle - 1) {
        found = {before, platform.rounds};
      }
    }
    return found;
  }();
  return rounds;
}

// Behind which part of a round's items it happens: ahead of the vehicle there is most to do, and
// where that is depends on how a round numbers its items.
constexpr std::array<std::size_t, 3> kPercents{8, 33, 58};
constexpr std::size_t kTries = tests::effort(kPercents.size(), 1);  // of a round

const Case& on_circle(std::size_t number) { return number % 2 == 0 ? kCircle : kGradedCircle; }

class SharedDespiteInAnyRound : public ::testing::TestWithParam<Accident> {};

TEST_P(SharedDespiteInAnyRound, TheLossOfACoreGivesWhatOneGives) {
  const Rounds rounds = rounds_of_a_frame();
  // Fuse, join; copy, note and place slices; find, update; look at hits; encode the indexes and
  // both parts of the classes; end tiles.
  ASSERT_EQ(rounds.end - rounds.begin, 12U);
  const bool hangs = GetParam() == Accident::kHangAfter;
  int lost = 0;
  for (std::size_t round = rounds.begin; round < rounds.end; round += hangs ? 3 : 1) {
    for (std::size_t i = 0; i < kTries; ++i) {
      SharingPlatform platform(2, hangs ? kShortlyUs : kAnyTimeUs);
      platform.let_happen(GetParam(), round, kPercents[(round + i) % kPercents.size()]);
      const Case& one = on_circle(round + i);
      ASSERT_TRUE(one.play(platform) == alone(one)) << round;
      lost += platform.fate_of_victim() != work::Loss::kNone ? 1 : 0;
    }
  }
  EXPECT_GT(lost, hangs ? tests::effort(3, 0) : tests::effort(15, 4));
}

INSTANTIATE_TEST_SUITE_P(Accidents, SharedDespiteInAnyRound,
                         ::testing::Values(Accident::kFaultBefore, Accident::kFaultAfter,
                                           Accident::kHangAfter));

// A core is ended by a store in the middle of an item, wherever a page of the pipeline begins.
TEST(SharedDespiteAll, ACoreLostInTheMiddleOfAnItemGivesWhatOneGives) {
  const Rounds rounds = rounds_of_a_frame();
  std::uint32_t redone = 0;
  int lost = 0;
  for (std::size_t round = rounds.begin; round < rounds.end; ++round) {
    for (int pages = 0; pages < tests::effort(20, 3); ++pages) {
      const bool is_graded = pages % 2 != 0;
      SharingPlatform platform(2, kAnyTimeUs);
      testing::ClassBench bench(platform, testing::car_on_circle(is_graded ? testing::kGradedRules
                                                                           : perception::Rules{}));
      tests::StoreTrap trap(bench.pipeline.get(), sizeof(testing::ClassBench::Classes));
      platform.let_happen(Accident::kNone, round, kPercents[round % kPercents.size()]);
      platform.let_trap(trap, pages);
      ASSERT_TRUE(bench.play(testing::circle()) == alone(is_graded ? kGradedCircle : kCircle))
          << round << " " << pages;
      lost += platform.fate_of_victim() == work::Loss::kFaulted ? 1 : 0;
      redone += platform.redone();
    }
  }
  EXPECT_GT(lost, tests::effort(60, 5));
  EXPECT_EQ(redone, static_cast<std::uint32_t>(lost));
}

}  // namespace
}  // namespace iog::app
