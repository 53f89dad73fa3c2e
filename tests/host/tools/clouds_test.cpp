// Point clouds of a simulated drive, written as the KITTI data sets keep them, become packets
// again: each point by its laser, at its range, in its direction and at its time.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "drive_returns.hpp"
#include "drive_sample.hpp"
#include "fakes/temporary_folder.hpp"
#include "lidar/velodyne_hdl64e.hpp"
#include "pose/message.hpp"
#include "tools/clouds/cloud_conversion.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kTurns = 4;
constexpr double kCrossingM = 0.02;
constexpr double kTicksPerBlock = 36'000 * kBlockUs / kTurnUs;

// Where beams of two lasers cross, nothing tells whose a point is.
bool is_of_one_laser(const Return& its, double off_m) {
  const CloudPoint at = point_of(its);
  const double r = std::hypot(at.x, at.y);
  const auto lasers = car().sensors[0].lasers;
  return std::ranges::count_if(lasers, [&](const lidar::Laser& laser) {
           const double elevation = laser.elevation_deg * kRadians;
           const double z = laser.height_m / std::cos(elevation) + r * std::tan(elevation);
           return std::abs(at.z - z) < off_m;
         }) == 1;
}

// Those of the turns whose middles are at 0.1 s, 0.2 s and so on, in an order that their bytes
// show. Of what is seen to the rear itself nothing tells to which of two turns it belongs.
std::vector<Return> whole_turns(std::vector<Return> returns) {
  constexpr double kSeamUs = 10;
  std::erase_if(returns, [](const Return& its) {
    const double after_us = std::remainder(its.time_us - kTurnUs / 2, kTurnUs);
    return its.time_us < kTurnUs / 2 || its.time_us >= kTurnUs * (kTurns + 0.5) ||
           std::abs(after_us) < kSeamUs || !is_of_one_laser(its, kCrossingM);
  });
  std::ranges::sort(returns, {},
                    [](const Return& its) { return std::tuple(its.layer, its.time_us); });
  return returns;
}

void append(const CloudPoint& point, std::vector<std::byte>& bytes) {
  for (const double value : {point.x, point.y, point.z, 0.25}) {
    std::array<std::byte, 4> word{};
    wire::store_le32(word, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
    bytes.insert(bytes.end(), word.begin(), word.end());
  }
}

void write(const std::string& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.finish();
}

// The car of the odometry data drives 10 m/s ahead while it turns by 0.2 rad/s about an axis that
// is not upright, so that it pitches and rolls by degrees a second, too. Its place is that of the
// unit.
using Rotation = std::array<std::array<double, 3>, 3>;

// Rodrigues: about the unit vector (0.16, 0.48, ...).
Rotation turned_at(double time_us) {
  const std::array<double, 3> axis = {0.16, 0.48, std::sqrt(1 - 0.16 * 0.16 - 0.48 * 0.48)};
  const double angle = 0.2 * time_us * 1e-6;
  Rotation turned{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      turned[row][column] = (1 - std::cos(angle)) * axis[row] * axis[column];
    }
    turned[row][row] += std::cos(angle);
    turned[row][(row + 1) % 3] -= std::sin(angle) * axis[(row + 2) % 3];
    turned[row][(row + 2) % 3] += std::sin(angle) * axis[(row + 1) % 3];
  }
  return turned;
}

CloudPoint place_at(double time_us) { return {time_us * 1e-5, -2, 0}; }

CloudPoint seen_at(double time_us, const CloudPoint& point, double from_us) {
  const Rotation then = turned_at(from_us);
  const Rotation now = turned_at(time_us);
  const auto world = [&](std::size_t row) {
    return then[row][0] * point.x + then[row][1] * point.y + then[row][2] * point.z;
  };
  const double x = world(0) + place_at(from_us).x - place_at(time_us).x;
  const auto seen = [&](std::size_t column) {
    return now[0][column] * x + now[1][column] * world(1) + now[2][column] * world(2);
  };
  return {seen(0), seen(1), seen(2)};
}

class Clouds : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_drive = whole_turns(returns_of(sample_drive(car(), 3, 5)));
  }
  static void TearDownTestSuite() { shared_drive.clear(); }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() + name; }

  template <typename PointOf>
  void write_clouds(const std::string& stem, std::size_t digits, const PointOf& its) const {
    std::map<std::size_t, std::vector<std::byte>> clouds;
    for (const Return& one : shared_drive) {
      append(its(one), clouds[turn_of(one)]);
    }
    for (const auto& [turn, bytes] : clouds) {
      OutputFile file(path(stem) + zero_padded(turn, digits) + ".bin");
      file.write(bytes);
      file.finish();
    }
  }

  // The drive begins at 2024-05-01 12:00:00.
  void write_raw() const {
    make_folder(path("/velodyne_points/data"));
    write_clouds("/velodyne_points/data/", 10, point_of);
    write(path("/velodyne_points/timestamps.txt"), stamps());
    make_folder(path("/oxts/data"));
    write(path("/oxts/timestamps.txt"), stamps());
    for (std::size_t i = 0; i < kTurns; ++i) {
      std::string fields = "49.0 " + std::to_string(8.4 + 1e-5 * static_cast<double>(i));
      for (int field = 2; field < 30; ++field) {
        fields += field == 5 ? " 0.5" : " 0";  // the heading
      }
      write(path("/oxts/data/") + zero_padded(i, 10) + ".txt", fields + '\n');
    }
  }

  void write_odometry() const {
    make_folder(path("/velodyne"));
    write_clouds("/velodyne/", 6, [](const Return& its) {
      const double forward_us = kTurnUs * static_cast<double>(turn_of(its) + 1);
      return seen_at(forward_us, point_of(its), its.time_us);
    });
    std::string times;
    std::string poses;
    for (std::size_t i = 1; i <= kTurns; ++i) {
      const CloudPoint at = place_at(kTurnUs * static_cast<double>(i));
      const Rotation turned = turned_at(kTurnUs * static_cast<double>(i));
      std::array<char, 300> line{};
      // Right, down and forward of the camera are -y, -z and x of the unit, in its poses and in the
      // local frame.
      const auto row = [&](std::size_t unit, double sign) {
        return std::array{-sign * turned[unit][1], -sign * turned[unit][2], sign * turned[unit][0]};
      };
      const auto right = row(1, -1);
      const auto down = row(2, -1);
      const auto ahead = row(0, 1);
      std::snprintf(line.data(), line.size(),
                    "%.9e %.9e %.9e %.9e %.9e %.9e %.9e %.9e %.9e %.9e %.9e %.9e\n", right[0],
                    right[1], right[2], -at.y, down[0], down[1], down[2], -at.z, ahead[0], ahead[1],
                    ahead[2], at.x);
      poses += line.data();
      times += std::to_string(0.1 * static_cast<double>(i)) + '\n';
    }
    write(path("/times.txt"), times);
    write(path("/poses.txt"), poses);
    write(path("/calib.txt"), "P0: 1 2 3\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
  }

  static std::string stamps() {
    std::string text;
    for (std::size_t i = 1; i <= kTurns; ++i) {
      text += "2024-05-01 12:00:00." + std::to_string(i) + "00000000\n";
    }
    return text;
  }

  [[nodiscard]] std::vector<CapturedDatagram> converted(PointFates& fates) const {
    CloudConversion conversion(folder_.path(), car(), 0, 0, 0);
    std::vector<CapturedDatagram> all;
    for (std::vector<CapturedDatagram> next; !(next = conversion.next()).empty();) {
      all.insert(all.end(), next.begin(), next.end());
    }
    fates = conversion.fates();
    return all;
  }
  [[nodiscard]] std::vector<CapturedDatagram> converted() const {
    PointFates fates;
    return converted(fates);
  }

  [[nodiscard]] std::string error() const {
    try {
      static_cast<void>(converted());
    } catch (const UsageError& error) {
      return error.what();
    }
    return "no error";
  }

  // What comes out is what went in, but for half a firing and what a float rounds.
  void expect_the_drive(const std::vector<CapturedDatagram>& datagrams,
                        std::uint32_t off_mm) const {
    std::vector<Return> found = returns_of(datagrams);
    std::ranges::sort(found, {},
                      [](const Return& its) { return std::tuple(its.layer, its.time_us); });
    ASSERT_GT(shared_drive.size(), 300'000U);
    ASSERT_EQ(found.size(), shared_drive.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::int32_t off_ticks =
          (found[i].azimuth_ticks - shared_drive[i].azimuth_ticks + 54'000) % 36'000 - 18'000;
      const std::int64_t off = std::int64_t{found[i].range_mm} - shared_drive[i].range_mm;
      wrong += found[i].layer != shared_drive[i].layer || std::abs(off) > off_mm ||
                       std::abs(off_ticks) > kTicksPerBlock / 2 + 1 ||
                       std::abs(found[i].time_us - shared_drive[i].time_us) > kBlockUs / 2 + 1.5
                   ? 1U
                   : 0U;
    }
    EXPECT_EQ(wrong, 0U) << "of " << found.size();
  }

  static std::vector<Return> shared_drive;
  tests::TemporaryFolder folder_;
};
std::vector<Return> Clouds::shared_drive;

TEST_F(Clouds, OfRawDataGoBackToTheirPackets) {
  write_raw();
  PointFates fates;
  const std::vector<CapturedDatagram> datagrams = converted(fates);
  EXPECT_EQ(fates.sent, shared_drive.size());
  EXPECT_EQ(fates.seen(), shared_drive.size());
  EXPECT_TRUE(std::ranges::is_sorted(datagrams, {}, &CapturedDatagram::time_us));
  expect_the_drive(datagrams, 0);
}

// The clouds' points are in the order of the drive.
TEST_F(Clouds, TellWhereEachPointWent) {
  write_raw();
  std::map<std::size_t, std::vector<Return>> turns;
  for (const Return& its : shared_drive) {
    turns[turn_of(its)].push_back(its);
  }
  CloudConversion conversion(folder_.path(), car(), 0, 0, 0);
  std::map<std::uint64_t, std::vector<SentPoint>> told;
  conversion.tell([&](const SentPoint& point) { told[point.datagram_us].push_back(point); });
  std::size_t found = 0;
  std::size_t wrong = 0;
  lidar::VelodyneHdl64eS3 decoder;
  for (std::vector<CapturedDatagram> next; !(next = conversion.next()).empty();) {
    for (const CapturedDatagram& datagram : next) {
      if (datagram.destination.port != car().sensors[0].udp_port) {
        continue;
      }
      ASSERT_EQ(decoder.decode(datagram.payload), lidar::DecodeStatus::kOk);
      std::vector<lidar::ScanPoint> points;
      decoder.for_each_point([&](const lidar::ScanPoint& point) { points.push_back(point); });
      for (const SentPoint& sent : told[datagram.time_us]) {
        const Return& its = turns[sent.turn].at(sent.point);
        const lidar::ScanPoint& point = points.at(sent.range);
        ++found;
        wrong += point.layer != its.layer || point.range_mm != its.range_mm ? 1U : 0U;
      }
    }
  }
  EXPECT_EQ(found, shared_drive.size());
  EXPECT_EQ(wrong, 0U);
}

TEST_F(Clouds, OfOdometryDataGoBackToWhereTheyWereSeen) {
  write_odometry();
  PointFates fates;
  expect_the_drive(converted(fates), 2);
  EXPECT_EQ(fates.sent, shared_drive.size());
}

// Between two of the log's poses the car moves evenly.
TEST_F(Clouds, HavePosesEachHundredthOfASecond) {
  write_raw();
  std::vector<pose::Message> messages;
  for (const CapturedDatagram& datagram : converted()) {
    if (datagram.destination.port == pose::kPosePort) {
      const pose::Decoded decoded = pose::decode(datagram.payload);
      ASSERT_EQ(decoded.fate, pose::Fate::kUsed);
      messages.push_back(decoded.message);
    }
  }
  ASSERT_EQ(messages.size(), 10 * (kTurns - 1) + 1);
  // A degree of longitude at 49 degrees north is 73,172 m (WGS 84).
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(messages[i].clock_us, kDriveStartUs + 100'000 + 10'000 * i);
    EXPECT_NEAR(messages[i].pose.x_mm, 73.172 * static_cast<double>(i), 1);
    EXPECT_NEAR(messages[i].pose.y_mm, 0, 1);
  }
}

TEST_F(Clouds, OfATurnThatIsMissingLeaveAGapAndAreRemarked) {
  write_raw();
  std::filesystem::remove(path("/velodyne_points/data/0000000001.bin"));
  CloudConversion conversion(folder_.path(), car(), 0, 0, 0);
  EXPECT_EQ(conversion.set().remarks, std::vector<std::string>{"1 time without a cloud"});
  std::size_t inside = 0;
  for (const Return& its : returns_of(converted())) {
    inside += its.time_us > 151'000 && its.time_us < 249'000 ? 1U : 0U;
  }
  EXPECT_EQ(inside, 0U);
}

TEST_F(Clouds, AreCountedPointByPoint) {
  write_raw();
  std::vector<std::byte> bytes;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  append({kNan, 0, 0}, bytes);
  append({0, kInfinity, 0}, bytes);
  append({3, 0, 3}, bytes);      // over all lasers
  append({300, 0, 3.5}, bytes);  // beyond 131 m
  OutputFile file(path("/velodyne_points/data/0000000003.bin"));
  file.write(bytes);
  file.finish();
  PointFates fates;
  static_cast<void>(converted(fates));
  EXPECT_EQ(fates.not_finite, 2U);
  EXPECT_EQ(fates.no_laser, 1U);
  EXPECT_EQ(fates.out_of_range, 1U);
  EXPECT_EQ(fates.taken, 0U);
}

TEST_F(Clouds, ThatAreNoneAreRefusedWithTheReason) {
  const auto has = [](const std::string& text, std::string_view part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(error(), "neither velodyne_points, as in KITTI's raw data, nor velodyne");
  write_raw();
  const std::string cloud = path("/velodyne_points/data/0000000000.bin");
  const std::string times = path("/velodyne_points/timestamps.txt");
  std::filesystem::resize_file(cloud, 33);
  has(error(), "33 bytes are no number of points of 16 bytes");
  std::filesystem::resize_file(cloud, 160'000'000);
  has(error(), "10000000 points; no unit sees more than 1000000 in a turn");
  std::filesystem::resize_file(cloud, 0);
  EXPECT_EQ(error(), "no error");  // nothing came back in that turn
  write(times, "2024-05-01 12:00:00.2\n2024-05-01 12:00:00.1\n");
  has(error(), "timestamps.txt:2: -100 ms a turn since the time before");
  write(times, "2024-05-01 12:00:00.2\n2024-05-01 12:00:00.2\n");
  has(error(), "timestamps.txt:2: 0 ms a turn");
  write(times, "2024-05-01 12:00:00.1\nnoon\n");
  has(error(), "timestamps.txt:2: 'noon' is no time");
  write(times, "2024-05-01 12:00:00.1\n");
  has(error(), "a drive has at least two turns");
  write(times, "");
  has(error(), "no cloud of its times is there");
}

// Its lasers look 0.17 degrees higher, half a ring: to each point there is a laser, but none fits.
// In millimetres a laser fits each point, and none reaches it.
TEST_F(Clouds, OfAnotherUnitOrLengthAreRefused) {
  write_raw();
  const auto expect = [this](double rise, double scale, std::string_view words) {
    write_clouds("/velodyne_points/data/", 10, [=](const Return& its) {
      const CloudPoint at = point_of(its);
      return CloudPoint{at.x * scale, at.y * scale, (at.z + rise * std::hypot(at.x, at.y)) * scale};
    });
    EXPECT_NE(error().find(words), std::string::npos) << error();
  };
  expect(0.003, 1, "points are where the lasers of roof look: the car's table is of another");
  expect(0, 1000, "points are beyond the range of roof; coordinates are metres");
}

TEST_F(Clouds, OfOdometryDataNeedWholePoses) {
  write_odometry();
  write(path("/calib.txt"), "P0: 1 2 3\n");
  EXPECT_NE(error().find("no line Tr: says where the unit is"), std::string::npos);
  write(path("/calib.txt"), "Tr: 0 -1 0 0 0 0 -1 0 1 0 0\n");
  EXPECT_NE(error().find("11 numbers instead of 12"), std::string::npos);
  write(path("/calib.txt"), "Tr: 0 -1 0 0 0 0 -1 0 5 0 0 0\n");
  EXPECT_NE(error().find("row 3 is no row of a rotation"), std::string::npos);
  std::filesystem::remove(path("/poses.txt"));
  CloudConversion conversion(folder_.path(), car(), 0, 0, 0);
  EXPECT_EQ(conversion.poses(), 0U);
  EXPECT_EQ(conversion.set().remarks.size(), 2U);
}

}  // namespace
}  // namespace iog::tools
