// Mounts that are known, of simulated drives whose packets the decoders read, with a car's file
// that is wrong.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "tools/car/tables.hpp"
#include "tools/mount/mount_fit.hpp"
#include "tools/mount/mount_watch.hpp"
#include "tools/mount/unit_turns.hpp"
#include "tools/simulate/drives/drive.hpp"

namespace iog::tools {
namespace {

// A car of vehicles/ whose one unit is mounted in another way.
class Remounted {
 public:
  Remounted(const std::string& name, const description::MountConfig& mount)
      : car_(find_vehicle(name)), sensors_(car_.sensors.begin(), car_.sensors.end()) {
    sensors_[0].mount = mount;
    tables_.push_back(description::sensor_of(sensors_[0], *car_.description));
    vehicle_ = *car_.vehicle;
    vehicle_.sensors = tables_;
    car_.vehicle = &vehicle_;
    car_.sensors = sensors_;
  }
  Remounted(const Remounted&) = delete;
  Remounted& operator=(const Remounted&) = delete;

  [[nodiscard]] const CatalogueEntry& car() const { return car_; }

 private:
  CatalogueEntry car_;
  std::vector<description::SensorConfig> sensors_;
  std::vector<vehicle::Sensor> tables_;
  vehicle::Vehicle vehicle_;
};

struct Case {
  std::string car;
  std::string scene;
  double pitch_deg;
  double roll_deg;
  double file_is_off_m;
  double yaw_deg = 0;
};

description::MountConfig truth_of(const Case& which) {
  return {.x_m = 0.3,
          .y_m = -0.2,
          .z_m = 1.7,
          .yaw_deg = which.yaw_deg,
          .pitch_deg = which.pitch_deg,
          .roll_deg = which.roll_deg};
}

description::MountConfig file_of(const Case& which) {
  description::MountConfig mount = truth_of(which);
  mount.pitch_deg = 0;
  mount.roll_deg = 0;
  mount.z_m += which.file_is_off_m;
  return mount;
}

// What each nth turn of a drive says to somebody who has the wrong file.
struct Read {
  Read(const Case& which, std::uint32_t seconds, std::uint32_t every, std::uint32_t lost_of_ten = 0)
      : truth(which.car, truth_of(which)), file(which.car, file_of(which)), turns(file.car(), 0) {
    Drive drive(truth.car(), 1, seconds, find_scene(which.scene), Motion::kContinuous);
    std::uint32_t number = 0;
    for (std::uint32_t frame = 0; frame < drive.frame_count(); frame += every) {
      for (const CapturedDatagram& datagram : drive.datagrams(frame)) {
        motion.add(datagram.time_us, datagram.payload);
        // A step that is prime to ten scatters what is lost.
        if (7 * ++number % 10 >= lost_of_ten) {
          turns.take(datagram);
        }
      }
    }
    turns.finish();
    motion.sort();
  }

  Remounted truth;
  Remounted file;
  UnitTurns turns;
  MotionLog motion;
};

void expect_found(const Case& which, const MountFit& fit) {
  ASSERT_EQ(fit.refusal, "") << which.car;
  EXPECT_NEAR(fit.pitch_deg.value, which.pitch_deg, 0.05) << which.car << " " << which.scene;
  EXPECT_NEAR(fit.roll_deg.value, which.roll_deg, 0.2) << which.car << " " << which.scene;
  EXPECT_NEAR(fit.z_m.value, 1.7, 0.02) << which.car << " " << which.scene;
}

TEST(MountDrives, AWrongFileIsPutRight) {
  for (const Case& which : {Case{"roof_vlp16", "street", 3, -5, 0.3},
                            Case{"roof_vlp16", "ring_road", -5, 3, -0.3, 90}}) {
    const Read read(which, 12, 1);
    expect_found(which, fit_of(read.turns.mounts(), read.turns.turns(), read.motion));
  }
}

TEST(MountDrive, LossOfPacketsIsNoMatter) {
  const Case which{"roof_vlp16", "ring_road", 3, 3, -0.3};
  const Read read(which, 12, 1, 3);
  expect_found(which, fit_of(read.turns.mounts(), read.turns.turns(), read.motion));
}

// Every fourth turn: the car nods by 0.2 degrees, and so do fourteen turns that follow one another.
TEST(MountDrives, IsThatOfEveryUnit) {
  for (const Case& which :
       {Case{"roof_hdl64e", "ring_road", 3, 0, 0.3}, Case{"roof_os1_64", "ring_road", 0, -5, -0.3},
        Case{"roof_pandar64", "ring_road", -3, 3, 0.3, 180},
        Case{"roof_xt32", "ring_road", 5, -3, 0.3, -30}}) {
    const Read read(which, 6, 4);
    ASSERT_GE(read.turns.mounts().size(), 14U) << which.car;
    MountFit fit = fit_of(read.turns.mounts(), read.turns.turns(), {});
    EXPECT_NE(fit.refusal, "");  // too few, and their mean is near all the same
    double pitch = 0;
    double roll = 0;
    double z = 0;
    for (const TurnMount& turn : read.turns.mounts()) {
      pitch += turn.pitch_deg;
      roll += turn.roll_deg;
      z += turn.z_m;
    }
    const auto count = static_cast<double>(read.turns.mounts().size());
    EXPECT_NEAR(pitch / count, which.pitch_deg, 0.1) << which.car;
    EXPECT_NEAR(roll / count, which.roll_deg, 0.1) << which.car;
    EXPECT_NEAR(z / count, 1.7, 0.01) << which.car;
  }
}

// A file that is half a metre, 3 degrees or upside down wrong draws a plausible grid.
TEST(MountWatch, TellsAFileThatIsWrong) {
  const Case right{"roof_vlp16", "street", 0, 0, 0};
  const Remounted truth(right.car, truth_of(right));
  const auto told = [&](double pitch_deg, double roll_deg, double height_m) {
    description::MountConfig mount = truth_of(right);
    mount.pitch_deg += pitch_deg;
    mount.roll_deg += roll_deg;
    mount.z_m += height_m;
    const Remounted file(right.car, mount);
    MountWatch watch(file.car(), 1);
    Drive drive(truth.car(), 1, 6, find_scene(right.scene), Motion::kContinuous);
    for (std::uint32_t frame = 0; frame < drive.frame_count(); frame += 4) {
      std::ranges::for_each(drive.datagrams(frame), [&](const auto& each) { watch.take(each); });
    }
    return watch.rows();
  };
  const auto is_told = [&](const std::string& text, const char* words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  const auto is_left_out = [&](const std::string& text, const char* words) {
    EXPECT_EQ(text.find(words), std::string::npos) << text;
  };
  EXPECT_EQ(told(0, 0, 0), "");
  const std::string pitched = told(3, 0, 0);
  is_told(pitched, " is off: its pitch by ");
  is_left_out(pitched, "roll");
  const std::string lowered = told(0, 0, -0.5);
  is_told(lowered, " is off: its height by -0.5");
  is_left_out(lowered, "pitch");
  is_left_out(lowered, "roll");
  is_told(told(0, 180, 0), "is the other way up");
}

TEST(MountDrive, AUnitThatIsTheOtherWayUpIsTold) {
  const Case right{"roof_vlp16", "street", 0, 0, 0};
  const Remounted truth(right.car, truth_of(right));
  description::MountConfig turned = truth_of(right);
  turned.roll_deg = 180;
  const Remounted file(right.car, turned);
  UnitTurns turns(file.car(), 0);
  Drive drive(truth.car(), 1, 2, find_scene(right.scene), Motion::kContinuous);
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    std::ranges::for_each(drive.datagrams(frame), [&](const auto& each) { turns.take(each); });
  }
  turns.finish();
  EXPECT_NE(fit_of(turns, {}).refusal.find("the other way up"), std::string::npos);
}

TEST(MountDrive, AnotherCarsCaptureHasNoTurns) {
  Drive drive(find_vehicle("roof_vlp16"), 1, 1, find_scene("street"));
  UnitTurns hesai(find_vehicle("roof_pandar64"), 0);
  for (const CapturedDatagram& datagram : drive.datagrams(0)) {
    hesai.take(datagram);
  }
  hesai.finish();
  EXPECT_EQ(hesai.packets(), 0U);
  EXPECT_EQ(hesai.turns(), 0U);
}

}  // namespace
}  // namespace iog::tools
