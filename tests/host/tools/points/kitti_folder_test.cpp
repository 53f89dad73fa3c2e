// Clouds of KITTI's data: four points of each turn, whose times and places are counted by hand.
#include <cmath>
#include <string>
#include <vector>

#include "cloud_bytes.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/clouds/cloud_set.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

class KittiFolder : public ::testing::Test {
 protected:
  template <typename Content>
  void write(const std::string& name, const Content& content) const {
    OutputFile file(folder_ / name);
    file.write(content);
    file.finish();
  }
  // 10 m to the left, ahead and to the right; one that is no number, and one at the unit.
  static Bytes points() {
    Bytes bytes;
    for (const auto& [x, y] :
         std::vector<std::array<float, 2>>{{0, 10}, {10, 0}, {0, -10}, {NAN, 0}, {0, 0}}) {
      add(bytes, x);
      add(bytes, y);
      add(bytes, 0.F);
      add(bytes, 0.5F);
    }
    return bytes;
  }
  [[nodiscard]] std::vector<SeenCloud> clouds() const {
    std::vector<SeenCloud> all;
    remarks_ = for_each_of_set(folder_.path(), [&](SeenCloud&& cloud) { all.push_back(cloud); });
    return all;
  }

  tests::TemporaryFolder folder_;
  mutable std::vector<std::string> remarks_;
};

// The head turns clockwise, from the rear to the rear, and looks ahead at the turn's time.
TEST_F(KittiFolder, PointsOfRawDataHaveTheTimeAtWhichTheHeadLookedThere) {
  make_folder(folder_ / "velodyne_points/data");
  write("velodyne_points/timestamps.txt",
        std::string("2011-09-26 13:00:00.1\n2011-09-26 13:00:00.2\n2011-09-26 13:00:00.3\n"));
  write("velodyne_points/data/0000000000.bin", points());
  write("velodyne_points/data/0000000002.bin", points());
  const std::vector<SeenCloud> seen = clouds();
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(remarks_,
            (std::vector<std::string>{"1 time without a cloud", "no poses: there is no oxts"}));
  EXPECT_EQ(seen[0].time_us, 1'317'042'000'050'000U);
  EXPECT_EQ(seen[1].time_us, 1'317'042'000'250'000U);
  for (const SeenCloud& cloud : seen) {
    EXPECT_EQ(cloud.not_finite, 1U);
    EXPECT_EQ(cloud.nowhere, 1U);
    ASSERT_EQ(cloud.points.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(cloud.points[i].after_us, 25'000 * (i + 1));
      EXPECT_EQ(cloud.points[i].third, 10'000);
    }
  }
}

TEST_F(KittiFolder, FilesWithoutATimeAreRemarkedAndPosesOfAnotherDayAreRefused) {
  make_folder(folder_ / "velodyne_points/data");
  make_folder(folder_ / "oxts/data");
  const std::string times = "2011-09-26 13:00:00.1\n2011-09-26 13:00:00.2\n";
  write("velodyne_points/timestamps.txt", times);
  write("oxts/timestamps.txt", times);
  std::string fields = "49 8.4";
  for (int field = 2; field < 30; ++field) {
    fields += " 0";
  }
  for (const char* const number : {"0", "1", "2"}) {
    write("velodyne_points/data/000000000" + std::string(number) + ".bin", points());
    write("oxts/data/000000000" + std::string(number) + ".txt", fields);
  }
  EXPECT_EQ(clouds().size(), 2U);
  EXPECT_EQ(remarks_, std::vector<std::string>{"1 cloud without a time"});
  const PoseLog log = read_oxts_log(folder_ / "oxts");
  EXPECT_EQ(log.remarks, std::vector<std::string>{"1 file in data/ without a time"});
  EXPECT_FALSE(log.poses[0].sigma_m);  // an accuracy of 0 is none
  write("oxts/timestamps.txt", std::string("2011-09-27 13:00:00.1\n2011-09-27 13:00:00.2\n"));
  EXPECT_NE(
      told_by([this] { static_cast<void>(clouds()); }).find("no pose of oxts is of its times"),
      std::string::npos);
  write("oxts/data/0000000000.txt", "91" + fields.substr(2));
  EXPECT_NE(told_by([this] { static_cast<void>(clouds()); }).find("is no place on the earth"),
            std::string::npos);
}

// The unit drives 10 m/s ahead: 25 ms before it looked ahead, it was 0.25 m further back.
TEST_F(KittiFolder, PointsOfOdometryDataAreWhereTheyWereSeen) {
  make_folder(folder_ / "velodyne");
  write("times.txt", std::string("0.1\n0.2\n"));
  write("calib.txt", std::string("Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n"));
  write("poses.txt", std::string("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n"));
  write("velodyne/000001.bin", points());
  const std::vector<SeenCloud> seen = clouds();
  ASSERT_EQ(seen.size(), 1U);
  ASSERT_EQ(seen[0].points.size(), 3U);
  const WirePoint& left = seen[0].points[0];
  // So it looked a = 1.410 degrees to the right of what would be to its left: tan a is 10 m/s of
  // (90 - a) of 360 degrees of 0.1 s, to 10 m.
  EXPECT_NEAR(left.first, 3'200 * (90 - 1.409), 5);
  EXPECT_NEAR(left.after_us, 25'391, 1);
  EXPECT_EQ(left.third, 10'003);
  EXPECT_EQ(seen[0].points[1].after_us, 50'000U);
  EXPECT_EQ(seen[0].points[1].third, 10'000);
  // And tan a is 10 m/s of (90 + a).
  EXPECT_NEAR(seen[0].points[2].first, 3'200 * (270 - 1.455), 5);
  EXPECT_NEAR(seen[0].points[2].after_us, 75'404, 1);
  write("calib.txt", std::string("Tr: 1 0 0 0 0 0 1 0 0 1 0 0\n"));  // a mirror
  EXPECT_NE(told_by([this] { static_cast<void>(clouds()); }).find("its rows are no rotation"),
            std::string::npos);
}

TEST_F(KittiFolder, OneCloudAloneHasNoTimes) {
  write("it.bin", points());
  const SeenCloud cloud = read_kitti_cloud(folder_ / "it.bin", 5);
  EXPECT_EQ(cloud.time_us, 5U);
  EXPECT_FALSE(cloud.has_times);
  EXPECT_EQ(cloud.points.size(), 3U);
  EXPECT_EQ(cloud.not_finite + cloud.nowhere, 2U);
}

// nuScenes has x, y, z, intensity and ring of each point; a scan that looks all around has as many
// places left as right.
TEST_F(KittiFolder, OneOfFiveNumbersAPointIsTold) {
  std::vector<std::array<float, 5>> points;
  for (int i = 0; i < 64; ++i) {
    const float turn = 0.1F * static_cast<float>(i);
    points.push_back({10 * std::cos(turn), 10 * std::sin(turn), -1, 7, 3});
  }
  OutputFile file(folder_ / "five.bin");
  file.write(std::as_bytes(std::span(points)));
  file.finish();
  EXPECT_NE(told_by([this] {
              static_cast<void>(read_kitti_cloud(folder_ / "five.bin", 5));
            }).find("convert files of three or five numbers a point to PCD"),
            std::string::npos);
}

}  // namespace
}  // namespace iog::tools
