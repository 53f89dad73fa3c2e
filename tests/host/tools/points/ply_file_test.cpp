// PLY as its description writes it, byte by byte; and what is told of wrong ones.
#include "tools/clouds/ply_file.hpp"

#include <algorithm>

#include "cloud_bytes.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

class PlyFile : public ::testing::Test {
 protected:
  SeenCloud ply(const std::string& words, const Bytes& bytes = {}) {
    OutputFile out(path_);
    out.write(words);
    out.write(bytes);
    out.finish();
    TimeUnit unit = TimeUnit::kMicroseconds;
    return read_ply(path_, unit, 5);
  }
  std::string told_of(const std::string& words) {
    return told_by([&] { static_cast<void>(ply(words)); }).substr(path_.size());
  }

  tests::TemporaryFolder folder_;
  std::string path_ = folder_ / "it.ply";
};

std::string head(const std::string& format) {
  return "ply\r\nformat " + format +
         " 1.0\r\ncomment two points\r\nelement vertex 2\r\nproperty uchar red\r\n"
         "property float64 x\r\nproperty float y\r\nproperty float32 z\r\nproperty uint time\r\n"
         "element face 1\r\nproperty list uchar int vertex_index\r\nend_header\r\n";
}

// A number as a file of that byte order has it.
template <typename Number>
void add_number(Bytes& bytes, Number number, bool is_big_endian) {
  Bytes its;
  add(its, number);
  if (is_big_endian) {
    std::ranges::reverse(its);
  }
  bytes.insert(bytes.end(), its.begin(), its.end());
}

TEST_F(PlyFile, ReadsEachFormat) {
  const auto expect_both = [](const SeenCloud& cloud) {
    expect_two(cloud);
    EXPECT_EQ(cloud.points[1].after_us, 50'000U);
    EXPECT_EQ(cloud.time_us, 7U);  // 2 us behind its stamp
  };
  expect_both(ply(head("ascii") + "255 0 10 0 2\n255 1 0 1 50002\n3 0 1 1\n"));
  for (const bool is_big_endian : {false, true}) {
    Bytes bytes;
    for (const bool is_second : {false, true}) {
      add(bytes, 255, 1);
      add_number(bytes, is_second ? 1.0 : 0.0, is_big_endian);
      add_number(bytes, is_second ? 0.F : 10.F, is_big_endian);
      add_number(bytes, is_second ? 1.F : 0.F, is_big_endian);
      Bytes time;
      add(time, is_second ? 50'002 : 2, 4);
      if (is_big_endian) {
        std::ranges::reverse(time);
      }
      bytes.insert(bytes.end(), time.begin(), time.end());
    }
    expect_both(ply(head(is_big_endian ? "binary_big_endian" : "binary_little_endian"), bytes));
  }
}

// As PCL writes it behind the points: where the unit was, its axes, and numbers of the camera.
TEST_F(PlyFile, APoseOfItsCameraIsTold) {
  const auto viewpoint_of = [&](bool is_ascii, const std::vector<double>& pose) {
    std::string words = std::string("ply\nformat ") +
                        (is_ascii ? "ascii" : "binary_little_endian") +
                        " 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                        "element camera 1\n";
    for (const char* const name :
         {"view_px", "view_py", "view_pz", "x_axisx", "x_axisy", "x_axisz", "y_axisx", "y_axisy",
          "y_axisz", "z_axisx", "z_axisy", "z_axisz", "k1"}) {
      words += std::string("property float ") + name + '\n';
    }
    words += "end_header\n";
    Bytes bytes;
    std::string row = "1 2\n";
    add(bytes, 1.F);
    add(bytes, 2.F);
    for (const double number : pose) {
      add(bytes, static_cast<float>(number));
      row += std::to_string(number) + ' ';
    }
    return is_ascii ? ply(words + row).viewpoint : ply(words, bytes).viewpoint;
  };
  for (const bool is_ascii : {true, false}) {
    EXPECT_EQ(viewpoint_of(is_ascii, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 5}), "");
    EXPECT_EQ(viewpoint_of(is_ascii, {10, -2, 1.5, 1, 0, 0, 0, 1, 0, 0, 0, 1, 5}),
              "camera 10 -2 1.5 1 0 0 0 1 0 0 0 1");
    EXPECT_EQ(viewpoint_of(is_ascii, {0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 1, 5}),
              "camera 0 0 0 0 1 0 -1 0 0 0 0 1");
    EXPECT_EQ(viewpoint_of(is_ascii, {}), "") << "the file ends before it";
  }
}

TEST_F(PlyFile, NothingOfItsCameraOrBehindItRefusesACloud) {
  const std::string words =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "element camera 1\n";
  std::string pose;
  for (const char* const name :
       {"view_px", "view_py", "view_pz", "x_axisx", "x_axisy", "x_axisz", "y_axisx", "y_axisy",
        "y_axisz", "z_axisx", "z_axisy", "z_axisz"}) {
    pose += std::string("property float ") + name + '\n';
  }
  const std::string faces = "element face 1\nproperty list uchar int vertex_index\n";
  const auto viewpoint_of = [&](const std::string& head, const std::string& rows) {
    const SeenCloud cloud = ply(words + head + "end_header\n1 2\n" + rows);
    EXPECT_EQ(cloud.points.size(), 1U) << head << rows;
    return cloud.viewpoint;
  };
  EXPECT_EQ(viewpoint_of(pose + faces, "0 0 9 1 0 0 0 1 0 0 0 1\n3 0 0 0\n"),
            "camera 0 0 9 1 0 0 0 1 0 0 0 1");
  for (const char* const row : {"0 0 9 1 0 0\n0 1 0 0 0 1\n", "a\n", ""}) {
    EXPECT_EQ(viewpoint_of(pose, row), "") << row;
  }
  for (const char* const more :
       {"property half k\n", "property list uchar int k\n", "property\n"}) {
    EXPECT_EQ(viewpoint_of(pose + more, "0 0 9 1 0 0 0 1 0 0 0 1 1 1\n"), "") << more;
  }
}

TEST_F(PlyFile, TellsWhatIsWrong) {
  EXPECT_EQ(told_of("solid\n"), ": this is no PLY file: its head has no end_header");
  EXPECT_EQ(told_of("ply\nformat ascii 1.0\n"),
            ": this is no PLY file: its head has no end_header");
  EXPECT_EQ(told_of("ply\nelement face 1\n"), ": its first element is face, not vertex");
  EXPECT_EQ(told_of("ply\nelement vertex 1\nproperty list uchar int x\n"),
            ": its points have a property that is a list, which is not read");
  EXPECT_EQ(told_of(head("binary_middle_endian")),
            ": its format is binary_middle_endian; use ascii, binary_little_endian, "
            "binary_big_endian");
  EXPECT_EQ(told_of(head("ascii") + "255 0 10 0"), ":13: 4 numbers instead of 5");
  EXPECT_EQ(told_of(head("ascii") + "255 0 10 0 2\n3 0 1 1\n"), ":14: 4 numbers instead of 5");
  EXPECT_EQ(told_of(head("ascii") + "255 0 10 0 2\n"), ": it ends before its 2 points");
  const std::string flat = "\nproperty float x\nproperty float y\nend_header\n";
  EXPECT_EQ(told_of("ply\nformat ascii 1.0\nelement vertex 1" + flat + "1 2\n1 2\n"),
            ": it has more rows than its 1 points");
  EXPECT_EQ(told_of("ply\nformat binary_little_endian 1.0\nelement vertex 1" + flat +
                    "one pointanother."),
            ": it has more bytes than its 1 points");
  EXPECT_EQ(told_of("ply\nformat ascii 1.0\nelement vertex 1" + flat + "1 2,5\n"),
            ":7: '2,5' is not a number");
  EXPECT_EQ(told_of("ply\nformat ascii 1.0\nelement vertex 1e3" + flat),
            ": in its head '1e3' is not a whole number, or is too large");
  EXPECT_EQ(told_of(head("binary_big_endian")), ": it ends before its 2 points");
  EXPECT_EQ(told_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"),
            ": its points have no field y");
  EXPECT_EQ(told_of("ply\nformat ascii 1.0\nelement vertex 10000000\nproperty float x\n"
                    "property float y\nend_header\n1\n"),
            ": 10000000 points; no unit sees more than 1000000 in a scan");
}

}  // namespace
}  // namespace iog::tools
