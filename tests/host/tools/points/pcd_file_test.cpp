#include "tools/clouds/pcd_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <span>
#include <vector>

#include "cloud_bytes.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class PcdFile : public ::testing::Test {
 protected:
  std::string file(const std::string& words, const Bytes& bytes = {}) {
    OutputFile out(path_);
    out.write(words);
    out.write(bytes);
    out.finish();
    return path_;
  }
  SeenCloud pcd() {
    TimeUnit unit = TimeUnit::kFound;
    return read_pcd(path_, unit, 5);
  }
  // Without the path.
  std::string told_of(const std::string& words) {
    file(words);
    const std::string told = told_by([&] { static_cast<void>(pcd()); });
    return told.substr(std::min(path_.size(), told.size()));
  }

  tests::TemporaryFolder folder_;
  std::string path_ = folder_ / "it.pcd";
};

const std::string kHead =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS rgb x y z\nSIZE 1 4 4 4\nTYPE U F F F\nCOUNT 3 1 1 1\n"
    "WIDTH 4\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\n";

Bytes four_points() {
  Bytes bytes;
  for (const auto& [x, y, z] :
       std::vector<std::array<float, 3>>{{0, 10, 0}, {1, kNan, 0}, {0, 0, 0}, {1, 0, 1}}) {
    add(bytes, 0xFFFFFF, 3);
    add(bytes, x);
    add(bytes, y);
    add(bytes, z);
  }
  return bytes;
}

void expect_four(const SeenCloud& cloud) {
  expect_two(cloud);
  EXPECT_EQ(cloud.not_finite, 1U);
  EXPECT_EQ(cloud.nowhere, 1U);
  EXPECT_EQ(cloud.time_us, 5U);
  EXPECT_FALSE(cloud.has_times);
}

TEST_F(PcdFile, ReadPcdOfEachKind) {
  const Bytes points = four_points();
  file(kHead + "DATA ascii\n7 7 7 0 10 0\n7 7 7 1 nan 0\n7 7 7 0 0 0\n7 7 7 1 0 1\n");
  expect_four(pcd());
  file(kHead + "DATA binary\n", points);
  expect_four(pcd());
  // Field after field, in runs; and a repetition of the byte before, nine times.
  Bytes packed;
  const auto run = [&](const Bytes& bytes) {
    add(packed, bytes.size() - 1, 1);
    packed.insert(packed.end(), bytes.begin(), bytes.end());
  };
  run(Bytes(3, std::byte{0xFF}));
  add(packed, 7U << 5, 3);
  for (std::size_t field = 0; field < 3; ++field) {
    Bytes column;
    for (std::size_t point = 0; point < 4; ++point) {
      const auto number = std::span(points).subspan(point * 15 + 3 + field * 4, 4);
      column.insert(column.end(), number.begin(), number.end());
    }
    run(column);
  }
  Bytes sizes;
  add(sizes, packed.size(), 4);
  add(sizes, 60, 4);
  packed.insert(packed.begin(), sizes.begin(), sizes.end());
  file(kHead + "DATA binary_compressed\n", packed);
  expect_four(pcd());
  packed.pop_back();
  file(kHead + "DATA binary_compressed\n", packed);
  EXPECT_EQ(told_by([&] { static_cast<void>(pcd()); }),
            path_ + ": its compressed points are damaged");
}

// By PCL's description of the format the pose of the unit, of the quaternion first w: some programs
// put the points into its frame and others do not, so it is told.
TEST_F(PcdFile, AViewpointThatIsNotTheOriginIsNamed) {
  const std::string head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\n";
  const auto viewpoint_of = [&](const std::string& line) {
    file(head + line + "DATA ascii\n1 0 1\n");
    return pcd().viewpoint;
  };
  EXPECT_EQ(viewpoint_of(""), "");
  for (const std::string same : {"0 0 0 1 0 0 0", "0.0 -0 0 -1 0 0 0", "0 0 0 0 0 0 0"}) {
    EXPECT_EQ(viewpoint_of("VIEWPOINT " + same + "\n"), "") << same;
  }
  for (const std::string other : {"0 0 1.73 1 0 0 0", "0 0 0 0.7071 0 0 0.7071", "1 0 0", "a"}) {
    EXPECT_EQ(viewpoint_of("VIEWPOINT  " + other + "\r\n"), "VIEWPOINT " + other);
  }
}

TEST_F(PcdFile, OfDoublesSmallNumbersAndRowsIsRead) {
  Bytes points;
  for (const auto& [x, y, z] : std::vector<std::array<double, 3>>{
           {0, 10, 0}, {1, 0, 1}, {static_cast<double>(kNan), 0, 0}, {0, 0, 0}}) {
    add(points, 200, 1);
    add(points, x);
    add(points, y);
    add(points, z);
  }
  file(
      "FIELDS intensity x y z\nSIZE 1 8 8 8\nTYPE U F F F\nWIDTH 2\nHEIGHT 2\nPOINTS 4\n"
      "DATA binary\n",
      points);
  expect_four(pcd());
}

TEST_F(PcdFile, TellWhatIsWrongWithPcd) {
  EXPECT_EQ(told_of("ply\n"), ": this is no PCD file: its head has no FIELDS");
  EXPECT_EQ(told_of(kHead + "DATA zip\n"), ": DATA is zip; use ascii, binary, binary_compressed");
  EXPECT_EQ(told_of(kHead + "DATA binary\n"), ": it ends before its 4 points");
  EXPECT_EQ(told_of(kHead + "DATA ascii\n1 2\n"), ":12: 2 numbers instead of 6");
  const std::string row = "7 7 7 0 10 0\n";
  EXPECT_EQ(told_of(kHead + "DATA ascii\n\n" + row + "7 7 7 1,5 1 0\n"),
            ":14: '1,5' is not a number");
  EXPECT_EQ(told_of(kHead + "DATA ascii\n" + row + row), ": it ends before its 4 points");
  EXPECT_EQ(told_of(kHead + "DATA ascii\n" + row + row + row + row + "\n"), "");
  EXPECT_EQ(told_of(kHead + "DATA ascii\n" + row + row + row + row + row),
            ": it has more rows than its 4 points");
  EXPECT_EQ(told_of(kHead + "DATA binary\n" + std::string(75, '\0')),
            ": it has more bytes than its 4 points");
  EXPECT_EQ(told_of(kHead + "DATA binary_compressed\n" + std::string(8, '\1')),
            ": its 4 points have 60 bytes, and its compressed data 16843009");
  EXPECT_EQ(told_of(kHead + "WIDTH 5\nDATA ascii\n"), ": WIDTH x HEIGHT is 5, and POINTS 4");
  EXPECT_EQ(told_of(kHead + "POINTS 4.0\nDATA ascii\n"),
            ": in its head '4.0' is not a whole number, or is too large");
  EXPECT_EQ(told_of(kHead + "POINTS 9999999\nDATA ascii\n"),
            ": 9999999 points; no unit sees more than 1000000 in a scan");
  EXPECT_EQ(told_of(kHead + "DATA binary_compressed\n1"), ": it ends before its points");
  EXPECT_EQ(told_of("FIELDS x y\nSIZE 4\nTYPE F F\n"),
            ": its head has not as many sizes, types and counts as fields");
}

TEST_F(PcdFile, OfMoreBytesThanAnyCloudHasIsNotRead) {
  file(kHead + "DATA binary\n");
  std::filesystem::resize_file(path_, 128'000'001);
  EXPECT_EQ(told_by([&] { static_cast<void>(pcd()); }),
            path_ + ": it has 128000001 bytes; clouds of at most 128000000 are read");
}

}  // namespace
}  // namespace iog::tools
