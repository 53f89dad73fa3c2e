// From a recording of ROS to grids: scans of a room as a 2D scanner gives them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "../drive_sample.hpp"
#include "fakes/random.hpp"
#include "fakes/temporary_folder.hpp"
#include "lidar/points.hpp"
#include "tools/clouds/points_sender.hpp"
#include "tools/clouds/ros_clouds.hpp"
#include "tools/formats/mcap/writer.hpp"
#include "tools/formats/ros/bag_files.hpp"
#include "tools/formats/ros/cdr_writer.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

// Of a scan that no other one follows.
std::vector<CapturedDatagram> sent_alone(PointsSender& sender, SeenCloud&& cloud) {
  std::vector<CapturedDatagram> datagrams = sender.send(std::move(cloud));
  std::ranges::move(sender.finish(), std::back_inserter(datagrams));
  return datagrams;
}

constexpr std::uint32_t kScans = 8;
constexpr std::uint64_t kStartNs = 1'700'000'000'000'000'000;
constexpr std::uint64_t kPeriodNs = 25'000'000;

// A wall 6 m ahead of the scanner and nothing else; ranges vary by 1 cm.
std::vector<std::byte> scan_of_wall(std::uint64_t time_ns, const std::string& frame,
                                    tests::Random& random) {
  constexpr int kBeams = 1081;
  constexpr double kFirst = -135 * std::numbers::pi / 180;
  constexpr double kStep = 0.25 * std::numbers::pi / 180;
  ros::CdrWriter out;
  out.put(static_cast<std::uint32_t>(time_ns / 1'000'000'000));
  out.put(static_cast<std::uint32_t>(time_ns % 1'000'000'000));
  out.put(std::string_view(frame));
  for (const double value : {kFirst, -kFirst, kStep, 0.000'015, 0.025, 0.1, 20.0}) {
    out.put(static_cast<float>(value));
  }
  out.put(std::uint32_t{kBeams});
  for (int i = 0; i < kBeams; ++i) {
    const double angle = kFirst + i * kStep;
    const double range = 6 / std::cos(angle) + random.between(-10, 10) / 1000.0;
    out.put(std::abs(angle) < 1.2 ? static_cast<float>(range)
                                  : std::numeric_limits<float>::infinity());
  }
  out.put(std::uint32_t{0});
  return out.take();
}

struct Bag {
  std::vector<std::string> topics{"/scan"};
  std::vector<std::uint64_t> times_ns{};
  std::vector<std::string> frames{"laser"};  // in turn
};

void write(const Bag& bag, const std::string& path) {
  mcap::Writer writer(path, "ros2", mcap::Compression::kZstd);
  const std::uint16_t schema =
      writer.add_schema({.name = "sensor_msgs/msg/LaserScan", .encoding = "ros2msg", .text = ""});
  tests::Random random(1);
  for (const std::string& topic : bag.topics) {
    const std::uint16_t channel = writer.add_channel(
        {.schema_id = schema, .topic = topic, .message_encoding = "cdr", .metadata = {}});
    for (std::size_t i = 0; i < bag.times_ns.size(); ++i) {
      const std::uint64_t time_ns = bag.times_ns[i];
      writer.write(channel, {.log_ns = time_ns, .publish_ns = time_ns},
                   scan_of_wall(time_ns, bag.frames[i % bag.frames.size()], random));
    }
  }
  writer.finish("iog", {});
}

class PointsOfBag : public ::testing::Test {
 protected:
  PointsOfBag() {
    for (std::uint64_t i = 0; i < kScans; ++i) {
      bag_.times_ns.push_back(kStartNs + i * kPeriodNs);
    }
  }
  std::vector<CapturedDatagram> sent(const std::string& topic = {}) {
    write(bag_, path_);
    std::vector<CapturedDatagram> all;
    TimeUnit unit = TimeUnit::kFound;
    for_each_cloud(path_, topic, unit, [&](SeenCloud&& cloud) {
      std::ranges::move(sender_.send(std::move(cloud)), std::back_inserter(all));
    });
    std::ranges::move(sender_.finish(), std::back_inserter(all));
    return all;
  }
  std::string told(const std::string& topic = {}) {
    try {
      static_cast<void>(sent(topic));
    } catch (const UsageError& error) {
      const std::string words = error.what();
      return words.starts_with(path_) ? words.substr(path_.size()) : words;
    }
    return {};
  }

  tests::TemporaryFolder folder_;
  std::string path_ = folder_ / "bag.mcap";
  Bag bag_;
  PointsSender sender_{find_vehicle("robot_2d"), 0};
};

TEST_F(PointsOfBag, EachScanIsAFrameThatSeesTheWall) {
  const std::vector<CapturedDatagram> datagrams = sent();
  EXPECT_EQ(sender_.sent().clouds, kScans);
  EXPECT_EQ(sender_.sent().points, kScans * 1081U);
  EXPECT_EQ(sender_.sent().beyond_layers, 0U);
  EXPECT_EQ(datagrams.size(), kScans * 13U);  // of 85 points
  std::vector<GridFrame> frames;
  FrameAssembler assembler([&](GridFrame&& frame) { frames.push_back(std::move(frame)); });
  for (const auto& message : messages_of(find_vehicle("robot_2d"), datagrams)) {
    assembler.take(message);
  }
  assembler.finish();
  ASSERT_EQ(frames.size(), kScans);
  constexpr std::size_t kMiddle = geometry::kOriginCell;
  for (const GridFrame& frame : frames) {
    EXPECT_EQ(frame.header.packets_fused, 13U);
    // The wall is 6.2 m ahead of the car's origin, of cells of 5 cm; what lies before it is free.
    for (std::size_t y = kMiddle - 40; y < kMiddle + 40; ++y) {
      const auto row = frame.grid().subspan(y * geometry::kCellsPerSide + kMiddle);
      EXPECT_GT(std::max({row[123], row[124]}), 0) << y;
      EXPECT_LT(row[100], 0) << y;
      EXPECT_EQ(row[140], 0) << y;
    }
  }
}

TEST_F(PointsOfBag, OneWithoutAnEndingIsKnownByItsFirstBytes) {
  path_ = folder_ / "recording";
  EXPECT_FALSE(ros::is_recording(path_));
  static_cast<void>(sent());
  EXPECT_TRUE(ros::is_recording(path_));
  EXPECT_EQ(sender_.sent().clouds, kScans);
}

TEST_F(PointsOfBag, ATopicIsChosenIfSeveralHaveScans) {
  bag_.topics = {"/front", "/rear"};
  EXPECT_EQ(told(), ": /front and /rear have clouds: choose one by --topic");
  sender_ = PointsSender(find_vehicle("robot_2d"), 0);
  EXPECT_EQ(sent("/rear").size(), kScans * 13U);
}

TEST_F(PointsOfBag, ATopicThatIsNotThereIsToldWithThoseThatAre) {
  bag_.times_ns.resize(1);
  bag_.topics = {"/a", "/b"};
  const std::string words =
      ": it has no clouds and no scans of sensor_msgs, foxglove or livox_ros_driver on /scam; its "
      "topics of these types are ";
  const auto all_to = [](char last) {
    std::string list;
    for (char name = 'a'; name <= last; ++name) {
      list += std::string(name == 'a' ? "/" : ", /") + name + " (sensor_msgs/msg/LaserScan)";
    }
    return list;
  };
  EXPECT_EQ(told("/scam"), words + all_to('b'));
  for (const char* const topic : {"/c", "/d", "/e", "/f", "/g", "/h"}) {
    bag_.topics.emplace_back(topic);
  }
  EXPECT_EQ(told("/scam"), words + all_to('f') + ", ...");
}

TEST_F(PointsOfBag, TwoLidarsOnOneTopicAreTold) {
  bag_.frames = {"front", "rear"};
  EXPECT_EQ(told(),
            "cloud 1 is in frame rear, the one before in front: all clouds of a sensor are in one "
            "frame, so record each lidar on a topic of its own");
}

// A driver that left the name out in one message says nothing of a second lidar.
TEST_F(PointsOfBag, AFrameWithoutANameIsNoOther) {
  bag_.frames = {"front", ""};
  EXPECT_EQ(told(), "");
}

TEST_F(PointsOfBag, ACloudOutOfOrderIsSkipped) {
  bag_.times_ns[3] = bag_.times_ns[1];
  EXPECT_EQ(sent().size(), (kScans - 1) * 13U);
  EXPECT_EQ(sender_.sent().clouds, kScans - 1);
  EXPECT_EQ(sender_.sent().out_of_order, 1U);
  EXPECT_NO_THROW(sender_.demand_order());
}

// Half of them are borne; of times that fall all but the first are out of order.
TEST_F(PointsOfBag, CloudsMostOfWhichAreOutOfOrderAreTold) {
  for (std::size_t i = 4; i < kScans; ++i) {
    bag_.times_ns[i] = bag_.times_ns[0];
  }
  EXPECT_EQ(told(), "");
  EXPECT_EQ(sender_.sent().out_of_order, 4U);
  EXPECT_NO_THROW(sender_.demand_order());
  sender_ = PointsSender(find_vehicle("robot_2d"), 0);
  bag_.times_ns = {kStartNs + 2 * kPeriodNs, kStartNs + kPeriodNs, kStartNs};
  EXPECT_EQ(told(), "");
  try {
    sender_.demand_order();
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_STREQ(
        error.what(),
        "2 of 3 clouds are out of order (times go back by up to 50 ms): give files in order "
        "of time, and recordings sorted by header.stamp");
  }
}

TEST_F(PointsOfBag, OneWithoutCloudsIsTold) {
  bag_.topics.clear();
  EXPECT_EQ(told(), ": it has no clouds and no scans of sensor_msgs, foxglove or livox_ros_driver");
}

TEST(PointsSender, MorePointsThanTheCarTakesAreTold) {
  PointsSender sender(find_vehicle("robot_2d"), 0);
  try {
    static_cast<void>(sender.send({.points = std::vector<WirePoint>(1'501)}));
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "cloud 0 has 1501 points, and max_points_per_scan of front is 1500");
  }
}

// In millimetres, or with bytes in another order; what is far away would be free all around.
TEST(PointsSender, CoordinatesThatAreNoMetresAreTold) {
  PointsSender sender(find_vehicle("robot_2d"), 0);
  SeenCloud cloud{.points = std::vector<WirePoint>(3, {.third = 500'001})};
  cloud.points.insert(cloud.points.end(), 3, {.third = 500'000});
  SeenCloud half = cloud;
  EXPECT_NO_THROW(static_cast<void>(sender.send(std::move(half))));
  cloud.points.pop_back();
  try {
    static_cast<void>(sender.send(std::move(cloud)));
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(),
                 "cloud 1: 3 of its 5 points are more than 500 m away; coordinates are metres");
  }
}

// It is the one of the recording, whatever became of those before it.
TEST(PointsSender, ErrorsNumberTheCloudsThatWereGiven) {
  PointsSender sender(find_vehicle("robot_2d"), 0);
  for (const std::uint64_t time_us : {100'000U, 50'000U, 3'600'000'000U, 150'000U}) {
    static_cast<void>(sender.send({.frame = "front", .time_us = time_us}));
  }
  EXPECT_EQ(sender.sent().clouds, 2U);
  EXPECT_EQ(sender.sent().out_of_order, 1U);
  EXPECT_EQ(sender.sent().strays, 1U);
  EXPECT_EQ(sender.sent().given, 4U);
  const auto told = [&](SeenCloud&& cloud) {
    try {
      static_cast<void>(sender.send(std::move(cloud)));
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(told({.points = std::vector<WirePoint>(1'501)}),
            "cloud 4 has 1501 points, and max_points_per_scan of front is 1500");
  EXPECT_EQ(told({.points = {{.third = 500'001}}}),
            "cloud 4: 1 of its 1 points are more than 500 m away; coordinates are metres");
  EXPECT_TRUE(told({.frame = "rear"}).starts_with("cloud 4 is in frame rear, "));
}

TEST(PointsSender, StampsThatDoNotRiseAreCounted) {
  PointsSender sender(find_vehicle("robot_2d"), 0);
  for (const std::uint64_t time_us : {0U, 0U, 7U, 7U, 8U}) {
    static_cast<void>(sender.send({.time_us = time_us}));
  }
  static_cast<void>(sender.finish());
  EXPECT_EQ(sender.sent().without_stamp, 2U);
  EXPECT_EQ(sender.sent().same_stamps, 1U);
}

// robot_2d sees 270 degrees, symmetric about x.
TEST(PointsSender, PointsOutsideTheFieldOfViewAreCountedAndNotSent) {
  PointsSender sender(find_vehicle("robot_2d"), 0);
  SeenCloud cloud;
  for (const int degrees : {0, 134, 135, 136, 180, 224, 225, 226, 359}) {
    cloud.points.push_back({.first = degrees * 3'200, .third = 1});
  }
  static_cast<void>(sent_alone(sender, std::move(cloud)));
  EXPECT_EQ(sender.sent().beyond_width, 3U);
  EXPECT_EQ(sender.sent().points, 6U);
}

// A point outside of it would have its whole datagram dropped, and in no order most have one.
TEST(PointsSender, PointsOutsideTheFieldOfViewCostNoOthers) {
  PointsSender sender(find_vehicle("roof_points"), 0);
  SeenCloud cloud{.time_us = 5, .has_times = true};
  tests::Random random(1);
  std::size_t inside = 0;
  for (std::uint32_t i = 0; i < 8'000; ++i) {
    const int azimuth = random.between(-36 * 3'200, 36 * 3'200);
    inside += std::abs(azimuth) <= 35 * 3'200 ? 1U : 0U;
    cloud.points.push_back(
        {.first = (azimuth + 360 * 3'200) % (360 * 3'200), .third = 1, .after_us = i});
  }
  const auto datagrams = sent_alone(sender, std::move(cloud));
  EXPECT_EQ(datagrams.size(), (inside + 84) / 85);
  std::size_t decoded = 0;
  for (const auto& datagram : datagrams) {
    lidar::Points decoder;
    ASSERT_EQ(
        decoder.decode(datagram.payload, find_vehicle("roof_points").vehicle->sensors[0].unit()),
        lidar::DecodeStatus::kOk);
    decoder.for_each_point([&](const lidar::ScanPoint&) { ++decoded; });
  }
  EXPECT_EQ(decoded, inside);
  EXPECT_EQ(sender.sent().points, inside);
  EXPECT_EQ(sender.sent().beyond_width, 8'000 - inside);
}

// What is not sent needs no room on the target.
TEST(PointsSender, PointsOutsideTheFieldOfViewDoNotCountAgainstTheMost) {
  PointsSender sender(find_vehicle("robot_2d"), 0);
  SeenCloud cloud{.points = std::vector<WirePoint>(1'500, {.third = 1})};
  cloud.points.push_back({.first = 180 * 3'200, .third = 1});
  EXPECT_NO_THROW(static_cast<void>(sender.send(std::move(cloud))));
}

// In the order of their times if they have any; of what turns else by azimuth.
TEST(PointsSender, SortsByTime) {
  PointsSender sender(find_vehicle("roof_points"), 0);
  SeenCloud cloud{.time_us = 5, .has_times = true};
  cloud.points = {{.first = 1, .third = 1, .after_us = 30'000}, {.first = 2, .third = 2}};
  const auto datagrams = sent_alone(sender, std::move(cloud));
  ASSERT_EQ(datagrams.size(), 1U);
  EXPECT_EQ(datagrams[0].time_us, 30'005U);
  lidar::Points decoder;
  ASSERT_EQ(
      decoder.decode(datagrams[0].payload, find_vehicle("roof_points").vehicle->sensors[0].unit()),
      lidar::DecodeStatus::kOk);
  EXPECT_EQ(decoder.info().sweep.end_us - decoder.info().sweep.begin_us, 30'000U);
  EXPECT_EQ(decoder.info().sector.width_ticks, 2'240);
  std::vector<std::uint32_t> ranges;
  decoder.for_each_point([&](const lidar::ScanPoint& point) { ranges.push_back(point.range_mm); });
  EXPECT_EQ(ranges, (std::vector<std::uint32_t>{2, 1}));
}

// Ten lost datagrams of a hundred are no hole of 7 degrees at a place that was seen.
TEST(PointsSender, LostDatagramsOfNoOrderThinOutAllDirections) {
  constexpr std::int32_t kWidth = 70 * 3'200;
  const vehicle::Sensor& sensor = find_vehicle("roof_points").vehicle->sensors[0];
  PointsSender sender(find_vehicle("roof_points"), 0);
  SeenCloud cloud{.time_us = 5, .has_times = true};
  for (int i = 0; i < 8'500; ++i) {
    const int azimuth = i * 7'919 % kWidth - kWidth / 2;
    cloud.points.push_back({.first = azimuth < 0 ? azimuth + 360 * 3'200 : azimuth,
                            .third = 1,
                            .after_us = static_cast<std::uint32_t>(i)});
  }
  auto datagrams = sent_alone(sender, std::move(cloud));
  ASSERT_EQ(datagrams.size(), 100U);
  datagrams.erase(datagrams.begin() + 3, datagrams.begin() + 13);
  std::array<std::uint32_t, 10> ticks{};  // of each 7 degrees that were swept, from the right
  for (const auto& datagram : datagrams) {
    lidar::Points decoder;
    ASSERT_EQ(decoder.decode(datagram.payload, sensor.unit()), lidar::DecodeStatus::kOk);
    const lidar::Sector sector = decoder.info().sector;
    for (std::uint32_t i = 0; i < sector.width_ticks; ++i) {
      ++ticks.at((sector.first_ticks + i + 35 * 32) % 11'520 / (7 * 32));
    }
  }
  for (const std::uint32_t swept : ticks) {
    EXPECT_GT(swept, 7U * 32 * 3 / 4);
  }
}

}  // namespace
}  // namespace iog::tools
