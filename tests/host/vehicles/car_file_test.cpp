// The files of cars: what becomes of them, and by what a car is known.
#include "tools/vehicles/car_file.hpp"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "car_block/content.hpp"
#include "tools/program/exit_status.hpp"
#include "vehicles/cars.hpp"

namespace iog::tools {
namespace {

using Lines = std::vector<std::string>;

Lines files_in(const std::string& folder) {
  Lines files;
  for (const auto& entry : std::filesystem::directory_iterator(IOG_SOURCE_DIR + ("/" + folder))) {
    if (entry.path().extension() == ".toml") {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

// What the program makes of a file is what the firmware reads of the block that the build has made.
TEST(CarFile, EachCarIsThatOfItsBlock) {
  const Lines files = files_in("vehicles");
  EXPECT_EQ(files.size(), vehicles::cars().size());
  for (const std::string& path : files) {
    const Car car = read_car(path);
    const vehicle::Vehicle& block = vehicles::car(car.description.name).vehicle;
    EXPECT_EQ(car.vehicle.id, block.id) << path;
    EXPECT_EQ(car_block::identity_of(block), block.id) << path;
    ASSERT_EQ(car.tables.size(), block.sensors.size()) << path;
    for (std::size_t i = 0; i < car.tables.size(); ++i) {
      const vehicle::Sensor& made = car.tables[i];
      const vehicle::Sensor& read = block.sensors[i];
      EXPECT_EQ(read.profile, made.profile) << path;
      EXPECT_EQ(read.sines.sine(1), made.sines.sine(1)) << path;
      EXPECT_EQ(read.on_car_x.low, made.on_car_x.low) << path;
      EXPECT_EQ(read.in_band.high, made.in_band.high) << path;
    }
  }
}

// Table 4.3 of the thesis, by nearest: cells k - 4 to k + 2. By blurring: descriptions_test.cpp.
TEST(CarFile, TheNearestIndexesAreThoseOfTheThesis) {
  const Car car = parse_car(R"(name = "nearest"
quantisation = "nearest"
z_min_m = 0.2
z_max_m = 2.2
footprint = { x_min_m = -2, x_max_m = 2, y_min_m = -1, y_max_m = 1 }
[[sensors]]
name = "lux"
type = "ibeo_lux"
udp_port = 12002
mount = { x_m = 2, y_m = 0, z_m = 0.5 }
max_points_per_scan = 2412
)",
                            "nearest.toml");
  std::vector<int> indexes;
  for (int offset = -4; offset <= 2; ++offset) {
    indexes.push_back(car.tables[0].profile.at(offset));
  }
  EXPECT_EQ(indexes, (std::vector{-15, -15, -7, 0, 2, 1, 0}));
}

// A byte of the description more or less is another car.
TEST(CarFile, AnyChangeIsAnotherIdentity) {
  const Car car = read_car(IOG_SOURCE_DIR "/vehicles/reference_car.toml");
  const auto changed = [&](auto&& change) {
    std::vector<vehicle::Sensor> sensors = car.tables;
    vehicle::Vehicle other = car.vehicle;
    other.sensors = sensors;
    change(other, sensors);
    return car_block::identity_of(other);
  };
  EXPECT_EQ(changed([](auto&, auto&) {}), car.vehicle.id);
  EXPECT_NE(changed([](auto& other, auto&) { other.name = "reference_cat"; }), car.vehicle.id);
  EXPECT_NE(changed([](auto& other, auto&) { ++other.z_max; }), car.vehicle.id);
  EXPECT_NE(changed([](auto&, auto& sensors) { ++sensors[3].layers[3].z.left; }), car.vehicle.id);
  EXPECT_NE(changed([](auto&, auto& sensors) { sensors[0].profile.hit = 3; }), car.vehicle.id);
  EXPECT_NE(changed([](auto&, auto& sensors) { sensors[1].is_synchronised = false; }),
            car.vehicle.id);
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) {
    all += text;
  }
  return all;
}

// Line 2 and what follows; the last line is nested deeper than the parser of TOML has stack for.
TEST(CarFile, NestingIsBounded) {
  const std::string dotted = repeated("a.", 20'000) + "a";
  const std::string quoted = repeated(R"("a.b" . 'c' .)", 20'000) + "a = 1";
  const std::string in_arrays = repeated("[", 20'000) + repeated("]", 20'000);
  const std::string in_tables = repeated("{a=", 20'000) + "1" + repeated("}", 20'000);
  const std::string mixed = repeated("{a.b.c.d=[", 200) + "1" + repeated("]}", 200);
  for (const std::string& lines :
       {dotted + " = 1", quoted, '[' + dotted + ']', "[[" + dotted + "]]", "a = " + in_arrays,
        "a = " + in_tables, "a = " + mixed, "a = {" + dotted + " = 1}",
        "a = \"\\\"\"\n" + dotted + " = 1", "a = \"\"\"\"\n\"\"\"\"\"\n" + dotted + " = 1",
        "a = '\\' # '\n" + dotted + " = 1", "a = '''\n#'''''\n" + dotted + " = 1"}) {
    try {
      static_cast<void>(parse_car("name = \"deep\"\n" + lines, "deep.toml"));
      ADD_FAILURE() << lines.substr(0, 20);
    } catch (const UsageError& error) {
      EXPECT_EQ(error.what(),
                "deep.toml:" + std::to_string(2 + std::ranges::count(lines, '\n')) +
                    ": nested too deep: 8 parts of a key and 8 open brackets are the most")
          << lines.substr(0, 20);
    }
  }
}

// Points and brackets in comments and strings, many numbers, brackets one behind another.
TEST(CarFile, WhatOnlyLooksDeepIsRead) {
  const std::string comment = " # \"" + repeated("a.[{", 100) + '\n';
  const Car car = parse_car("name = 'flat'" + comment + R"(z_min_m = 0.2
z_max_m = 2.2
footprint = { x_min_m = -2.0, x_max_m = 2.0, y_min_m = -1.0, y_max_m = 1.0 }
poses = { }
network = { address = "10.0.2.15", peer = '10.0.2.2' }
[[sensors]]
name = """front"""
type = "ibeo_lux"
udp_port = 12002
max_points_per_scan = 2412
mount = { x_m = 2.0, y_m = 0.0, z_m = 0.5, yaw_deg = 0.0, pitch_deg = 0.0, roll_deg = 0.0 }
)" + comment,
                            "flat.toml");
  EXPECT_EQ(car.sensors.size(), 1U);
}

}  // namespace
}  // namespace iog::tools
