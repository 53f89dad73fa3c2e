#include "tools/simulate/truth/point_truth_file.hpp"

#include <filesystem>
#include <vector>

#include "gtest/gtest.h"

namespace iog::tools {
namespace {

TEST(PointTruthFile, HasARowForEachPointThatIsThere) {
  const std::string path = testing::TempDir() + "point_truth_file_test.csv";
  SimulatedPacket packet;
  packet.datagram.time_us = 1'714'564'802'000'000U;
  packet.datagram.destination.port = 2368;
  packet.points = {{PointClass::kGround, 0, {12.3456, -3.0004, -0.1}, 0},
                   {},
                   {.what = PointClass::kClutter},
                   {PointClass::kMoving, 1'000'003, {-5, 0, 7.25}, 1.1996},
                   {PointClass::kInfrastructure, 17, {0, 0, 0}, -0.02}};
  PointTruthFile file(path);
  file.write(3, std::vector{packet});
  file.finish();
  const std::vector<std::string> lines = read_lines(path);
  std::filesystem::remove(path);
  const std::string packet_columns = "3,1714564802000000,2368,";
  EXPECT_EQ(lines, (std::vector<std::string>{
                       "frame,time_us,port,point,class,thing,x_mm,y_mm,z_mm,height_mm",
                       packet_columns + "0,ground,0,12346,-3000,-100,0",
                       packet_columns + "2,clutter,0,,,,",
                       packet_columns + "3,moving,1000003,-5000,0,7250,1200",
                       packet_columns + "4,infrastructure,17,0,0,0,-20"}));
}

}  // namespace
}  // namespace iog::tools
