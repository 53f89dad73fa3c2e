// The files of cars: every one in vehicles/ is read as the compiler has it, and every mistake in
// mistakes/ is told. Both are found by their folder.
#include "tools/vehicles/car_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include "fakes/temporary_folder.hpp"
#include "tools/program/exit_status.hpp"
#include "vehicle/identity.hpp"
#include "vehicles/all_vehicles.hpp"

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

// Those that start so, without their start.
Lines lines_from(std::istream& text, const std::string& start) {
  Lines lines;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with(start)) {
      lines.push_back(line.substr(start.size()));
    }
  }
  return lines;
}

// "12: sensors[0].udp_port: allowed is ...", a line each.
Lines expected_of(const std::string& path) {
  std::ifstream file(path);
  return lines_from(file, "# expected: ");
}

Lines told_of(const std::string& path) {
  try {
    static_cast<void>(read_car(path));
  } catch (const UsageError& error) {
    std::istringstream text(error.what());
    return lines_from(text, path + ':');
  }
  return {};
}

TEST(CarFile, EachMistakeIsToldWithItsLineItsFieldAndWhatIsAllowed) {
  const Lines files = files_in("tests/host/vehicles/mistakes");
  EXPECT_GT(files.size(), 70U);
  for (const std::string& path : files) {
    const Lines expected = expected_of(path);
    const Lines told = told_of(path);
    EXPECT_FALSE(expected.empty()) << path << " expects nothing";
    EXPECT_EQ(told.size(), expected.size()) << path;
    for (std::size_t i = 0; i < std::min(told.size(), expected.size()); ++i) {
      EXPECT_TRUE(told[i].starts_with(expected[i])) << path << ":" << told[i];
    }
  }
}

// A wrong file of a gigabyte is not told line by line.
TEST(CarFile, OfManyMistakesTheFirstAreToldAndTheOthersCounted) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "keys.toml";
  std::ofstream file(path);
  for (int i = 0; i < 1000; ++i) {
    file << "key_" << i << " = 1\n";
  }
  file.close();
  const Lines told = told_of(path);
  ASSERT_EQ(told.size(), 51U);
  // Five keys of a car are missing as well.
  EXPECT_EQ(told.back(), " and 955 more");
  EXPECT_TRUE(told[40].starts_with("36: key_35: no such key"));
}

TEST(CarFile, AFileThatIsNotThereIsTold) {
  EXPECT_THROW(static_cast<void>(read_car("nowhere/my_car.toml")), UsageError);
}

const vehicles::Entry* compiled_of(std::string_view name) {
  const auto* const found = std::ranges::find_if(
      vehicles::kAll, [&](const vehicles::Entry& entry) { return entry.vehicle->name == name; });
  return found == vehicles::kAll.end() ? nullptr : found;
}

// What the program makes of the file is what the compiler has made of its header.
TEST(CarFile, EachCarIsReadAsItIsCompiled) {
  const Lines files = files_in("vehicles");
  EXPECT_EQ(files.size(), vehicles::kAll.size());
  for (const std::string& path : files) {
    const Car car = read_car(path);
    const vehicles::Entry* const compiled = compiled_of(car.description.name);
    ASSERT_NE(compiled, nullptr) << path;
    EXPECT_EQ(car.vehicle.id, compiled->vehicle->id) << path;
    EXPECT_EQ(car.vehicle.id, vehicle::identity_of(*compiled->vehicle)) << path;
    ASSERT_EQ(car.tables.size(), compiled->vehicle->sensors.size()) << path;
    for (std::size_t i = 0; i < car.tables.size(); ++i) {
      const vehicle::Sensor& read = car.tables[i];
      const vehicle::Sensor& made = compiled->vehicle->sensors[i];
      EXPECT_EQ(read.profile, made.profile) << path;
      EXPECT_EQ(read.sines.sine(1), made.sines.sine(1)) << path;
      EXPECT_EQ(read.on_car_x.low, made.on_car_x.low) << path;
      EXPECT_EQ(read.in_band.high, made.in_band.high) << path;
    }
  }
}

// A byte of the description more or less is another car.
TEST(CarFile, AnyChangeIsAnotherIdentity) {
  const Car car = read_car(IOG_SOURCE_DIR "/vehicles/reference_car.toml");
  const auto changed = [&](auto&& change) {
    std::vector<vehicle::Sensor> sensors = car.tables;
    vehicle::Vehicle other = car.vehicle;
    other.sensors = sensors;
    change(other, sensors);
    return vehicle::identity_of(other);
  };
  EXPECT_EQ(changed([](auto&, auto&) {}), car.vehicle.id);
  EXPECT_NE(changed([](auto& other, auto&) { other.name = "reference_cat"; }), car.vehicle.id);
  EXPECT_NE(changed([](auto& other, auto&) { ++other.z_max; }), car.vehicle.id);
  EXPECT_NE(changed([](auto&, auto& sensors) { ++sensors[3].layers[3].z.left; }), car.vehicle.id);
  EXPECT_NE(changed([](auto&, auto& sensors) { sensors[0].profile.hit = 3; }), car.vehicle.id);
  EXPECT_NE(changed([](auto&, auto& sensors) { sensors[1].is_synchronised = false; }),
            car.vehicle.id);
}

}  // namespace
}  // namespace iog::tools
