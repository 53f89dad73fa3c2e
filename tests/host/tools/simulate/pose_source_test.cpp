// A simulated car's poses: true where no error is asked for, and wrong as stated where it is. What
// the target makes of them is asked of the target's own source of poses.
#include "tools/simulate/drives/pose_source.hpp"

#include <algorithm>
#include <cmath>

#include "gtest/gtest.h"

#include "pose/source.hpp"
#include "stream/crc32.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/simulate/scenes/scene_catalogue.hpp"

namespace iog::tools {
namespace {

constexpr double kSpeed = 10;
constexpr double kCurvature = 0.01;  // 1 / m

// Round and round on a circle of 100 m at 10 m/s.
Scene circle(double drive_s) {
  constexpr Course kCourse{.radians_per_metre = kCurvature, .swings = {{{0, 100}, {0, 100}}}};
  constexpr Cruise kCruise{
      .mean_speed = kSpeed, .speed_swing = 0, .swing_period = 10, .left = 0, .weave = 0};
  Landscape landscape;
  landscape.sort();
  return {Road(kCourse, 0, kSpeed * drive_s + 10), kCruise, std::move(landscape), {}};
}

double turned(double a, double b) { return std::remainder(a - b, 2 * std::acos(-1.0)); }

TEST(TruePose, IsThatOfACircle) {
  const Scene scene = circle(80);
  for (double time_s = 0; time_s < 80; time_s += 1.7) {
    const PoseSample pose = true_pose(scene, time_s);
    const double angle = kCurvature * kSpeed * time_s;
    EXPECT_NEAR(turned(pose.heading_rad, angle), 0, 1e-9);
    // The road is a polygon of half metres.
    EXPECT_NEAR(pose.x_m, std::sin(angle) / kCurvature, 2e-3);
    EXPECT_NEAR(pose.y_m, (1 - std::cos(angle)) / kCurvature, 2e-3);
    EXPECT_NEAR(pose.speed_mps, kSpeed, 1e-3);
    EXPECT_NEAR(pose.yaw_rate_rps, kCurvature * kSpeed, 1e-6);
  }
}

const PoseOptions kExact{.sigma_m = 0, .sigma_heading_rad = 0};

TEST(SimulatedPoses, WithoutErrorsAreTrue) {
  const Scene scene = find_scene("street").make(1, 20);
  for (const PoseSample& sample : simulated_poses(scene, kExact, 1, 20)) {
    const PoseSample truth =
        true_pose(scene, static_cast<double>(sample.time_us - kDriveStartUs) / 1e6);
    ASSERT_EQ(sample.x_m, truth.x_m);
    ASSERT_EQ(sample.y_m, truth.y_m);
    ASSERT_EQ(sample.heading_rad, truth.heading_rad);
    ASSERT_EQ(sample.speed_mps, truth.speed_mps);
  }
}

TEST(SimulatedPoses, SayWhereTheyAreOnAMapOnlyIfTold) {
  const pose::MapTransform map{
      .origin = 7, .local_frame = {1, -2, 3}, .sigma = {.position_mm = 4, .heading_10urad = 5}};
  PoseOptions options = kExact;
  PoseEncoder encoder;
  for (const PoseSample& sample : simulated_poses(circle(1), options, 1, 1)) {
    EXPECT_FALSE(pose::decode(encoder.datagram_of(sample).payload).message.map);
  }
  options.map = map;
  for (const PoseSample& sample : simulated_poses(circle(1), options, 1, 1)) {
    EXPECT_EQ(pose::decode(encoder.datagram_of(sample).payload).message.map, map);
  }
}

TEST(SimulatedPoses, ComeAtTheirRateAndALittleLate) {
  for (const double rate_hz : {10.0, 50.0, 100.0, 125.0}) {
    const auto samples = simulated_poses(circle(10), {.rate_hz = rate_hz}, 3, 10);
    ASSERT_EQ(samples.size(), static_cast<std::size_t>(10 * rate_hz) + 1);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      EXPECT_NEAR(static_cast<double>(samples[i].time_us - kDriveStartUs),
                  static_cast<double>(i) * 1e6 / rate_hz, 0.5);
      EXPECT_GE(samples[i].age_us, 2'000U);
      EXPECT_LT(samples[i].age_us, 3'000U);
    }
  }
}

struct Error {
  double x;
  double y;
  double heading;
};

std::vector<Error> errors_of(const Scene& scene, const std::vector<PoseSample>& samples) {
  std::vector<Error> errors;
  for (const PoseSample& sample : samples) {
    const PoseSample truth =
        true_pose(scene, static_cast<double>(sample.time_us - kDriveStartUs) / 1e6);
    errors.push_back({sample.x_m - truth.x_m, sample.y_m - truth.y_m,
                      turned(sample.heading_rad, truth.heading_rad)});
  }
  return errors;
}

// Root of the mean square of the error of the motion over so many samples.
double motion_error(const std::vector<Error>& errors, std::size_t apart, double Error::*part) {
  double squares = 0;
  for (std::size_t i = apart; i < errors.size(); ++i) {
    const double change = errors[i].*part - errors[i - apart].*part;
    squares += change * change;
  }
  return std::sqrt(squares / static_cast<double>(errors.size() - apart));
}

// Some 300 independent seconds for each of ten values: their mean is precise to 2 %.
TEST(SimulatedPoses, TheMotionOfASecondIsAsWrongAsStated) {
  constexpr double kSigma = 0.08;
  constexpr double kSigmaHeading = 0.003;
  const Scene scene = circle(600);
  double position = 0;
  double heading = 0;
  double step = 0;
  double late = 0;
  constexpr int kSeeds = 5;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto samples =
        simulated_poses(scene, {.sigma_m = kSigma, .sigma_heading_rad = kSigmaHeading}, seed, 600);
    EXPECT_EQ(samples.front().sigma_m, kSigma);
    EXPECT_EQ(samples.front().sigma_heading_rad, kSigmaHeading);
    const std::vector<Error> errors = errors_of(scene, samples);
    position += motion_error(errors, 100, &Error::x) / (2 * kSeeds);
    position += motion_error(errors, 100, &Error::y) / (2 * kSeeds);
    heading += motion_error(errors, 100, &Error::heading) / kSeeds;
    step += motion_error(errors, 1, &Error::x) / kSeeds;
    late += motion_error(errors, 20'000, &Error::x) / kSeeds;
  }
  EXPECT_NEAR(position, kSigma, 0.05 * kSigma);
  EXPECT_NEAR(heading, kSigmaHeading, 0.06 * kSigmaHeading);
  // Variances of the change over t seconds are as 1 - exp(-t).
  const double second = 1 - std::exp(-1.0);
  EXPECT_NEAR(step, kSigma * std::sqrt((1 - std::exp(-0.01)) / second), 0.01 * kSigma);
  // It does not add up: over 200 s it is hardly more than over one.
  EXPECT_NEAR(late, kSigma / std::sqrt(second), 0.15 * kSigma);
}

TEST(SimulatedPoses, AreMissingInAGapAlone) {
  const auto all = simulated_poses(circle(10), {}, 1, 10);
  const auto some = simulated_poses(circle(10), {.gaps = {{2.0, 0.5}, {6.0, 1.25}}}, 1, 10);
  EXPECT_EQ(some.size(), all.size() - 50 - 125);
  auto next = some.begin();
  for (const PoseSample& sample : all) {
    const std::uint64_t since_us = sample.time_us - kDriveStartUs;
    const bool is_missing = (since_us >= 2'000'000 && since_us < 2'500'000) ||
                            (since_us >= 6'000'000 && since_us < 7'250'000);
    if (!is_missing) {
      ASSERT_NE(next, some.end());
      EXPECT_EQ(next->time_us, sample.time_us);
      EXPECT_EQ(next->x_m, sample.x_m);  // a gap does not change the others
      ++next;
    }
  }
}

TEST(SimulatedPoses, JumpAsFarAndWhenStated) {
  const Scene scene = circle(10);
  const auto still = simulated_poses(scene, kExact, 1, 10);
  PoseOptions options = kExact;
  options.jumps = {{4.0, 0.5}};
  const auto jumping = simulated_poses(scene, options, 1, 10);
  ASSERT_EQ(still.size(), jumping.size());
  const double heading = kCurvature * kSpeed * 4;
  for (std::size_t i = 0; i < still.size(); ++i) {
    const double metres = i >= 400 ? 0.5 : 0;
    EXPECT_NEAR(jumping[i].x_m - still[i].x_m, -metres * std::sin(heading), 1e-9);
    EXPECT_NEAR(jumping[i].y_m - still[i].y_m, metres * std::cos(heading), 1e-9);
    EXPECT_EQ(jumping[i].heading_rad, still[i].heading_rad);
  }
}

// To the left by half of it a quarter of a period later, and to the right by as much half a period
// after that.
TEST(SimulatedPoses, SwingAsFarAsStated) {
  const Scene scene = circle(10);
  const auto still = simulated_poses(scene, kExact, 1, 10);
  PoseOptions options = kExact;
  options.swings = {{4.0, 0.28, 2.0}};
  const auto swinging = simulated_poses(scene, options, 1, 10);
  ASSERT_EQ(still.size(), swinging.size());
  const double heading = kCurvature * kSpeed * 4;
  const auto left_m = [&](std::size_t i) {
    return (swinging[i].y_m - still[i].y_m) * std::cos(heading) -
           (swinging[i].x_m - still[i].x_m) * std::sin(heading);
  };
  for (const auto& [at, expected] : {std::pair{200U, 0.0},
                                     {400U, 0.0},
                                     {450U, 0.14},
                                     {500U, 0.0},
                                     {550U, -0.14},
                                     {600U, 0.0},
                                     {650U, 0.14}}) {
    EXPECT_NEAR(left_m(at), expected, 1e-9) << at;
    EXPECT_EQ(swinging[at].speed_mps, still[at].speed_mps);
  }
}

std::vector<CapturedDatagram> datagrams_of(const PoseOptions& options, std::uint64_t seed = 1) {
  PoseFeed feed(simulated_poses(circle(10), options, seed, 10));
  return feed.take_until(kDriveStartUs + 20'000'000);
}

TEST(PoseFeed, SameSeedSameBytes) {
  const auto crc_of = [](std::uint64_t seed) {
    stream::Crc32 crc;
    for (const CapturedDatagram& datagram : datagrams_of({}, seed)) {
      crc.update(datagram.payload);
    }
    return crc.value();
  };
  EXPECT_EQ(crc_of(1), crc_of(1));
  EXPECT_NE(crc_of(1), crc_of(2));
}

TEST(PoseFeed, GivesWhatHasBeenSentUntilThenAndOnce) {
  PoseFeed feed(simulated_poses(circle(10), {}, 1, 1));
  EXPECT_TRUE(feed.take_until(kDriveStartUs + 1'999).empty());
  std::size_t count = 0;
  for (std::uint64_t time_us = kDriveStartUs; time_us < kDriveStartUs + 1'100'000;
       time_us += 7'000) {
    for (const CapturedDatagram& datagram : feed.take_until(time_us)) {
      EXPECT_LE(datagram.time_us, time_us);
      EXPECT_GT(datagram.time_us + 7'000, time_us);
      ++count;
    }
  }
  EXPECT_EQ(count, 101U);
}

// Runs the target's own source of poses on a drive's messages, and asks for the pose of each slice.
pose::Source target_after(const PoseOptions& options) {
  pose::Source source({.source_ipv4 = kPoseSourceIpv4});
  std::uint64_t asked_us = kDriveStartUs;
  for (const CapturedDatagram& datagram : datagrams_of(options)) {
    static_cast<void>(source.receive(datagram.source.ipv4, datagram.payload, datagram.time_us));
    source.pass(datagram.time_us);
    for (; asked_us + 16'000 < datagram.time_us; asked_us += 8'000) {
      static_cast<void>(source.place(source.slice_of(asked_us)));
    }
  }
  return source;
}

std::uint32_t fates(const pose::Source& source, pose::Fate fate) {
  return source.fates()[static_cast<std::size_t>(fate)];
}

TEST(PoseFeed, GoesToTheCarsPort) {
  PoseFeed feed(simulated_poses(circle(10), {}, 1, 1), 15'110);
  for (const CapturedDatagram& datagram : feed.take_until(kDriveStartUs + 100'000)) {
    EXPECT_EQ(datagram.destination.port, 15'110);
  }
}

TEST(PoseFeed, TheTargetUsesEveryMessage) {
  const pose::Source source = target_after({});
  EXPECT_EQ(fates(source, pose::Fate::kUsed) + fates(source, pose::Fate::kUnconfirmed), 1001U);
  EXPECT_LT(fates(source, pose::Fate::kUnconfirmed), 5U);
  EXPECT_EQ(source.tally(pose::Cause::kJump).times, 0U);
  EXPECT_EQ(source.tally(pose::Cause::kLost).times, 0U);
  EXPECT_EQ(source.tally(pose::Cause::kImprecise).times, 0U);
}

TEST(PoseFeed, TheTargetNoticesWhatIsWrong) {
  EXPECT_EQ(target_after({.gaps = {{3, 1.2}}}).tally(pose::Cause::kLost).times, 1U);
  EXPECT_EQ(target_after({.gaps = {{3, 0.9}}}).tally(pose::Cause::kLost).times, 0U);
  EXPECT_EQ(target_after({.jumps = {{5, 0.6}}}).tally(pose::Cause::kJump).times, 1U);
  EXPECT_EQ(target_after({.jumps = {{5, 0.1}}}).tally(pose::Cause::kJump).times, 0U);
  EXPECT_EQ(target_after({.restarts_s = {5}}).tally(pose::Cause::kRestart).times, 1U);
  EXPECT_GE(target_after({.sigma_m = 0.16}).tally(pose::Cause::kImprecise).times, 1U);
}

TEST(PoseEncoder, WritesTheNearestUnitAndASigmaUpwards) {
  const pose::Message message = message_of({.time_us = 42,
                                            .age_us = 7,
                                            .run = 3,
                                            .x_m = 1.2345,
                                            .y_m = -1.2344,
                                            .heading_rad = -std::acos(-1.0) / 2,
                                            .speed_mps = 8.7654,
                                            .yaw_rate_rps = -0.1234567,
                                            .sigma_m = 0.0201,
                                            .sigma_heading_rad = 0.001});
  EXPECT_EQ(message.clock_us, 42U);
  EXPECT_EQ(message.age_us, 7U);
  EXPECT_EQ(message.run, 3U);
  EXPECT_EQ(message.pose.x_mm, 1235);
  EXPECT_EQ(message.pose.y_mm, -1234);
  EXPECT_EQ(message.pose.heading, 0xC0000000U);
  EXPECT_EQ(message.speed_mm_per_s, 8765);
  EXPECT_EQ(message.yaw_urad_per_s, -123457);
  EXPECT_EQ(message.sigma.position_mm, 21);
  EXPECT_EQ(message.sigma.heading_10urad, 100);
  EXPECT_FALSE(message.map.has_value());
}

TEST(PoseEncoder, KeepsToTheLimitsOfItsFields) {
  EXPECT_EQ(message_of({.sigma_m = 0}).sigma.position_mm, 1);
  EXPECT_EQ(message_of({.sigma_m = 1e9}).sigma.position_mm, 0xFFFF);
  EXPECT_EQ(message_of({.sigma_m = std::nan("")}).sigma.position_mm, 0xFFFF);
  EXPECT_EQ(message_of({.heading_rad = 2 * std::acos(-1.0) - 1e-13}).pose.heading, 0U);
  for (const PoseSample& sample :
       {PoseSample{.x_m = 1'000'001}, PoseSample{.y_m = -1'000'001},
        PoseSample{.x_m = std::nan("")}, PoseSample{.heading_rad = std::nan("")},
        PoseSample{.speed_mps = 101}, PoseSample{.yaw_rate_rps = 11},
        PoseSample{.age_us = 200'001}}) {
    EXPECT_THROW(static_cast<void>(message_of(sample)), UsageError);
  }
}

}  // namespace
}  // namespace iog::tools
