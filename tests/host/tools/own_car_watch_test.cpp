// Frames of a VLP-16's car, 4.4 m by 1.8 m, that hits something in the same place of its grid.
#include "tools/receive/own_car_watch.hpp"

#include <functional>
#include <string>

#include "gtest/gtest.h"

namespace iog::tools {
namespace {

// Whether something is hit at x and y, in metres from the middle of the car.
using Hits = std::function<bool(double, double)>;

std::string told(const Hits& hits, std::int32_t step_mm = 600, int missing_of_ten = 0) {
  OwnCarWatch watch(find_vehicle("roof_vlp16"));
  for (int i = 0; i < 50; ++i) {
    GridFrame frame;
    ClassGrid& classes = frame.classes.emplace();
    classes.window.slices = 1;
    classes.window.sigma = {.position_mm = 20, .heading_10urad = 100};
    classes.window.pose.x_mm = i * step_mm;
    for (std::int32_t y = 450; y < 574 && i % 10 >= missing_of_ten; ++y) {
      for (std::int32_t x = 450; x < 574; ++x) {
        const bool is_hit = hits((x - 511.5) / 10, (y - 511.5) / 10);
        frame.cells[static_cast<std::size_t>(geometry::number_of({x, y}))] = is_hit ? 3 : -3;
      }
    }
    watch.add(frame);
  }
  return watch.row_of_footprint();
}

bool mirror(double x, double y) { return x > 0.8 && x < 1 && y > 0.9 && y < 1.2; }

TEST(OwnCarWatch, TellsWhatStaysBesideTheCar) {
  const std::string words = told(mirror);
  EXPECT_NE(words.find("FOOTPRINT?"), std::string::npos);
  EXPECT_NE(words.find("x 0.8 to 1.1 m"), std::string::npos) << words;
  EXPECT_NE(told(mirror, 600, 1), "");
}

TEST(OwnCarWatch, IsSilentAboutTheWorld) {
  EXPECT_EQ(told(mirror, 10), "") << "the car has not moved";
  EXPECT_EQ(told(mirror, 600, 3), "") << "not always there";
  EXPECT_EQ(told([](double /*x*/, double y) { return y > 1.5 && y < 1.7; }), "") << "a wall";
  EXPECT_EQ(told([](double x, double y) { return x > 4 && x < 4.2 && y < 0.5 && y > 0; }), "")
      << "a car ahead";
  EXPECT_EQ(told([](double /*x*/, double /*y*/) { return false; }), "");
}

}  // namespace
}  // namespace iog::tools
