// The source of the poses, from datagrams to the poses of slices.
#include "pose/source.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

#include "fakes/random.hpp"
#include "pose/drive.hpp"

namespace iog::pose {
namespace {

using testing::kStartUs;
using testing::message_at;

constexpr std::uint64_t kMs = 1'000;
constexpr std::uint32_t kGateway = 0x0A000263;
constexpr std::uint32_t kPeer = 0x0A000202;

struct Bench {
  Fate send(const Message& message, std::uint32_t from = kGateway) {
    return source.receive(from, encoder.encode(message), message.clock_us);
  }
  void drive(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      send(message_at(kStartUs + i * 10 * kMs));
    }
  }
  Placed place(std::uint64_t time_us) { return source.place(source.slice_of(time_us)); }
  [[nodiscard]] std::uint32_t count(Fate fate) const {
    return source.fates().at(static_cast<std::size_t>(fate));
  }
  [[nodiscard]] std::uint32_t count(Cause cause) const {
    return source.slices().at(static_cast<std::size_t>(cause));
  }

  Source source{{.source_ipv4 = kGateway}, kPeer};
  Encoder encoder;
};

TEST(PoseSource, ListensToItsPortAndItsSenderOrTheReplayer) {
  Bench bench;
  EXPECT_TRUE(bench.source.listens_to(15'010));
  EXPECT_FALSE(bench.source.listens_to(15'011));
  EXPECT_EQ(bench.send(message_at(kStartUs)), Fate::kUnconfirmed);
  EXPECT_EQ(bench.send(message_at(kStartUs + 10 * kMs), kGateway + 1), Fate::kStranger);
  EXPECT_EQ(bench.send(message_at(kStartUs + 10 * kMs), 0), Fate::kStranger);
  EXPECT_EQ(bench.send(message_at(kStartUs + 10 * kMs), kPeer), Fate::kUnconfirmed);
  EXPECT_EQ(bench.send(message_at(kStartUs + 20 * kMs)), Fate::kUsed);
  EXPECT_EQ(bench.count(Fate::kStranger), 2U);
}

TEST(PoseSource, WithoutAnAddressEveryoneMaySendAndNobodyReplays) {
  Encoder encoder;
  Source anyone({});
  EXPECT_EQ(anyone.receive(kPeer, encoder.encode(message_at(kStartUs)), 1), Fate::kUnconfirmed);
  Source strict({.source_ipv4 = kGateway});
  EXPECT_EQ(strict.receive(0, encoder.encode(message_at(kStartUs)), 1), Fate::kStranger);
}

TEST(PoseSource, EveryDatagramHasOneFate) {
  Bench bench;
  bench.drive(10);
  tests::Random random(12);
  std::vector<std::byte> garbage(200);
  for (int i = 0; i < 500; ++i) {
    for (std::byte& byte : garbage) {
      byte = static_cast<std::byte>(random.next());
    }
    const Fate fate = bench.source.receive(
        kGateway, std::span(garbage).first(random.below(garbage.size() + 1)), 0);
    ASSERT_TRUE(fate == Fate::kTooShort || fate == Fate::kDamaged || fate == Fate::kNotOurs);
  }
  const auto& fates = bench.source.fates();
  EXPECT_EQ(std::accumulate(fates.begin(), fates.end(), 0U), 510U);
  EXPECT_EQ(bench.count(Fate::kUsed), 8U);
  EXPECT_EQ(bench.place(kStartUs).cause, Cause::kNone);
}

// 5000 ms is the beginning of slice 625, whose middle the car passes at x = 40 mm.
TEST(PoseSource, ASliceIsPlacedByThePoseOfItsMiddle) {
  Bench bench;
  bench.drive(10);
  for (std::uint64_t time_us = kStartUs; time_us < kStartUs + 8 * kMs; time_us += 799) {
    ASSERT_EQ(bench.place(time_us).pose, (Pose{40, 0, 0}));
  }
  EXPECT_EQ(bench.place(kStartUs + 8 * kMs).pose, (Pose{120, 0, 0}));
  EXPECT_EQ(bench.count(Cause::kNone), 12U);
}

TEST(PoseSource, EachCauseIsCountedFromWhenItBegan) {
  Bench bench;
  bench.drive(10);
  const std::uint64_t newest_us = kStartUs + 90 * kMs;
  EXPECT_EQ(bench.place(newest_us).cause, Cause::kNone);
  EXPECT_EQ(bench.place(newest_us + 200 * kMs).cause, Cause::kLate);
  EXPECT_EQ(bench.place(newest_us + 208 * kMs).cause, Cause::kLate);
  EXPECT_EQ(bench.place(newest_us).cause, Cause::kNone);
  EXPECT_EQ(bench.place(newest_us + 300 * kMs).cause, Cause::kLate);
  EXPECT_EQ(bench.count(Cause::kLate), 3U);
  EXPECT_EQ(bench.source.tally(Cause::kLate).times, 2U) << "two spells of three slices";
  EXPECT_EQ(bench.source.tally(Cause::kLate).since_us,
            bench.source.slice_of(newest_us + 300 * kMs).middle_us);
  bench.source.pass(newest_us + 1'100 * kMs);
  EXPECT_EQ(bench.place(newest_us).cause, Cause::kLost);
  EXPECT_EQ(bench.source.tally(Cause::kLost).times, 1U);
  EXPECT_EQ(bench.source.tally(Cause::kLost).since_us, newest_us);
  EXPECT_EQ(bench.source.epoch(), 1U);
}

// Slices that were not placed, and a cause that began again, each by itself: a break may pass
// before any slice asks, and a spell may go on for many slices.
TEST(CauseCounts, ACauseIsMetIfItBeganOrASliceFellToIt) {
  CauseCounts before;
  EXPECT_EQ(before.since(before), 0U);
  for (unsigned cause = 0; cause < kCauseCount; ++cause) {
    const auto bit = static_cast<std::uint8_t>(cause == 0 ? 0U : 1U << cause);  // kNone is none
    CauseCounts slice = before;
    ++slice.slices[cause];
    EXPECT_EQ(slice.since(before), bit);
    CauseCounts begun = before;
    ++begun.began[cause].times;
    EXPECT_EQ(begun.since(before), bit);
  }
}

TEST(PoseSource, APacketWithoutTheSourcesClockGetsItFromItsArrival) {
  Bench bench;
  EXPECT_EQ(bench.source.source_time(77), std::nullopt);
  bench.drive(10);
  EXPECT_EQ(bench.source.source_time(kStartUs + 3), kStartUs + 3);
  EXPECT_EQ(bench.source.newest(), message_at(kStartUs + 90 * kMs));
}

// What is never to happen: two slices of one epoch whose poses do not fit together.
class Campaign {
 public:
  explicit Campaign(std::uint64_t seed) : random_{seed} {}

  void run() {
    for (int step = 0; step < 3'000; ++step) {
      now_us_ += 10 * kMs;
      disturb();
      if (!is_silent()) {
        send();
      }
      bench_.source.pass(now_us_);
      ask();
    }
  }

  [[nodiscard]] const Source& source() const { return bench_.source; }
  [[nodiscard]] int placed() const { return placed_; }

 private:
  // The car drives round a circle of 60 m at 12 m/s; the source is off by what it has jumped.
  [[nodiscard]] Pose truth_at(std::uint64_t time_us) const {
    const double angle = 0.2 * static_cast<double>(time_us) / 1e6;
    const double turns = (angle / (2 * 3.14159265358979323846)) + 0.25;
    return {.x_mm = static_cast<std::int32_t>(std::llround(60'000 * std::cos(angle))),
            .y_mm = static_cast<std::int32_t>(std::llround(60'000 * std::sin(angle))),
            .heading = static_cast<std::uint32_t>(
                static_cast<std::int64_t>(std::floor(turns * 4'294'967'296.0)))};
  }

  void disturb() {
    if (random_.one_in(300)) {
      offset_x_mm_ += random_.between(350, 20'000) * (random_.one_in(2) ? 1 : -1);
    }
    if (random_.one_in(400)) {
      ++run_;
      offset_y_mm_ += random_.between(-90'000, 90'000);
    }
    if (random_.one_in(100)) {
      silent_until_us_ = now_us_ + random_.next() % (1'800 * kMs);
    }
  }

  [[nodiscard]] bool is_silent() const { return now_us_ < silent_until_us_; }

  void send() {
    Message message{.run = run_, .clock_us = now_us_, .pose = truth_at(now_us_), .sigma = {20, 20}};
    message.pose.x_mm += offset_x_mm_ + random_.between(-5, 5);
    message.pose.y_mm += offset_y_mm_ + random_.between(-5, 5);
    message.speed_mm_per_s = 12'000;
    message.yaw_urad_per_s = 200'000;
    message.sigma.position_mm = random_.one_in(20) ? 500 : 20;
    bench_.send(message);
    sent_.push_back(message);
    if (random_.one_in(10)) {  // an old one once more
      bench_.send(sent_.at(random_.below(sent_.size())));
    }
  }

  void ask() {
    const std::uint64_t time_us = now_us_ - random_.next() % (300 * kMs) + 60 * kMs;
    const Slice slice = bench_.source.slice_of(time_us);
    const Placed placed = bench_.source.place(slice);
    if (!placed.has_pose()) {
      return;
    }
    const Pose truth = truth_at(slice.middle_us);
    const std::int32_t off_x = placed.pose.x_mm - truth.x_mm;
    const std::int32_t off_y = placed.pose.y_mm - truth.y_mm;
    if (placed_ == 0 || bench_.source.epoch() != epoch_) {
      epoch_ = bench_.source.epoch();
      off_x_mm_ = off_x;
      off_y_mm_ = off_y;
    }
    ++placed_;
    ASSERT_LE(std::hypot(off_x - off_x_mm_, off_y - off_y_mm_), 300) << "epoch " << epoch_;
  }

  tests::Random random_;
  Bench bench_;
  std::vector<Message> sent_;
  std::uint64_t now_us_ = kStartUs;
  std::uint64_t silent_until_us_ = 0;
  std::uint32_t run_ = 1;
  std::int32_t offset_x_mm_ = 0;
  std::int32_t offset_y_mm_ = 0;
  int placed_ = 0;
  std::uint32_t epoch_ = 0;
  std::int32_t off_x_mm_ = 0;  // of the epoch's first pose
  std::int32_t off_y_mm_ = 0;
};

TEST(PoseSource, PosesOfOneEpochFitTogetherWhateverHappens) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Campaign campaign(seed);
    campaign.run();
    EXPECT_GT(campaign.placed(), 1'000);
    for (const Cause cause :
         {Cause::kLost, Cause::kJump, Cause::kRestart, Cause::kLate, Cause::kImprecise}) {
      EXPECT_GT(campaign.source().tally(cause).times, 0U) << static_cast<int>(cause);
    }
  }
}

}  // namespace
}  // namespace iog::pose
