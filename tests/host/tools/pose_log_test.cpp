// Logs of poses as text. KITTI's fields are written by their numbers.
#include "tools/poses/pose_log.hpp"

#include <cmath>
#include <filesystem>
#include <functional>

#include "gtest/gtest.h"

#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

const double kDegree = std::acos(-1.0) / 180;

std::string scratch(const std::string& name) {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  return testing::TempDir() + test->test_suite_name() + '_' + test->name() + '_' + name;
}

void write_text(const std::string& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.finish();
}

PoseLog csv_log(std::string_view text) {
  const std::string path = scratch("log.csv");
  write_text(path, text);
  return read_csv_log(path);
}

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(TextFields, AreWholeOrNothing) {
  EXPECT_EQ(number_in("-1.5e2"), -150);
  EXPECT_EQ(whole_number_in("007"), 7U);
  EXPECT_EQ(microseconds_in("12.3456789"), 12'345'678U);
  EXPECT_EQ(microseconds_in("1714564800.000001"), 1'714'564'800'000'001U);
  EXPECT_EQ(microseconds_in("5"), 5'000'000U);
  for (const std::string_view text : {"", "x", "1x", " 1", "1.2.3", "inf", "nan"}) {
    EXPECT_FALSE(number_in(text)) << text;
    EXPECT_FALSE(microseconds_in(text)) << text;
    EXPECT_FALSE(whole_number_in(text)) << text;
  }
  EXPECT_FALSE(microseconds_in("-1"));
  EXPECT_FALSE(microseconds_in("1234567890123"));
  EXPECT_FALSE(whole_number_in("1234567890"));
}

TEST(TextFields, DaysAreThoseOfTheCalendar) {
  EXPECT_EQ(unix_us_of(1970, 1, 1, 0), 0U);
  EXPECT_EQ(unix_us_of(2024, 5, 1, 43'200'000'000U), 1'714'564'800'000'000U);
  EXPECT_EQ(unix_us_of(2000, 2, 29, 0), 951'782'400'000'000U);
  EXPECT_FALSE(unix_us_of(2001, 2, 29, 0));
  EXPECT_FALSE(unix_us_of(2001, 13, 1, 0));
  EXPECT_FALSE(unix_us_of(1969, 12, 31, 0));
}

TEST(CsvLog, TakesItsColumnsByName) {
  const PoseLog log = csv_log(
      "heading_deg, x_m,y_m,time_s,note,speed_m_s,sigma_m,yaw_rate_deg_s,sigma_heading_deg\r\n"
      "90,1.5,-2,10.25,start,3,0.1,-5,0.5\r\n"
      "\r\n"
      "-180,2,3,10.5,,,,,\r\n");
  ASSERT_EQ(log.poses.size(), 2U);
  const LoggedPose& first = log.poses[0];
  EXPECT_EQ(first.time_us, 10'250'000U);
  EXPECT_EQ(first.x_m, 1.5);
  EXPECT_EQ(first.y_m, -2);
  EXPECT_NEAR(first.heading_rad.value_or(0), 90 * kDegree, 1e-12);
  EXPECT_EQ(first.speed_mps, 3);
  EXPECT_NEAR(first.yaw_rate_rps.value_or(0), -5 * kDegree, 1e-12);
  EXPECT_EQ(first.sigma_m, 0.1);
  EXPECT_NEAR(first.sigma_heading_rad.value_or(0), 0.5 * kDegree, 1e-12);
  EXPECT_FALSE(log.poses[1].speed_mps);
  EXPECT_FALSE(log.poses[1].sigma_m);
  EXPECT_EQ(log.remarks, std::vector<std::string>{"column 'note'"});
}

// As EuRoC and others write them. A comment before a header is none.
TEST(CsvLog, AHeaderOfOthersIsNamed) {
  for (const std::string_view text :
       {"#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m]\n1700000000000000000,0,0\n",
        "#sec,nsec,x,y,z\n1,2,3,4,5\n"}) {
    const std::string error = error_of([&] { static_cast<void>(csv_log(text)); });
    EXPECT_NE(error.find(":1: no column time_s; the first line names the columns, at least "
                         "time_s,x_m,y_m,heading_deg"),
              std::string::npos)
        << error;
  }
  for (const std::string_view text : {"#\n1,2,3,4\n", "1,2,3,4\n"}) {
    EXPECT_NE(error_of([&] { static_cast<void>(csv_log(text)); }).find(":1: no column"),
              std::string::npos);
  }
}

TEST(CsvLog, ABadLineIsNamed) {
  const auto error = [](std::string_view text) {
    return error_of([&] { static_cast<void>(csv_log(text)); });
  };
  constexpr std::string_view kHeader = "time_s,x_m,y_m,heading_deg,sigma_m\n";
  const auto row = [&](std::string_view text) {
    return error(std::string(kHeader) + "1,2,3,4,0.1\n" + std::string(text));
  };
  EXPECT_NE(row("1,2,3\n").find(":3: 3 values for 5 columns"), std::string::npos);
  EXPECT_NE(row("1,2,x,4,0\n").find(":3: y_m is 'x'"), std::string::npos);
  EXPECT_NE(row("-1,2,3,4,0\n").find(":3: time_s is '-1'"), std::string::npos);
  EXPECT_NE(row("1,2,3,,0\n").find(":3: heading_deg is ''"), std::string::npos);
  EXPECT_NE(row("1,2,3,4,-0.1\n").find(":3: sigma_m is negative"), std::string::npos);
  EXPECT_NE(error("time_s,x_m,heading_deg\n").find(":1: no column y_m"), std::string::npos);
  EXPECT_NE(error("time_s,x_m,y_m,heading_deg,x_m\n").find(":1: the column x_m is there twice"),
            std::string::npos);
  EXPECT_NE(error("").find("empty"), std::string::npos);
  EXPECT_EQ(row("1,2,3,4,0.1\n"), "");
}

// The same two rows, as spreadsheets, numpy and people write them.
TEST(CsvLog, TakesWhatSpreadsheetsAndProgramsWrite) {
  const std::string bom = "\xEF\xBB\xBF";
  const std::vector<std::string> texts{
      "# time_s,x_m,y_m,heading_deg\n1.5,0.25,-3,90\n1.6,1,2,180\n",
      "# of Monday\n\ntime_s,x_m,y_m,heading_deg\n1.5,0.25,-3,90\n# the yard\n1.6,1,2,180\n",
      bom + "time_s,x_m,y_m,heading_deg\r\n1.5,0.25,-3,90\r\n1.6,1,2,180\r\n",
      bom + "sep=;\r\ntime_s;x_m;y_m;heading_deg;\r\n1,5;0,25;-3;90;\r\n1,6;1;2;180;\r\n;;;;\r\n",
      "heading_deg\ty_m\tx_m\ttime_s\n90\t-3\t0,25\t1,5\n180\t2\t1\t1,6\n",
      "\"time_s\",\"x_m\",\"y_m\",\"heading_deg\"\n\"1,5\",\"0,25\",\"-3\",90\n1.6,1,2,\"180\"",
      "time_s,x_m,y_m,heading_deg\r1.5,0.25,-3,90\r1.6,1,2,180\r",
      "time_s,x_m,y_m,heading_deg\n1.5e+00,2.5e-1,-3.0E0,9e1\n1.599999999e0,+1e0,2,1.8e2\n"};
  for (const std::string& text : texts) {
    const PoseLog log = csv_log(text);
    ASSERT_EQ(log.poses.size(), 2U) << text;
    EXPECT_EQ(log.poses[0].time_us, 1'500'000U) << text;
    EXPECT_EQ(log.poses[1].time_us, 1'600'000U) << text;
    EXPECT_EQ(log.poses[0].x_m, 0.25) << text;
    EXPECT_EQ(log.poses[0].y_m, -3) << text;
    EXPECT_NEAR(log.poses[1].heading_rad.value_or(0), 180 * kDegree, 1e-12) << text;
  }
  // Of two marks one would be for thousands: nobody knows which.
  for (const std::string_view text :
       {"\xFF\xFEt\0i\0", "time_s;x_m;y_m;heading_deg\n1.234,5;0;0;0\n"}) {
    EXPECT_NE(error_of([&] { static_cast<void>(csv_log(text)); }), "");
  }
  EXPECT_NE(error_of([&] { static_cast<void>(csv_log("\xFF\xFEt")); }).find("UTF-16"),
            std::string::npos);
}

std::string oxts_line(double latitude, double longitude, double yaw) {
  std::string text = std::to_string(latitude) + ' ' + std::to_string(longitude) + " 112.8 0.03 0 ";
  text += std::to_string(yaw) + " -9 4 11.5 0 0";
  for (int field = 11; field < 22; ++field) {
    text += " 0.25";
  }
  return text + " 0.07 0.49 0.05 4 10 4 4 0\n";
}

TEST(OxtsLog, TakesTheFieldsByTheirNumbers) {
  const std::string folder = scratch("oxts");
  make_folder(folder + "/data");
  write_text(folder + "/timestamps.txt",
             "2011-09-26 13:02:25.964389445\n2011-09-26 13:02:26.064394000\n"
             "2011-09-26 13:02:26.164400000\n");
  write_text(folder + "/data/0000000000.txt", oxts_line(49.015003, 8.434297, 1.25));
  write_text(folder + "/data/0000000002.txt", oxts_line(49.015103, 8.434397, 1.5));
  const PoseLog log = read_oxts_log(folder);
  ASSERT_EQ(log.poses.size(), 2U);
  // date -u -d "2011-09-26 13:02:25" +%s
  EXPECT_EQ(log.poses[0].time_us, 1'317'042'145'964'389U);
  EXPECT_EQ(log.poses[1].time_us, 1'317'042'146'164'400U);
  EXPECT_EQ(log.poses[0].x_m, 0);
  EXPECT_EQ(log.poses[0].heading_rad, 1.25);
  EXPECT_EQ(log.poses[0].speed_mps, 11.5);
  EXPECT_EQ(log.poses[0].yaw_rate_rps, 0.07);
  EXPECT_EQ(log.poses[0].sigma_m, 0.05);
  EXPECT_NEAR(log.poses[1].y_m, 11.12, 0.01);  // 1e-4 degrees of latitude
  EXPECT_NEAR(log.poses[1].x_m, 7.31, 0.01);   // and of longitude, at 49 degrees
  EXPECT_EQ(log.remarks, std::vector<std::string>{"1 time without a file in data/"});
  ASSERT_TRUE(log.plane);
  EXPECT_NEAR(log.plane->place_of(49.015003, 8.434297).east_m, 0, 1e-6);

  write_text(folder + "/data/0000000002.txt", "49 8 112\n");
  EXPECT_NE(error_of([&] {
              static_cast<void>(read_oxts_log(folder));
            }).find("0000000002.txt: 3 numbers instead of 30"),
            std::string::npos);
  write_text(folder + "/data/0000000002.txt", "49 east 112\n");
  EXPECT_NE(error_of([&] { static_cast<void>(read_oxts_log(folder)); }).find("field 2 of 30"),
            std::string::npos);
  write_text(folder + "/timestamps.txt", "2011-09-31 13:02:25.964389445\n");
  EXPECT_NE(error_of([&] { static_cast<void>(read_oxts_log(folder)); }).find("timestamps.txt:1:"),
            std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace iog::tools
