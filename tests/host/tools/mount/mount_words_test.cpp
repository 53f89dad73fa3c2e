#include "tools/mount/mount_words.hpp"

#include "gtest/gtest.h"

namespace iog::tools {
namespace {

MountFit fit() {
  MountFit fit;
  fit.taken = 60;
  fit.pitch_deg = {.value = 0.81949, .parts = {0.8, 0.82, 0.83}, .scatter = 0.1};
  fit.roll_deg = {.value = -0.0004, .parts = {-0.1, 0, 0.1}, .scatter = 0.3};
  fit.z_m = {.value = 1.7541, .parts = {1.75, 1.754, 1.76}, .scatter = 0.02};
  return fit;
}

constexpr description::MountConfig kByFile{
    .x_m = 0.81, .y_m = -0.32, .z_m = 1.73, .yaw_deg = 0.1, .pitch_deg = 0, .roll_deg = 2.5};

TEST(MountWords, TheLineHasAllKeysOfAMount) {
  EXPECT_EQ(toml_of(fit(), kByFile),
            "mount = { x_m = 0.81, y_m = -0.32, z_m = 1.754, yaw_deg = 0.1, pitch_deg = 0.819, "
            "roll_deg = 0 }\n");
}

TEST(MountWords, AnAngleThatHasTheOtherSignInTheFileIsTold) {
  const CatalogueEntry& car = find_vehicle("roof_vlp16");
  const UnitTurns unit(car, 0);
  const auto told = [&](double found, double by_file) {
    MountFit fitted = fit();
    fitted.pitch_deg.value = found;
    description::SensorConfig sensor = car.sensors[0];
    sensor.mount.pitch_deg = by_file;
    return words_of(fitted, unit, sensor).find("SIGN?") != std::string::npos;
  };
  EXPECT_TRUE(told(12.05, -12));
  EXPECT_TRUE(told(-3.1, 2.9));
  EXPECT_FALSE(told(12.05, 12));
  EXPECT_FALSE(told(12.05, -3));
  EXPECT_FALSE(told(0.5, -0.5));
}

TEST(MountWords, ARollHasTheOtherSignOnlyIfThatIsAnotherAngle) {
  const CatalogueEntry& car = find_vehicle("roof_vlp16");
  const UnitTurns unit(car, 0);
  const auto told = [&](double found, double by_file) {
    MountFit fitted = fit();
    fitted.roll_deg = {.value = found, .parts = {found, found, found}};
    description::SensorConfig sensor = car.sensors[0];
    sensor.mount.roll_deg = by_file;
    return words_of(fitted, unit, sensor).find("SIGN?") != std::string::npos;
  };
  EXPECT_FALSE(told(-179.95, -180));
  EXPECT_FALSE(told(180, -180));
  EXPECT_FALSE(told(180.5, 179.5));  // by chance
  EXPECT_TRUE(told(185, 175));       // -175
}

// 360.1 degrees would be refused.
TEST(MountWords, TheLineOfARollBeyondATurnCanBeRead) {
  MountFit fitted = fit();
  fitted.roll_deg = {.value = -360.125, .parts = {-360.1, -360.1, -360.2}};
  EXPECT_NE(toml_of(fitted, kByFile).find("roll_deg = -0.125 }"), std::string::npos);
}

TEST(MountWords, ARollThatIsNotKnownIsThatOfTheFile) {
  MountFit fitted = fit();
  fitted.roll_deg.parts = {-0.3, 0, 0.3};
  EXPECT_NE(toml_of(fitted, kByFile).find("roll_deg = 2.5 }"), std::string::npos);
}

}  // namespace
}  // namespace iog::tools
