#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/formats/picture/class_picture.hpp"
#include "tools/formats/picture/frame_writer.hpp"
#include "tools/formats/picture/grid_picture.hpp"
#include "tools/formats/picture/ros_map.hpp"
#include "tools/info/file_summary.hpp"
#include "tools/program/file.hpp"
#include "tools/program/table.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

std::string text_of(const std::string& path) {
  const auto bytes = read_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// ROS map_server: row 0 is the row of highest y; 0 occupied, 254 free, 205 unknown.
TEST(RosMap, FilesAreExact) {
  const std::vector<index::OccupancyIndex> cells{-127, -1,  0,  // lowest y
                                                 1,    127, 0, 0, 0, 2};
  const tests::TemporaryFolder folder;
  const RosMap map{.cells = cells, .grid = {.columns = 3, .rows = 3}};
  write_ros_map(folder.path(), "iog_map", map);
  const std::string pgm = text_of(folder / "iog_map.pgm");
  EXPECT_EQ(pgm, std::string("P5\n3 3\n255\n") + "\xCD\xCD" + std::string(2, '\0') +
                     std::string(1, '\0') + "\xCD" + "\xFE\xFE\xCD");
  EXPECT_EQ(text_of(folder / "iog_map.yaml"),
            "image: iog_map.pgm\n"
            "mode: trinary\n"
            "resolution: 0.1\n"
            "origin: [-51.2, -51.2, 0.0]\n"
            "negate: 0\n"
            "occupied_thresh: 0.65\n"
            "free_thresh: 0.196\n");
}

// Of 5 cm, ahead of the car: 2 columns and 3 rows, of which one is to its right.
TEST(RosMap, IsOfTheGridOfTheCar) {
  const geometry::Grid grid{
      .cell_mm = 50, .columns = 2, .rows = 3, .origin_column = 0, .origin_row = 1};
  const RosMap map{.cells = {1, -1, 0, 0, 0, 2}, .grid = grid};
  EXPECT_EQ(ros_map_pixels(map), (std::vector<std::uint8_t>{205, 0, 205, 205, 0, 254}));
  const std::string yaml = ros_map_yaml("map.pgm", map);
  EXPECT_NE(yaml.find("resolution: 0.05\norigin: [0.00, -0.05, 0.0]\n"), std::string::npos) << yaml;
}

// map_server computes p = (255 - pixel) / 255 and compares with its two thresholds.
TEST(RosMap, ThresholdsGiveBackTheClasses) {
  for (int index = -127; index <= 127; ++index) {
    const auto its = static_cast<index::OccupancyIndex>(index);
    const double p =
        (255 - ros_map_pixels({.cells = {its}, .grid = {.columns = 1, .rows = 1}})[0]) / 255.0;
    EXPECT_EQ(p > 0.65, index > 0);
    EXPECT_EQ(p < 0.196, index < 0);
  }
}

GridFrame numbered_frame(std::uint64_t number) {
  GridFrame frame;
  frame.header.complete_sensors = 1;  // evidence
  frame.evidence_number = number;
  return frame;
}

void write_pictures(const std::string& folder, std::uint64_t frames) {
  FrameWriter writer({.folder = folder, .every = 1, .scale = {}});
  for (std::uint64_t number = 0; number < frames; ++number) {
    writer.offer(numbered_frame(number));
  }
  writer.write_last(numbered_frame(frames - 1));
}

// A film is made of frame_*.png: the end of a longer run before must not be its end, too.
TEST(FrameWriter, AFolderHoldsThePicturesOfOneRun) {
  const tests::TemporaryFolder folder;
  const std::array<std::string, 3> others{"frame_1.png", "frame_000001.png.txt", "my_frame.png"};
  for (const std::string& name : others) {
    OutputFile file(folder / name);
    file.write("mine");
    file.finish();
  }
  write_pictures(folder.path(), 3);
  EXPECT_TRUE(std::filesystem::exists(folder / "frame_000002.png"));
  write_pictures(folder.path(), 2);
  EXPECT_TRUE(std::filesystem::exists(folder / "frame_000001.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "frame_000002.png"));
  for (const std::string& name : others) {
    EXPECT_EQ(text_of(folder / name), "mine");
  }
}

TEST(GridPicture, ForwardIsUpAndLeftIsLeft) {
  GridFrame frame;
  const Canvas empty = picture_of(frame, {});
  ASSERT_EQ(empty.width(), 1024);
  const auto drawn_at = [&](std::size_t cell_x, std::size_t cell_y, int column, int row) {
    frame.cells.assign(geometry::kCellCount, index::kUnknown);
    frame.cells[cell_y * geometry::kCellsPerSide + cell_x] = 127;
    const Canvas picture = picture_of(frame, {});
    return !(picture.at(column, row) == empty.at(column, row));
  };
  EXPECT_TRUE(drawn_at(800, 512, 511, 223));  // ahead
  EXPECT_TRUE(drawn_at(512, 800, 223, 511));  // to the left
  EXPECT_TRUE(drawn_at(200, 300, 723, 823));  // behind, to the right
}

// One pixel of 1024 is not seen, whatever its colour.
TEST(GridPicture, AHitIsSeenAmongFreeCells) {
  GridFrame frame;
  frame.cells.assign(geometry::kCellCount, -56);
  frame.cells[300 * geometry::kCellsPerSide + 700] = 10;
  const auto hit_pixels = [&](int scale) {
    const Canvas picture = picture_of(frame, {.pixels_per_cell = scale});
    int count = 0;
    for (int row = -6; row <= 6; ++row) {
      for (int column = -6; column <= 6; ++column) {
        const bool is_hit = picture.at((1023 - 300) * scale + column, (1023 - 700) * scale + row) ==
                            colour_of_index(10);
        count += is_hit ? 1 : 0;
      }
    }
    return count;
  };
  EXPECT_EQ(hit_pixels(1), 9);
  EXPECT_EQ(hit_pixels(2), 9);
  EXPECT_EQ(hit_pixels(3), 9);
  EXPECT_EQ(hit_pixels(4), 16);
}

// 102.4 m to both ends and 25.6 m to the sides: no ring from 40 m on crosses a diagonal.
TEST(GridPicture, EachRingOfALongPictureHasItsDistance) {
  GridFrame frame;
  frame.shape = {.columns = 2048, .rows = 512, .origin_column = 1024, .origin_row = 256};
  frame.cells.assign(std::size_t{2048} * 512, -56);
  const Canvas picture = picture_of(frame, {.pixels_per_cell = 1});
  ASSERT_EQ(picture.width(), 512);
  ASSERT_EQ(picture.height(), 2048);
  for (int radius = 40; radius <= 100; radius += 10) {
    const double aside_m = 24;  // to the right, where the ring is before the border
    const int row = 1024 + static_cast<int>(10 * std::sqrt(radius * radius - aside_m * aside_m));
    for (int column = 256 + 240 - 8; column <= 256 + 240 + 8; ++column) {
      EXPECT_FALSE(picture.at(column, row) == colour_of_index(-56)) << radius << " " << column;
    }
  }
}

// A label has its own dark ground: nothing of the free cells below is left between its letters.
TEST(GridPicture, DistancesCanBeReadOverFreeGround) {
  GridFrame frame;
  frame.cells.assign(geometry::kCellCount, -56);
  const Canvas picture = picture_of(frame, {});
  const int place = 512 + 212;  // 30 m behind the car, to the right: 300 * sqrt(1/2)
  for (int column = place - 15; column <= place + 15; ++column) {
    EXPECT_FALSE(picture.at(column, place) == colour_of_index(-56)) << column;
  }
  EXPECT_TRUE(picture.at(place, place + 20) == colour_of_index(-56));
}

TEST(GridPicture, SensorsAreToldInWords) {
  stream::Header header{};
  header.sensor_count = 4;
  header.complete_sensors = 0b1111;
  EXPECT_EQ(words_of_sensors(header), "4 of 4 sensors complete");
  header.complete_sensors = 0b0011;
  header.partial_sensors = 0b0100;
  EXPECT_EQ(words_of_sensors(header), "2 of 4 sensors complete, sensor 2 partial, sensor 3 silent");
}

TEST(GridPicture, CanBeCroppedAndEnlarged) {
  const Canvas picture = picture_of(GridFrame{}, {.pixels_per_cell = 3, .radius_m = 20});
  EXPECT_EQ(picture.width(), 1200);
  EXPECT_EQ(picture.height(), 1200);
}

// Of each grid that a car may have: all of it, if nothing is asked, as large as 1024 pixels hold.
TEST(GridPicture, EachGridIsShownAsLargeAsItFits) {
  constexpr PictureScale kFitting{.pixels_per_cell = 0};
  GridFrame frame;
  for (const std::uint16_t cell_mm : geometry::kCellSizesMm) {
    frame.shape = {.cell_mm = cell_mm};
    EXPECT_EQ(picture_of(frame, kFitting).width(), 1024) << cell_mm;
  }
  const Canvas near = picture_of(frame, {.pixels_per_cell = 0, .radius_m = 60});
  EXPECT_EQ(near.width(), 4 * 240);  // 240 cells of 0.5 m
  frame.shape = {.columns = 512, .rows = 320, .origin_column = 0, .origin_row = 160};
  const Canvas ahead = picture_of(frame, kFitting);
  EXPECT_EQ(ahead.width(), 2 * 320);
  EXPECT_EQ(ahead.height(), 2 * 512);
}

// Rings of 10 m would be 20 pixels apart in cells of 0.5 m, and their numbers over each other.
TEST(GridPicture, RingsAreAsFarApartAsTheirNumbersNeed) {
  GridFrame frame;
  const auto is_ring = [&](int cell_mm, int metres) {
    frame.shape.cell_mm = static_cast<std::uint16_t>(cell_mm);
    const Canvas picture = picture_of(frame, {});
    return !(picture.at(512, 512 - metres * 1000 / cell_mm) == colour_of_index(0));
  };
  EXPECT_TRUE(is_ring(100, 10) && is_ring(100, 50));
  EXPECT_TRUE(is_ring(200, 10) && is_ring(200, 90));
  EXPECT_FALSE(is_ring(500, 10) || is_ring(500, 90));
  EXPECT_TRUE(is_ring(500, 20) && is_ring(500, 240));
}

TEST(Canvas, IgnoresWhatLiesOutside) {
  Canvas canvas(10, 10, {});
  canvas.line(-100, -100, 100, 100, {255, 255, 255});
  canvas.circle(5, 5, 50, {255, 0, 0});
  canvas.text(-3, 8, "edge", {0, 255, 0});
  canvas.fill(8, 8, 100, 100, {1, 2, 3});
  EXPECT_EQ(canvas.at(9, 9), (Colour{1, 2, 3}));
}

TEST(Canvas, SpellsEachCopyrightSign) {
  const auto picture = [](std::string_view words) {
    Canvas canvas(80, 9, {});
    canvas.text(1, 1, words, {0, 255, 0});
    std::vector<std::uint8_t> green;
    green.reserve(static_cast<std::size_t>(canvas.width()) *
                  static_cast<std::size_t>(canvas.height()));
    for (int i = 0; i < canvas.width() * canvas.height(); ++i) {
      green.push_back(canvas.at(i % canvas.width(), i / canvas.width()).green);
    }
    return green;
  };
  EXPECT_EQ(picture("\u00A9 A, \u00A9 B"), picture("(C) A, (C) B"));
  EXPECT_NE(picture("\u00A9"), picture(""));
  EXPECT_EQ(Canvas::text_width("\u00A9 A"), Canvas::text_width("(C) A"));
}

// Cell (i, j) of the window lies i to the right and j up; a mover is drawn three pixels wide.
TEST(ClassPicture, ACellIsWhereItIsInTheWorld) {
  ClassGrid classes;
  const std::int8_t free = 3 * 8 + 7;
  const std::int8_t moving = 4 * 8 + 5;
  classes.cells[500 * 1024 + 600] = free;
  classes.cells[700 * 1024 + 300] = moving;
  const Canvas picture = picture_of(classes, {}, PictureScale{});
  ASSERT_EQ(picture.width(), 1020);  // 51 m around the middle
  EXPECT_EQ(picture.at(598, 1020 - 1 - 498), colour_of_class(free));
  for (const int aside : {-1, 0, 1}) {
    EXPECT_EQ(picture.at(298 + aside, 1020 - 1 - 698), colour_of_class(moving));
  }
  EXPECT_EQ(picture.at(598, 498), colour_of_class(0));
}

// A window of 205 or 512 m is shown to its end, and a part of it as large as 1024 pixels hold.
TEST(ClassPicture, EachWindowIsShownAsLargeAsItFits) {
  ClassGrid classes;
  const std::int8_t standing = 6 * 8 + 7;
  classes.cells[900 * 1024 + 20] = standing;
  for (const int cell_mm : {100, 200, 500}) {
    classes.cell_mm = static_cast<std::uint16_t>(cell_mm);
    const Canvas picture = picture_of(classes, {}, {.pixels_per_cell = 0});
    ASSERT_EQ(picture.width(), 1020) << cell_mm;
    EXPECT_EQ(picture.at(18, 1020 - 1 - 898), colour_of_class(standing)) << cell_mm;
  }
  EXPECT_EQ(picture_of(classes, {}, {.pixels_per_cell = 0, .radius_m = 60}).width(), 4 * 240);
}

// One pixel of a wall is not seen among free cells. What moves lies over what stands.
TEST(ClassPicture, AWallIsSeenAmongFreeCells) {
  const std::int8_t free = 3 * 8 + 7;
  const std::int8_t moving = 4 * 8 + 7;
  for (const int standing : {5, 6, 7, 8}) {
    ClassGrid classes;
    classes.cells.assign(geometry::kCellCount, free);
    const auto wall = static_cast<std::int8_t>(standing * 8 + 7);
    classes.cells[500 * 1024 + 600] = wall;
    classes.cells[500 * 1024 + 603] = moving;
    for (const int scale : {1, 2, 3}) {
      const Canvas picture = picture_of(classes, {}, PictureScale{.pixels_per_cell = scale});
      const int row = (1020 - 1 - 498) * scale;
      for (int aside = 0; aside < 3; ++aside) {
        const int first = 598 * scale - (3 - scale) / 2;
        EXPECT_EQ(picture.at(first + aside, row), colour_of_class(wall)) << standing << scale;
      }
      EXPECT_EQ(picture.at(601 * scale, row), colour_of_class(moving)) << standing << scale;
    }
  }
}

TEST(FrameTitle, SaysNumberTimeAndCar) {
  EXPECT_EQ(words_of(FrameTitle{.number = 50, .closed_us = 2'071'999}), "frame 50, 2.071 s");
  EXPECT_EQ(words_of({.number = 0, .closed_us = 5'000, .vehicle_id = 0x01FFB0CD}),
            "frame 0, 0.005 s, reference_car");
}

// reference_car is 4.1 m long; of a car of nobody's an arrow of 4 m is drawn. Both look to the left
// (a quarter of a turn), that is up.
TEST(ClassPicture, TheCarHasItsOutline) {
  ClassGrid classes;
  classes.window = {.pose = {.x_mm = 20'000, .y_mm = 30'000, .heading = 0x40000000},
                    .sigma = {20, 30},
                    .slices = 1};
  const auto& body = vehicle_of_id(0x01FFB0CD)->description->footprint;
  const auto is_drawn = [&](const Canvas& picture, double ahead_m, double left_m) {
    const int column = static_cast<int>(std::floor(250 - left_m * 50));
    const int row = static_cast<int>(std::floor(250 - ahead_m * 50));
    return picture.at(column, row) == Colour{250, 250, 250};
  };
  const PictureScale scale{.pixels_per_cell = 5, .radius_m = 5};
  const Canvas known = picture_of(classes, {.vehicle_id = 0x01FFB0CD}, scale);
  ASSERT_EQ(known.width(), 500);
  const double length = body.x_max_m - body.x_min_m;
  const double width = body.y_max_m - body.y_min_m;
  for (const double share : {0.06, 0.5, 0.94}) {
    const bool is_nose = share == 0.5;
    EXPECT_EQ(is_drawn(known, body.x_max_m - 0.02, body.y_min_m + share * width), !is_nose);
    EXPECT_TRUE(is_drawn(known, body.x_min_m + 0.2 * length, body.y_min_m + share * width));
    EXPECT_FALSE(is_drawn(known, body.x_max_m + 0.06, body.y_min_m + share * width));
    EXPECT_FALSE(is_drawn(known, body.x_min_m - 0.06, body.y_min_m + share * width));
  }
  const Canvas arrow = picture_of(classes, {}, scale);
  EXPECT_TRUE(is_drawn(arrow, 2, 0) && is_drawn(arrow, -2, 0.5));
  EXPECT_FALSE(is_drawn(arrow, 1, 0.9) || is_drawn(arrow, 2, 0.5));
}

// The bar is as long as it says: 20 m of 102, 10 m of 40, 2 m of 10; and a quarter at most.
TEST(ClassPicture, ItsBarHasALength) {
  struct Example {
    PictureScale scale;
    int metres;
  };
  for (const Example& example : {Example{{.radius_m = 51}, 20}, Example{{.radius_m = 20}, 10},
                                 Example{{.pixels_per_cell = 4, .radius_m = 5}, 2}}) {
    const Canvas picture = picture_of(ClassGrid{}, {}, example.scale);
    int length = 0;
    for (int column = 0; column < picture.width(); ++column) {
      const bool is_bar = picture.at(column, picture.height() - 11) == Colour{235, 235, 230};
      length += is_bar && column > picture.width() / 2 ? 1 : 0;
    }
    EXPECT_EQ(length, example.metres * 10 * example.scale.pixels_per_cell);
  }
}

// A picture of 20 m a side around the car, which is near the window's corner at (-3.2, 6.4) m.
TEST(ClassPicture, TheCarIsInTheMiddle) {
  ClassGrid classes;
  classes.window = {.corner_a = -1,
                    .corner_b = 2,
                    .pose = {.x_mm = 20'000, .y_mm = 30'000, .heading = 0},
                    .sigma = {20, 30},
                    .slices = 1};
  const std::int8_t moving = 4 * 8 + 7;
  // At (25, 35) m: 28.2 m and 28.6 m from the corner; 15 m from the picture's.
  classes.cells[286 * 1024 + 282] = moving;
  const Canvas picture = picture_of(classes, {}, PictureScale{.radius_m = 10});
  ASSERT_EQ(picture.width(), 200);
  EXPECT_EQ(picture.at(150, 200 - 1 - 150), colour_of_class(moving));
}

// Where the car is is not known though something was placed: all of the window, and no car.
TEST(ClassPicture, ACarWhosePoseIsNotKnownIsNowhere) {
  ClassGrid classes;
  const Canvas nowhere = picture_of(classes, {}, PictureScale{});
  classes.window = {.slices = 1};
  const Canvas unknown = picture_of(classes, {}, PictureScale{});
  for (int row = 0; row < nowhere.height(); ++row) {
    for (int column = 0; column < nowhere.width(); ++column) {
      ASSERT_EQ(unknown.at(column, row), nowhere.at(column, row)) << column << " " << row;
    }
  }
}

TEST(FrameWriter, AFrameWithClassesHasTwoPictures) {
  const tests::TemporaryFolder folder;
  FrameWriter writer({.folder = folder.path(), .every = 1, .scale = {}});
  GridFrame frame;
  frame.header.complete_sensors = 1;
  writer.offer(frame);
  frame.evidence_number = 1;
  frame.classes.emplace();
  writer.offer(frame);
  frame.evidence_number = 2;
  frame.header.flags = stream::kFlagClasses | stream::kFlagNoIndexes;
  writer.write_last(frame);
  const auto exists = [&](const char* name) { return std::filesystem::exists(folder / name); };
  EXPECT_TRUE(exists("frame_000000.png") && !exists("classes_000000.png"));
  EXPECT_TRUE(exists("frame_000001.png") && exists("classes_000001.png"));
  EXPECT_TRUE(!exists("frame_000002.png") && exists("classes_000002.png"));
  EXPECT_FALSE(exists("map.pgm")) << "there are no indexes to map";
  EXPECT_EQ(summary_of_file(folder.path()),
            row("kind", "folder: 2 pictures, 2 pictures of classes"));
}

}  // namespace
}  // namespace iog::tools
