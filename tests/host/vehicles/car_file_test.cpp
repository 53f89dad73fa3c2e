// The files of cars: every one in vehicles/ is read as the compiler has it.
#include "tools/vehicles/car_file.hpp"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

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
