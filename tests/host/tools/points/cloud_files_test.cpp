// Files of clouds: their order, and the times that their names have or that are assumed.
#include "tools/clouds/cloud_files.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "cloud_bytes.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

std::vector<std::string> paths_of(const CloudFiles& all) {
  std::vector<std::string> paths;
  std::ranges::transform(all.files, std::back_inserter(paths), &CloudFile::path);
  return paths;
}

TEST(CloudFiles, AShellsOrderIsNotThatOfTheDrive) {
  const CloudFiles all = timed({"a/1.bin", "a/10.bin", "a/11.bin", "a/2.bin", "a/02.bin"}, 20);
  EXPECT_EQ(paths_of(all),
            (std::vector<std::string>{"a/1.bin", "a/02.bin", "a/2.bin", "a/10.bin", "a/11.bin"}));
  EXPECT_EQ(all.files[4].time_us, kDriveStartUs + 200'000);
  EXPECT_EQ(all.remarks,
            std::vector<std::string>{"files were put in the order of the numbers in their names"});
  EXPECT_EQ(all.remarks_if_assumed,
            (std::vector<std::string>{
                "neither file names nor points have Unix times: 20 clouds per second "
                "assumed (--rate), from 2024-05-01 12:00:00 UTC",
                "7 files are missing by the numbers in their names, the "
                "first after 2.bin: clouds after it are timed too early"}));
  EXPECT_EQ(timed({"1532402927.bin"}, 10).remarks_if_assumed.size(), 0U);
}

TEST(CloudFiles, OnlyAGapInEvenNumbersIsMissingFiles) {
  for (const std::vector<std::string>& paths :
       std::vector<std::vector<std::string>>{{"1.bin", "2.bin"},
                                             {"0.pcd", "5.pcd", "10.pcd"},
                                             {"3.pcd", "104.pcd", "203.pcd", "305.pcd"},
                                             {"0.pcd", "2.pcd", "4.pcd", "6.pcd", "9.pcd"},
                                             {"0.pcd", "100.pcd", "200.pcd", "300.pcd", "401.pcd"},
                                             {"a1.pcd", "a2.pcd", "b7.pcd", "b8.pcd"},
                                             {"map.pcd", "x.pcd"}}) {
    EXPECT_EQ(timed(paths, 10).remarks_if_assumed.size(), 1U) << paths[0];
  }
}

// They would be one drive, one lidar's scans behind or between the other's.
TEST(CloudFiles, NamesOfTwoLidarsAreTold) {
  const auto told = [](const std::vector<std::string>& paths) { return timed(paths, 10).remarks; };
  EXPECT_EQ(told({"a/front_0.pcd", "a/front_1.pcd", "a/rear_0.pcd", "a/rear_1.pcd"}),
            std::vector<std::string>{"front_0.pcd and rear_0.pcd seem to be of two lidars or "
                                     "drives, or copies; give the files of one"});
  for (const std::vector<std::string>& paths : std::vector<std::vector<std::string>>{
           {"lidar0_10.pcd", "lidar0_11.pcd", "lidar1_10.pcd", "lidar1_11.pcd"},
           {"0_l_7.ply", "0_l_8.ply", "0_r_7.ply", "0_r_8.ply"},
           {"000001.bin", "000002 (copy).bin", "000002.bin", "000003.bin"},
           {"000001.bin", "000002 (1).bin", "000002.bin", "000003.bin"},
           {"f_1532402927.1.pcd", "r_1532402927.2.pcd", "f_1532402927.3.pcd", "r_1532402927.4.pcd"},
           {"n1__REAR__1532402927647951.pcd.bin", "n1__TOP__1532402927647952.pcd.bin",
            "n1__REAR__1532402927747951.pcd.bin", "n1__TOP__1532402927747952.pcd.bin"}}) {
    EXPECT_EQ(told(paths).size(), 1U) << paths[0];
  }
}

TEST(CloudFiles, NamesOfOneDriveAreNotThoseOfTwoLidars) {
  for (const std::vector<std::string>& paths : std::vector<std::vector<std::string>>{
           {"a1.pcd", "a2.pcd", "b7.pcd", "b8.pcd"},  // its parts
           {"part_1/1.pcd", "part_1/2.pcd", "part_2/1.pcd", "part_2/2.pcd"},
           {"map.pcd", "x.pcd"},
           {"cloud_1690000000_000000000.pcd", "cloud_1690000000_100000000.pcd",
            "cloud_1690000001_000000000.pcd", "cloud_1690000001_100000000.pcd"},
           {"1532402926.pcd", "1532402926.5.pcd", "1532402927.pcd", "1532402927.5.pcd"},
           {"12-00-00.pcd", "12-00-30.pcd", "12-01-00.pcd", "12-01-30.pcd"},
           {"T12-00-00.pcd", "T12-00-30.pcd", "T13-00-00.pcd", "T13-00-30.pcd"},
           {"f1_s0.pcd", "f2_s0.pcd", "f3_s1.pcd", "f4_s1.pcd"},
           {"07ab.pcd", "a3f.pcd", "c44d.pcd", "ffe.pcd"},
           {"n008-2018-08-01-15-16-36-0400__LIDAR_TOP__1533151603547590.pcd.bin",
            "n008-2018-08-01-15-16-36-0400__LIDAR_TOP__1533151603597909.pcd.bin",
            "n015-2018-07-24-11-22-45+0800__LIDAR_TOP__1532402927647951.pcd.bin",
            "n015-2018-07-24-11-22-45+0800__LIDAR_TOP__1532402927697951.pcd.bin"}}) {
    for (const std::string& remark : timed(paths, 10).remarks) {
      EXPECT_TRUE(remark.starts_with("files were put in the order")) << remark;
    }
  }
}

TEST(CloudFiles, FoldersThatMayBeOfTwoLidarsAreTold) {
  using Folders = std::vector<std::vector<std::string>>;
  EXPECT_EQ(
      words_of_overlap({{"front/0.pcd", "front/1.pcd"}, {"rear/1.pcd", "rear/2.pcd"}}),
      "numbers or times in the file names of front and rear overlap: if they are of two lidars, "
      "give each folder to a run of its own");
  for (const Folders& folders : std::vector<Folders>{
           {{"a/7.pcd"}, {"f/1532402927.1.pcd", "f/1532402927.3.pcd"}, {"r/1532402927.2.pcd"}},
           {{"f/1532402927.1.pcd", "f/1532402927.9.pcd"}, {"r/1532402927.10.pcd"}},
           {{"a/front_8.pcd", "a/front_10.pcd"}, {"b/rear_9.pcd", "b/rear_11.pcd"}},
           {{"pA/000000.pcd", "pA/000001.pcd"}, {"pB/000000.pcd", "pB/000001.pcd"}}}) {
    EXPECT_NE(words_of_overlap(folders), "") << folders[0][0];
  }
}

TEST(CloudFiles, FoldersThatFollowEachOtherArePartsOfADrive) {
  using Folders = std::vector<std::vector<std::string>>;
  for (const Folders& folders : std::vector<Folders>{
           {{"a/0.pcd", "a/1.pcd"}, {"b/2.pcd", "b/3.pcd"}, {"c/1532402927.1.pcd"}},
           {{"simB/100.000000000.pcd", "simB/101.900000000.pcd"},
            {"simA/0.000000000.pcd", "simA/1.900000000.pcd"}},
           {{"a/20240501_103000_100.pcd", "a/20240501_103959_900.pcd"},
            {"b/20240501_104000_100.pcd", "b/20240501_104959_900.pcd"}},
           {{"a/000000_lidar1.pcd", "a/000099_lidar1.pcd"},
            {"b/000100_lidar1.pcd", "b/000199_lidar1.pcd"}},
           {{"a1/map.pcd"}, {"b1/1.pcd", "b1/map.pcd"}},
           {}}) {
    EXPECT_EQ(words_of_overlap(folders), "");
  }
}

TEST(CloudFiles, EndingsMayHaveCapitals) {
  EXPECT_TRUE(is_cloud_file("SCAN.PCD"));
  EXPECT_EQ(time_in_name("1532402927.5.BIN"), 1'532'402'927'500'000);
  EXPECT_FALSE(is_cloud_file("SCAN.PCD/readme.txt"));
}

TEST(CloudFiles, OneSmallStepHidesNoMissingFiles) {
  const std::vector<std::string> remarks =
      timed({"0.pcd", "100.pcd", "199.pcd", "299.pcd", "399.pcd", "699.pcd"}, 10)
          .remarks_if_assumed;
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_TRUE(remarks[1].starts_with("2 files are missing")) << remarks[1];
}

TEST(CloudFiles, ATimeInANameCounts) {
  constexpr std::uint64_t kUs = 1'532'402'927'647'951;
  EXPECT_EQ(time_in_name("1532402927647951123.pcd"), kUs);
  EXPECT_EQ(time_in_name("n015-2018-07-24__LIDAR_TOP__1532402927647951.pcd.bin"), kUs);
  EXPECT_EQ(time_in_name("a/1532402927.647951.bin"), kUs);
  EXPECT_EQ(time_in_name("cloud_1532402927.647951123.ply"), kUs);
  EXPECT_EQ(time_in_name("1532402927.5.bin"), 1'532'402'927'500'000);
  EXPECT_EQ(time_in_name("cloud_1532402927_647951123.ply"), kUs);
  EXPECT_EQ(time_in_name("1532402927_007951123.pcd"), kUs - 640'000);
  EXPECT_EQ(time_in_name("1532402927_7951123.pcd"), kUs - 640'000);
  EXPECT_EQ(time_in_name("1532402927647.bin"), kUs / 1000 * 1000);
  EXPECT_EQ(time_in_name("1532402927.bin"), kUs / 1'000'000 * 1'000'000);
  for (const char* name : {"000012.bin", "0000000012.bin", "scan12.5.pcd", "2018-07-24.pcd", ".pcd",
                           "cloud.pcd", "9532402927.bin", "1532402927647951/3.bin",
                           "1532402927_000012.pcd", "1532402927_00000012.pcd", "1532402927_0.pcd",
                           "153240292_647951123.pcd", "9532402927_647951123.pcd"}) {
    EXPECT_EQ(time_in_name(name), std::nullopt) << name;
  }
  const CloudFiles all = timed({"1532402927.10.pcd", "1532402927.9.pcd", "1532402926.pcd"}, 10);
  EXPECT_EQ(paths_of(all),
            (std::vector<std::string>{"1532402926.pcd", "1532402927.10.pcd", "1532402927.9.pcd"}));
  EXPECT_EQ(all.files[2].time_us, 1'532'402'927'900'000U);
  EXPECT_EQ(all.remarks,
            std::vector<std::string>{"files were put in the order of the times in their names"});
  EXPECT_EQ(timed({"1532402927.1.pcd", "map.pcd"}, 10).files[0].time_us, kDriveStartUs);
}

// A driver may write both numbers of a stamp without zeros before them.
TEST(CloudFiles, ShortNanosecondsAreATimeAmongLongOnes) {
  const std::vector<std::string> drive{"1532402927_951123.pcd", "1532402927_100951123.pcd",
                                       "1532402927_200951123.pcd", "1532402928_0.pcd",
                                       "1532402928_99951123.pcd"};
  const CloudFiles all = timed(drive, 10);
  EXPECT_EQ(paths_of(all), drive);
  EXPECT_EQ(all.files[0].time_us, 1'532'402'927'000'951U);
  EXPECT_EQ(all.files[3].time_us, 1'532'402'928'000'000U);
  EXPECT_EQ(all.remarks, std::vector<std::string>{});
  EXPECT_EQ(all.remarks_if_assumed, std::vector<std::string>{});
  for (const char* const number : {"1532402928_000012.pcd", "1532402928_00951123.pcd"}) {
    EXPECT_EQ(timed({drive[1], drive[2], number}, 10).files[0].time_us, kDriveStartUs) << number;
  }
  EXPECT_EQ(timed({drive[0], drive[1]}, 10).files[0].time_us, kDriveStartUs) << "not most";
  EXPECT_EQ(words_of_overlap({{"a/1532402926_951123.pcd", "a/1532402926_100951123.pcd",
                               "a/1532402926_200951123.pcd"},
                              {drive[1], drive[2]}}),
            "");
}

class CloudFolder : public ::testing::Test {
 protected:
  void write(const std::string& name, std::span<const float> numbers) const {
    OutputFile file(folder_ / name);
    file.write(std::as_bytes(numbers));
    file.finish();
  }

  tests::TemporaryFolder folder_;
};

TEST_F(CloudFolder, ItsFilesComeInTheOrderOfTheirNumbers) {
  constexpr std::array kPoint{1.F, 2.F, 3.F, 0.F};
  for (const char* name : {"10.bin", "9.bin", "notes.txt", "._9.bin"}) {  // the last one of macOS
    write(name, kPoint);
  }
  EXPECT_EQ(cloud_files_in(folder_ / ""),
            (std::vector<std::string>{folder_ / "9.bin", folder_ / "10.bin"}));
  for (const char* name : {"9 (copy).bin", "11.bin"}) {
    write(name, kPoint);
  }
  EXPECT_EQ(told_by([this] { static_cast<void>(cloud_files_in(folder_ / "")); }),
            folder_ / "" +
                ": 9.bin and 9 (copy).bin seem to be of two lidars or drives, or copies; "
                "give the files of one");
  write("9.pcd", kPoint);
  EXPECT_NE(told_by([this] {
              static_cast<void>(cloud_files_in(folder_ / ""));
            }).find("it has files .bin and .pcd; give those of one drive"),
            std::string::npos);
}

// Points' own times count if they are those since 1970, in any unit; those of a scan do not.
TEST_F(CloudFolder, AFileWithoutATimeHasThatOfItsFirstPoint) {
  constexpr std::uint64_t kUs = 1'700'000'000'250'000;
  const auto time_of = [&](const std::string& type, const std::string& first,
                           const std::string& last, bool is_assumed) {
    OutputFile file(folder_ / "7.pcd");
    file.write("FIELDS x y z timestamp\nSIZE 4 4 4 8\nTYPE F F F " + type +
               "\nPOINTS 2\nDATA ascii\n5 0 0 " + last + "\n0 5 0 " + first + "\n");
    file.finish();
    TimeUnit unit = type == "U" ? TimeUnit::kNanoseconds : TimeUnit::kSeconds;
    const SeenCloud cloud = read_cloud_of(
        {.path = folder_ / "7.pcd", .time_us = kDriveStartUs, .is_assumed = is_assumed}, unit);
    EXPECT_EQ(cloud.is_assumed, is_assumed && cloud.time_us == kDriveStartUs);
    EXPECT_EQ(cloud.apart_us != 0, !is_assumed && first.size() > 2);
    return cloud.time_us;
  };
  EXPECT_EQ(time_of("F", "1700000000.25", "1700000000.35", true), kUs);
  EXPECT_EQ(time_of("U", "1700000000250000000", "1700000000350000000", true), kUs);
  EXPECT_EQ(time_of("U", "1700000000250000000", "1700000000250000000", true), kUs);
  EXPECT_EQ(time_of("F", "0", ".1", true), kDriveStartUs);
  EXPECT_EQ(time_of("F", "1700000000.25", "1700000000.35", false), kDriveStartUs);
}

// Times since 1970 in float32 have steps of 128 s: many clouds would have the same time.
TEST_F(CloudFolder, TimesSince1970InFloat32AreNone) {
  constexpr std::array kPoints{5.F, 0.F, 0.F, 1.7e9F, 0.F, 5.F, 0.F, 1.7e9F};
  OutputFile file(folder_ / "7.pcd");
  file.write(std::string("FIELDS x y z timestamp\nSIZE 4 4 4 4\nTYPE F F F F\n") +
             "POINTS 2\nDATA binary\n");
  file.write(std::as_bytes(std::span(kPoints)));
  file.finish();
  TimeUnit unit = TimeUnit::kSeconds;
  const SeenCloud cloud = read_cloud_of(
      {.path = folder_ / "7.pcd", .time_us = kDriveStartUs, .is_assumed = true}, unit);
  EXPECT_EQ(cloud.time_us, kDriveStartUs);
  EXPECT_TRUE(cloud.is_assumed && !cloud.has_times && cloud.points.size() == 2);
}

// x, y, z, intensity and ring of each point.
TEST_F(CloudFolder, FilesOfNuscenesHaveFiveNumbersAPoint) {
  constexpr std::array kPoints{0.F, 10.F, 0.F, -5.F, 31.F, 1.F, 0.F, 1.F, 7.F, 0.F};
  write("a.pcd.bin", kPoints);
  TimeUnit unit = TimeUnit::kFound;
  expect_two(read_cloud_of({.path = folder_ / "a.pcd.bin", .time_us = 5}, unit));
  write("b.pcd.bin", std::span(kPoints).first<8>());
  EXPECT_NE(told_by([&] {
              static_cast<void>(read_cloud_of({.path = folder_ / "b.pcd.bin"}, unit));
            }).find("32 bytes are no number of points of 20 bytes"),
            std::string::npos);
}

TEST_F(CloudFolder, WhatIsNoCloudIsToldWithWhatToDo) {
  const auto told = [&](const std::string& name, std::string_view text) {
    if (!text.empty()) {
      OutputFile file(folder_ / name);
      file.write(std::string(text));
      file.finish();
    }
    TimeUnit unit = TimeUnit::kFound;
    return told_by([&] { static_cast<void>(read_cloud_of({.path = folder_ / name}, unit)); });
  };
  EXPECT_NE(told("drive.bag", "#ROSBAG V2.0\n").find("bag of ROS 1: convert it to one of ROS 2"),
            std::string::npos);
  EXPECT_NE(told("metadata.yaml", "rosbag2:").find("give the folder of the bag"),
            std::string::npos);
  EXPECT_NE(told("x.laz", "LASF").find(": use .mcap, .db3, .pcd"), std::string::npos);
  EXPECT_NE(told("none", "").find("there is no such file"), std::string::npos);
}

}  // namespace
}  // namespace iog::tools
