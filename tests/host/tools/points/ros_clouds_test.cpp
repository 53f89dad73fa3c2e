// Messages of ROS that are written here byte by byte; and what is told of wrong ones.
#include "tools/clouds/ros_clouds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "cloud_bytes.hpp"
#include "tools/clouds/foxglove_clouds.hpp"
#include "tools/formats/ros/cdr_writer.hpp"

namespace iog::tools {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

struct SentField {
  std::string name;
  std::uint32_t offset;
  std::uint8_t type;
};

struct SentCloud {
  std::uint32_t stamp_s = 1'700'000'000;
  std::vector<SentField> fields{{"x", 0, 7}, {"y", 4, 7}, {"z", 8, 7}};
  std::uint32_t stride = 12;
  std::uint32_t count = 2;
  std::uint32_t rows = 1;
  std::uint32_t row_bytes = 0;  // 0: those of its points
  std::uint8_t is_big_endian = 0;
  Bytes points{};

  [[nodiscard]] Bytes message() const {
    ros::CdrWriter out;
    out.put(stamp_s);
    out.put(std::uint32_t{stamp_s == 0 ? 0U : 500'000'000U});
    out.put(std::string_view("lidar"));
    out.put(rows);
    out.put(count / rows);
    out.put(static_cast<std::uint32_t>(fields.size()));
    for (const SentField& field : fields) {
      out.put(std::string_view(field.name));
      out.put(field.offset);
      out.put(field.type);
      out.put(std::uint32_t{1});
    }
    out.put(is_big_endian);
    out.put(stride);
    out.put(row_bytes == 0 ? stride * count / rows : row_bytes);
    out.put(std::span<const std::byte>(points));
    out.put(std::uint8_t{1});
    return out.take();
  }
};

Bytes two_points(const std::function<void(Bytes&, int)>& behind = {}) {
  Bytes bytes;
  for (int i = 0; i < 2; ++i) {
    add(bytes, i == 0 ? 0.F : 1.F);
    add(bytes, i == 0 ? 10.F : 0.F);
    add(bytes, i == 0 ? 0.F : 1.F);
    if (behind) {
      behind(bytes, i);
    }
  }
  return bytes;
}

SeenCloud cloud_of(const SentCloud& sent, TimeUnit unit = TimeUnit::kFound) {
  return cloud_of_point_cloud2(sent.message(), unit, "it");
}

TEST(RosClouds, ReadPointCloud2ByTheNamesOfItsFields) {
  const SeenCloud cloud = cloud_of({.points = two_points()});
  expect_two(cloud);
  EXPECT_EQ(cloud.time_us, 1'700'000'000'500'000U);
  EXPECT_FALSE(cloud.has_times);
}

TEST(RosClouds, ReadPointsOfEitherByteOrder) {
  SentCloud sent{.points = two_points()};
  for (auto number = sent.points.begin(); number != sent.points.end(); number += 4) {
    std::reverse(number, number + 4);
  }
  sent.is_big_endian = 1;
  expect_two(cloud_of(sent));
}

// sensor_msgs/PointCloud2 has a row_step of its own.
TEST(RosClouds, ReadRowsWithBytesBehindTheirPoints) {
  SentCloud sent{.rows = 2, .row_bytes = 16, .points = two_points()};
  sent.points.insert(sent.points.begin() + 12, 4, std::byte{0xFF});
  expect_two(cloud_of(sent));
  sent.points.resize(32);
  expect_two(cloud_of(sent));
  sent.points.resize(20);
  EXPECT_EQ(told_by([&] { static_cast<void>(cloud_of(sent)); }),
            "it: its 2 points of 12 bytes do not fill its 20 bytes");
}

// As drivers of Ouster, Velodyne, Hesai and RoboSense send them.
TEST(RosClouds, FindTheUnitOfTimes) {
  const auto with = [](const std::string& name, std::uint8_t type,
                       const std::function<void(Bytes&, int)>& behind, std::uint32_t bytes) {
    SentCloud sent{.stride = 12 + bytes, .points = two_points(behind)};
    sent.fields.push_back({name, 12, type});
    return cloud_of(sent);
  };
  const auto expect_later = [](const SeenCloud& cloud, std::int64_t first_us) {
    ASSERT_TRUE(cloud.has_times);
    EXPECT_EQ(cloud.points[0].after_us, 0U);
    EXPECT_NEAR(cloud.points[1].after_us, 50'000, 1);
    EXPECT_NEAR(static_cast<double>(cloud.time_us),
                1'700'000'000'500'000.0 + static_cast<double>(first_us), 1);
  };
  expect_later(with(
                   "t", 6, [](Bytes& b, int i) { add(b, i == 0 ? 0 : 50'000'000, 4); }, 4),
               0);
  expect_later(with(
                   "time", 7, [](Bytes& b, int i) { add(b, i == 0 ? -0.1F : -0.05F); }, 4),
               -100'000);
  expect_later(with(
                   "timestamp", 8, [](Bytes& b, int i) { add(b, 1'700'000'000.6 + 0.05 * i); }, 8),
               100'000);
  expect_later(with(
                   "timestamp", 8, [](Bytes& b, int i) { add(b, 5'000.0 + 0.05 * i); }, 8),
               0);
}

// A driver may leave the stamp at 0.
TEST(RosClouds, TimesSince1970StandForAStampOfZero) {
  SentCloud sent{.stride = 20,
                 .points = two_points([](Bytes& b, int i) { add(b, 1'700'000'000.6 + 0.05 * i); })};
  sent.fields.push_back({"timestamp", 12, 8});
  sent.stamp_s = 0;
  const SeenCloud cloud = cloud_of(sent);
  EXPECT_NEAR(static_cast<double>(cloud.time_us), 1'700'000'000'600'000.0, 1);
  EXPECT_NEAR(cloud.points[1].after_us, 50'000, 1);
  EXPECT_EQ(cloud.apart_us, 0);
}

// `count` points, evenly over `span`, in a field t of unsigned 32-bit integers.
SentCloud timed(std::uint32_t count, std::uint32_t span) {
  SentCloud sent{.stride = 16, .count = count};
  sent.fields.push_back({"t", 12, 6});
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const float metres : {10.F, 0.F, 0.F}) {
      add(sent.points, metres);
    }
    add(sent.points, std::uint64_t{span} * i / (count - 1), 4);
  }
  return sent;
}

SeenCloud next_of(const SentCloud& sent, TimeUnit& unit) {
  return cloud_of_point_cloud2(sent.message(), unit, "it");
}

// 20 us in nanoseconds would be a scan of 20 ms in microseconds.
TEST(RosClouds, AFullCloudSaysTheUnitForAllThatFollow) {
  TimeUnit unit = TimeUnit::kFound;
  EXPECT_EQ(next_of(timed(100, 100'000'000), unit).points.back().after_us, 100'000U);
  EXPECT_EQ(unit, TimeUnit::kNanoseconds);
  EXPECT_EQ(next_of(timed(10, 20'000), unit).points.back().after_us, 20U);
  EXPECT_EQ(next_of(timed(20, 1'900'000), unit).points.back().after_us, 1'900U);
  TimeUnit other = TimeUnit::kFound;
  EXPECT_EQ(next_of(timed(100, 50'000), other).points.back().after_us, 50'000U);
  EXPECT_EQ(other, TimeUnit::kMicroseconds);
}

TEST(RosClouds, ANearlyEmptyCloudSaysNoUnit) {
  for (const std::uint32_t span : {20'000U, 1'900'000U, 700U}) {
    TimeUnit unit = TimeUnit::kFound;
    const SeenCloud cloud = next_of(timed(10, span), unit);
    EXPECT_EQ(unit, TimeUnit::kFound);
    EXPECT_TRUE(cloud.has_unknown_times);
    EXPECT_FALSE(cloud.has_times);
    EXPECT_EQ(cloud.points.back().after_us, 0U);
  }
  TimeUnit unit = TimeUnit::kFound;
  EXPECT_TRUE(next_of(timed(100, 700), unit).has_unknown_times);
}

TEST(RosClouds, TellWhatIsWrongWithPointCloud2) {
  const auto told = [](auto&& change) {
    SentCloud sent{.points = two_points()};
    change(sent);
    return told_by([&] { static_cast<void>(cloud_of(sent)); });
  };
  EXPECT_EQ(told([](SentCloud& /*sent*/) {}), "");
  EXPECT_EQ(told([](SentCloud& s) { s.fields[0].name = "X"; }), "it: its points have no field x");
  EXPECT_EQ(told([](SentCloud& s) { s.fields[1].type = 9; }), "it: field y has an unknown type, 9");
  EXPECT_EQ(told([](SentCloud& s) { s.count = 3; }),
            "it: its 3 points of 12 bytes do not fill its 24 bytes");
  EXPECT_EQ(told([](SentCloud& s) { s.count = 1; }),
            "it: its 1 point of 12 bytes does not fill its 24 bytes");
  for (const std::uint32_t stride : {0U, 4U}) {
    EXPECT_EQ(told([=](SentCloud& s) { s.stride = stride; }),
              "it: field " + std::string(stride == 0 ? "x" : "y") + " ends at byte " +
                  std::to_string(stride + 4) + " of a point, which has " + std::to_string(stride));
  }
  EXPECT_EQ(told([](SentCloud& s) {
              s.fields.resize(65, {"i", 0, 7});
            }),
            "it: its points have more than 64 fields");
  EXPECT_EQ(told([](SentCloud& s) { s.count = 10'000'000; }),
            "it: 10000000 points; no unit sees more than 1000000 in a scan");
  EXPECT_EQ(told([](SentCloud& s) { s.fields[2].offset = 0xFFFF'FFFF; }),
            "it: field z ends at byte 4294967299 of a point, which has 12");
  TimeUnit unit = TimeUnit::kFound;
  Bytes message = SentCloud{.points = two_points()}.message();
  for (std::size_t size = 4; size < message.size() - 1; ++size) {
    EXPECT_EQ(
        told_by([&] {
          static_cast<void>(cloud_of_point_cloud2(std::span(message).first(size), unit, "it"));
        }),
        "it: the message is cut off");
  }
  message[1] = std::byte{0};
  EXPECT_EQ(told_by([&] { static_cast<void>(cloud_of_point_cloud2(message, unit, "it")); }),
            "it: the message is not in CDR, little endian");
}

// foxglove.PointCloud in Protocol Buffers: x and y in floats, two points of so many bytes.
Bytes foxglove_cloud(std::uint8_t stride) {
  Bytes message;
  const auto put = [&](std::initializer_list<int> bytes) {
    std::ranges::for_each(bytes,
                          [&](int byte) { add(message, static_cast<std::uint64_t>(byte), 1); });
  };
  put({0x25, stride, 0, 0, 0});
  put({0x2A, 10, 0x0A, 1, 'x', 0x15, 0, 0, 0, 0, 0x18, 7});
  put({0x2A, 10, 0x0A, 1, 'y', 0x15, 4, 0, 0, 0, 0x18, 7});
  put({0x32, 16});
  for (const float metres : {10.F, 0.F, 0.F, 10.F}) {
    add(message, metres);
  }
  return message;
}

TEST(FoxgloveClouds, PointsFillTheirBytes) {
  TimeUnit unit = TimeUnit::kFound;
  const auto read = [&](std::uint8_t stride) {
    return cloud_of_foxglove(foxglove_cloud(stride), false, unit, "it");
  };
  EXPECT_EQ(read(8).points.size(), 2U);
  EXPECT_EQ(told_by([&] { static_cast<void>(read(0)); }),
            "it: field x ends at byte 4 of a point, which has 0");
  EXPECT_EQ(told_by([&] { static_cast<void>(read(7)); }),
            "it: field y ends at byte 8 of a point, which has 7");
  EXPECT_EQ(told_by([&] { static_cast<void>(read(9)); }),
            "it: its 1 point of 9 bytes does not fill its 16 bytes");
}

// Packed ranges without a byte are no range.
TEST(FoxgloveClouds, AnEmptyScanHasNoBeam) {
  const Bytes message{std::byte{0x32}, std::byte{0}};
  const SeenCloud cloud = scan_of_foxglove(message, false, "it");
  EXPECT_EQ(cloud.nowhere + cloud.points.size(), 0U);
}

// CustomMsg of livox_ros_driver2, two points of 20 bytes, of which the last lacks its last one.
TEST(RosClouds, PointsOfALivoxFillTheirBytes) {
  const auto told = [](std::size_t bytes) {
    ros::CdrWriter out;
    out.put(std::uint32_t{1'700'000'000});
    out.put(std::uint32_t{0});
    out.put(std::string_view("livox"));
    out.put(0.0);  // timebase
    out.put(std::uint32_t{2});
    out.put(std::uint32_t{0});  // lidar_id, rsvd
    out.put(std::uint32_t{2});
    Bytes message = out.take();
    message.resize(message.size() + bytes);
    return told_by([&] { static_cast<void>(cloud_of_livox(message, "it")); });
  };
  EXPECT_EQ(told(38), "it: its 2 points of 20 bytes do not fill its 38 bytes");
  EXPECT_EQ(told(39), "");
  EXPECT_EQ(told(40), "");
  EXPECT_EQ(told(60), "it: its 2 points of 20 bytes do not fill its 60 bytes");
}

// angle_min, angle_max, angle_increment, time_increment, scan_time, range_min and range_max.
using LaserHead = std::array<float, 7>;
constexpr LaserHead kLaserHead{-0.2F, 0.2F, 0.1F, 0.001F, 0.025F, 0.1F, 20.F};

Bytes laser_scan(const std::vector<float>& ranges, const LaserHead& head = kLaserHead) {
  ros::CdrWriter out;
  out.put(std::uint32_t{1'700'000'000});
  out.put(std::uint32_t{0});
  out.put(std::string_view("laser"));
  for (const float value : head) {
    out.put(value);
  }
  out.put(static_cast<std::uint32_t>(ranges.size()));
  for (const float range : ranges) {
    out.put(range);
  }
  out.put(std::uint32_t{0});
  return out.take();
}

// REP 117: infinite is nothing; NaN is an error.
TEST(RosClouds, ReadLaserScan) {
  const SeenCloud cloud = cloud_of_laser_scan(laser_scan({5, kInfinite, kNan, 0.05F, 21}), "it");
  ASSERT_EQ(cloud.points.size(), 3U);
  EXPECT_EQ(cloud.not_finite, 1U);
  EXPECT_EQ(cloud.nowhere, 1U);
  const auto parts = [](double radians) {
    return std::lround(radians * 180 / 3.14159265358979 * 3'200);
  };
  EXPECT_EQ(cloud.points[0].first, 1'152'000 + parts(-0.2));
  EXPECT_EQ(cloud.points[0].third, 5'000);
  EXPECT_EQ(cloud.points[0].flags, 0);
  EXPECT_EQ(cloud.points[1].first, 1'152'000 + parts(-0.1));
  EXPECT_EQ(cloud.points[1].flags, 4);
  EXPECT_EQ(cloud.points[1].after_us, 1'000U);
  EXPECT_EQ(cloud.points[2].first, parts(0.2));
  EXPECT_EQ(cloud.points[2].flags, 4);
  EXPECT_EQ(cloud.points[2].after_us, 4'000U);
}

// Simulators and drivers also give range_max for nothing; what is sent is rounded to millimetres.
TEST(RosClouds, ABeamAtRangeMaxHasNoReturn) {
  const SeenCloud cloud =
      cloud_of_laser_scan(laser_scan({19.999F, 20, 20.0003F, 19.9997F, 20.1F}), "it");
  ASSERT_EQ(cloud.points.size(), 5U);
  EXPECT_EQ(cloud.points[0].third, 19'999);
  EXPECT_EQ(cloud.points[0].flags, 0);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_EQ(cloud.points[i].third, 0) << i;
    EXPECT_EQ(cloud.points[i].flags, 4) << i;
  }
  EXPECT_EQ(cloud.at_range_max, 3U);
  EXPECT_EQ(cloud.nowhere + cloud.not_finite, 0U);
}

TEST(RosClouds, AScanWithoutTimeIncrementIsSeenAtOnce) {
  LaserHead head = kLaserHead;
  EXPECT_FALSE(cloud_of_laser_scan(laser_scan({5, 5, 5, 5, 5}, head), "it").is_at_once);
  head[3] = 0;  // scan_time is 25 ms
  const SeenCloud cloud = cloud_of_laser_scan(laser_scan({5, 5, 5, 5, 5}, head), "it");
  EXPECT_TRUE(cloud.is_at_once);
  EXPECT_FALSE(cloud.has_times);
  EXPECT_EQ(cloud.points.back().after_us, 0U);
  head[1] = head[0];
  EXPECT_FALSE(cloud_of_laser_scan(laser_scan({5}, head), "it").is_at_once);
  head[3] = -0.001F;
  EXPECT_FALSE(cloud_of_laser_scan(laser_scan({5}, head), "it").is_at_once);
}

TEST(RosClouds, AScanWhoseHeadContradictsItselfIsTold) {
  const auto told = [](std::size_t field, float value) {
    LaserHead head = kLaserHead;
    head.at(field) = value;
    return told_by([&] {
      static_cast<void>(cloud_of_laser_scan(laser_scan({5, 5, 5, 5, 5}, head), "it"));
    });
  };
  EXPECT_EQ(told(6, 0), "it: range_max is 0 m");
  EXPECT_EQ(told(6, kNan), "it: range_max is nan m");
  EXPECT_EQ(told(6, kInfinite), "it: range_max is inf m");
  EXPECT_EQ(told(5, 30), "it: range_min is 30 m, and range_max 20");
  EXPECT_EQ(told(0, kNan), "it: angle_min is nan, and angle_max 0.2");
  for (const auto& [step, words] : {std::pair(0.F, "0"), {kNan, "nan"}, {-0.3F, "-0.3"}}) {
    EXPECT_EQ(told(2, step), std::string("it: angle_increment is ") + words +
                                 " rad from beam to beam; at most 0.2 is read");
  }
  EXPECT_EQ(told(2, 0.05F),
            "it: by angle_min and angle_increment its last beam is at 0 rad, and angle_max is 0.2");
  const LaserHead degrees{-135.F, 135.F, 0.1F, 0.F, 0.025F, 0.1F, 20.F};
  EXPECT_EQ(told_by([&] {
              static_cast<void>(
                  cloud_of_laser_scan(laser_scan(std::vector<float>(2'701, 5.F), degrees), "it"));
            }),
            "it: its beams go from -135 to 135 rad, which is more than a turn");
  EXPECT_EQ(told_by([] {
              static_cast<void>(cloud_of_laser_scan(laser_scan({5000, 5000, 501, 5, 5}), "it"));
            }),
            "it: 3 of its 5 points are more than 500 m away; coordinates are metres");
  EXPECT_EQ(told(1, 0.3F), "");  // some drivers name the end of the last step
}

TEST(RosClouds, BeamsTimesThatAreOfNoScanAreLeftOutAndTold) {
  for (const float apart_s : {-0.001F, kNan, kInfinite, 1.F, 0.F}) {
    LaserHead head = kLaserHead;
    head[3] = apart_s;
    const SeenCloud cloud = cloud_of_laser_scan(laser_scan({5, 5, 5, 5, 5}, head), "it");
    EXPECT_FALSE(cloud.has_times);
    EXPECT_EQ(cloud.has_wrong_times, apart_s != 0) << apart_s;
  }
}

}  // namespace
}  // namespace iog::tools
