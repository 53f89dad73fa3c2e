// The files of cars: what becomes of them, and by what a car is known.
#include "tools/vehicles/car_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

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
Car car_with_window(const std::string& window) {
  return parse_car(
      "name = \"constants\"\nfootprint = { x_min_m = -2, x_max_m = 2, y_min_m = -1, "
      "y_max_m = 1 }\nwindow = {" +
          window +
          "}\n[[sensors]]\nname = \"roof\"\ntype = \"velodyne_vlp16\"\n"
          "mount = { x_m = 0, y_m = 0, z_m = 1.5 }\n",
      "constants.toml");
}

// Kurdej 2015, table 7.1 and section 7.3, are the usual ones, whether the file says so or not.
TEST(CarFile, EvidentialConstantsAreTheUsualOnes) {
  const Car car = car_with_window(
      " slowest_m_s = 1.0, object_m = 3.0, gap_m = 0.5, scans_per_second = 15, free_mass = 0.7, "
      "hit_mass = 0.87 ");
  EXPECT_EQ(car.vehicle.window.tables, nullptr);
  EXPECT_EQ(car.vehicle.id, car_with_window("").vehicle.id);
}

// Half-lives of 1 and 4 s: after 4 s 0.0625 and 0.5 are left (table 6.3). delta = V_min / L and
// gamma = L / d of section 7.3: full after 6 s, empty after 2 s.
TEST(CarFile, EvidentialConstantsAreAsTheFileSays) {
  const Car car = car_with_window(
      " moving_half_life_s = 1.0, static_half_life_s = 4.0, slowest_m_s = 0.5, gap_m = 1.0, "
      "scans_per_second = 10, free_mass = 0.8, hit_mass = 0.8 ");
  ASSERT_NE(car.vehicle.window.tables, nullptr);
  EXPECT_NE(car.vehicle.id, car_with_window("").vehicle.id);
  const ageing::Tables& tables = *car.vehicle.window.tables;
  EXPECT_NEAR(ageing::decay(tables.decays.dynamic, 4000) * 0x1p-31, 0.0625, 2e-8);
  EXPECT_NEAR(ageing::decay(tables.decays.fixed, 4000) * 0x1p-31, 0.5, 2e-8);
  EXPECT_NEAR(ageing::decay(tables.decays.shared, 4000) * 0x1p-31,
              std::pow(0.0625, 0.25) * std::pow(0.5, 0.75), 2e-8);
  const evidence::Gains& gains = tables.gains[40];
  EXPECT_EQ(gains.persistence, 218);        // 32768 * 0.04 / 6 = 218.5
  EXPECT_EQ(gains.decline, 655);            // 32768 * 0.04 / 2 = 655.4
  EXPECT_EQ(gains.specialisation, 13'107);  // 32768 * 0.04 * 10
  EXPECT_EQ(gains.hit_mass, 102 * 256);     // 0.8, down to 1/128
  EXPECT_EQ(gains.free_mass, static_cast<std::int16_t>(32'768 * (1 - std::pow(0.2, 0.4))));
  EXPECT_EQ(tables.gains[100].free_mass, 26'214);  // 32768 * 0.8 = 26214.4
}

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

// The byte order mark, and letters in strings and comments, are TOML.
TEST(CarFile, OutsideOfStringsAllIsAscii) {
  const auto words_of = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(parse_car(text, "letters.toml"));
    } catch (const UsageError& error) {
      return error.what();
    }
    return {};
  };
  const std::string said = ": this is not TOML: outside of strings and comments, all is ASCII";
  for (const std::string line :
       {"a = 6\xD1\xA0"
        "5",
        "\xC3\xA9 = 1", "a = 1\xC2\xA0", "a = \xE2\x80\x9Cx\xE2\x80\x9D"}) {
    EXPECT_EQ(words_of("\xEF\xBB\xBFname = \"\xC3\xA9\" # \xC3\xA9\n" + line),
              "letters.toml:2" + said)
        << line;
  }
  EXPECT_EQ(words_of("\xEF\xBB\xBFname = \"\xC3\xA9\" # \xC3\xA9\n").find("not TOML"),
            std::string::npos);
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

// A car whose file says where its units are and nothing else; more of each behind it.
Car car_of(const std::vector<std::string>& sensors, const std::string& more = {}) {
  std::string text = "name = \"own\"\n" + more +
                     "footprint = { x_min_m = -2, x_max_m = 2, y_min_m = -1, y_max_m = 1 }\n";
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    text += "[[sensors]]\nname = \"unit" + std::to_string(i) + "\"\n" + sensors[i];
  }
  return parse_car(text, "own.toml");
}

std::string puck(double z_m, const std::string& more = {}) {
  return "type = \"velodyne_vlp16\"\nmount = { x_m = 0, y_m = 0, z_m = " + std::to_string(z_m) +
         " }\n" + more;
}

const std::string kLux =
    "type = \"ibeo_lux\"\nmax_points_per_scan = 2412\nmount = { x_m = 2, y_m = 0, z_m = 0.5 }\n";
const std::string kRadar =
    "type = \"continental_ars548\"\nmount = { x_m = 2, y_m = 0, z_m = 0.6 }\n";

// Its port and turn by its data sheet, the heights by docs/vehicles.md.
TEST(CarDefaults, APuckNeedsItsPlaceOnly) {
  const Car car = car_of({puck(1.5)});
  const vehicle::Sensor& unit = car.tables[0];
  EXPECT_EQ(unit.udp_port, 2'368);
  EXPECT_EQ(car.vehicle.grids, vehicle::Grids::kBoth);
  EXPECT_TRUE(car.vehicle.has_objects);
  EXPECT_EQ(car.vehicle.frame_period_us, 150'000U);
  EXPECT_EQ(unit.ground.low_mm, 220);
  EXPECT_EQ(unit.ground.top_mm, 2'200);
  EXPECT_EQ(unit.moved.low_mm, 600);
  EXPECT_EQ(unit.moved.tall_mm, 400);
  EXPECT_TRUE(car.vehicle.window.is_opened_from_below);
}

TEST(CarDefaults, FalseSwitchesGroundAndMovedOff) {
  const Car band = car_of({puck(1.5, "ground = false\n")}, "objects = false\n");
  EXPECT_FALSE(band.tables[0].ground.is_followed());
  EXPECT_FALSE(band.tables[0].moved.are_given());
  EXPECT_FALSE(band.vehicle.has_objects);
  EXPECT_FALSE(car_of({puck(1.5, "moved = false\n")}).tables[0].moved.are_given());
  EXPECT_FALSE(car_of({puck(1.5)}, "grids = \"indexes\"\n").tables[0].moved.are_given());
}

// A van's roof is higher than 2.2 m, and so is the van.
TEST(CarDefaults, ObstaclesEndAboveTheUnit) {
  const Car van = car_of({puck(2.4)});
  EXPECT_EQ(van.tables[0].ground.top_mm, 2'600);
  EXPECT_DOUBLE_EQ(van.description.z_max_m, 2.6);
  const Car low = car_of({puck(2.4, "ground = { low_m = 0.9 }\n")});
  EXPECT_EQ(low.tables[0].ground.top_mm, 2'600);
  EXPECT_EQ(low.tables[0].moved.low_mm, 1'000);
  EXPECT_FALSE(car_of({puck(0.4)}).tables[0].ground.is_followed());
}

// docs/vehicles.md.
TEST(CarDefaults, RangesEndWhereTheCellsLetThem) {
  EXPECT_EQ(car_of({puck(1.5)}).tables[0].range.mm(), 73'000U);
  EXPECT_EQ(car_of({puck(1.5)}, "grid = { cell_m = 0.05 }\n").tables[0].range.mm(), 72'407U);
}

// A puck's lowest beams go down by 15 degrees. They are 0.6 m high (1.5 m - 0.6 m) / tan(15
// degrees) = 3359 mm away, seen from where the unit is.
TEST(CarDefaults, NoBeamIsLowBesideTheCar) {
  const auto blind_mm = [](const Car& car) { return car.vehicle.window.blind_mm; };
  EXPECT_NEAR(blind_mm(car_of({puck(1.5)})), 3'359, 3);
  const std::string ahead_of_it = "grids = \"both\"\ngrid = { ahead_m = 51.2, behind_m = 12.8 }\n";
  EXPECT_NEAR(blind_mm(car_of({puck(1.5)}, ahead_of_it)), 3'359, 3);
  const std::string moved = puck(1.5);
  const std::string ahead = std::string(moved).replace(moved.find("x_m = 0"), 7, "x_m = 1");
  EXPECT_NEAR(blind_mm(car_of({ahead})), 2'359, 3);
  EXPECT_EQ(blind_mm(car_of({puck(1.5, "moved = false\n")})), 0);
  EXPECT_EQ(blind_mm(car_of({puck(0.5)})), 0);
}

TEST(CarDefaults, LevelUnitsShareTheLines) {
  const auto steps = [](const Car& car) {
    std::vector<std::uint32_t> found;
    for (const vehicle::Sensor& sensor : car.tables) {
      found.push_back(sensor.azimuths.steps_per_turn());
    }
    return found;
  };
  using Steps = std::vector<std::uint32_t>;
  const std::string second = "udp_port = 2369\n";
  EXPECT_EQ(steps(car_of({puck(1.5)})), Steps{8'192});
  EXPECT_EQ(steps(car_of({puck(1.5), puck(1.5, second)})), (Steps{4'096, 4'096}));
  EXPECT_EQ(steps(car_of({puck(1.5, "azimuth_steps_per_turn = 2048\n"), puck(1.5, second)})),
            (Steps{2'048, 4'096}));
  // One that is tilted keeps none of these lines.
  EXPECT_EQ(
      steps(car_of({puck(1.5), "type = \"velodyne_vlp16\"\n" + second +
                                   "mount = { x_m = 0, y_m = 0, z_m = 1.5, pitch_deg = 3 }\n"})),
      (Steps{8'192, 8'192}));
}

TEST(CarDefaults, AFrameIsAScanOrATurn) {
  EXPECT_EQ(car_of({kLux}).vehicle.frame_period_us, 40'000U);
  EXPECT_EQ(car_of({kLux, puck(1.5)}).vehicle.frame_period_us, 40'000U);
  const Car radar = car_of({puck(1.5), kRadar});
  EXPECT_EQ(radar.vehicle.frame_period_us, 150'000U);
  EXPECT_EQ(radar.vehicle.grids, vehicle::Grids::kIndexes);
  const auto lasers_of = [](int count) {
    std::string lasers = "lasers = [";
    for (int i = 0; i < count; ++i) {
      lasers += "{ elevation_deg = " + std::to_string(15 - i * 32 / count) + " }, ";
    }
    return lasers + "]\n";
  };
  // A turn of 64 layers hits more cells than the tracker has room for.
  const std::string dense =
      "type = \"hesai_qt64\"\nmount = { x_m = 0, y_m = 0, z_m = 1.8 }\n" + lasers_of(64);
  EXPECT_EQ(car_of({dense}).vehicle.frame_period_us, 40'000U);
  EXPECT_EQ(car_of({dense}, "grids = \"indexes\"\n").vehicle.frame_period_us, 150'000U);
  const Car fast = car_of({"type = \"ouster_rng19\"\nmode = \"1024x20\"\n" + lasers_of(16) +
                           "max_points_per_scan = 16384\n"
                           "mount = { x_m = 0, y_m = 0, z_m = 1.8 }\n"});
  EXPECT_EQ(fast.vehicle.frame_period_us, 75'000U);
  EXPECT_EQ(fast.tables[0].udp_port, 7'502);
}

}  // namespace
}  // namespace iog::tools
