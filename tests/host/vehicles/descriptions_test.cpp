// What must hold for every vehicle description, whoever writes it. Whatever a description can get
// wrong by itself does not compile (vehicle/compile.hpp); this is about its sensors together.
#include <gtest/gtest.h>
#include <set>

#include "grid/frame_fusion.hpp"
#include "vehicles/reference_car.hpp"
#include "vehicles/roof_vlp16.hpp"
#include "vehicles/two_lux_parking.hpp"

namespace iog::vehicles {
namespace {

const vehicle::Vehicle* const kAll[] = {&reference_car::kVehicle, &roof_vlp16::kVehicle,
                                        &two_lux_parking::kVehicle};

TEST(Descriptions, EachSensorHasAPortOfItsOwn) {
  for (const vehicle::Vehicle* car : kAll) {
    std::set<std::uint16_t> ports;
    for (const vehicle::Sensor& sensor : car->sensors) {
      EXPECT_TRUE(ports.insert(sensor.udp_port).second) << car->name << " " << sensor.name;
    }
  }
}

// No frame of sensors that keep to their limits can run out of marks.
TEST(Descriptions, AWholeFrameOfMarksFits) {
  for (const vehicle::Vehicle* car : kAll) {
    std::uint64_t marks = 0;
    for (const vehicle::Sensor& sensor : car->sensors) {
      marks += std::uint64_t{sensor.max_points_per_scan} * grid::max_marks_per_point(sensor);
    }
    EXPECT_LE(marks, grid::kMaxMarks) << car->name;
  }
}

// docs/model.md section 8: four LUX, three in front and one behind, 50 m, 4 layers.
TEST(Descriptions, TheReferenceCarIsThatOfTheThesis) {
  const vehicle::Vehicle& car = reference_car::kVehicle;
  ASSERT_EQ(car.sensors.size(), 4U);
  EXPECT_EQ(car.frame_period_us, 40'000U);
  EXPECT_EQ(car.rule, vehicle::FusionRule::kHitsWin);
  const std::int32_t centre = geometry::kOriginCell * geometry::kResolution;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(car.sensors[i].range.mm(), 50'000U);
    EXPECT_EQ(car.sensors[i].precision_mm, 100U);
    EXPECT_EQ(car.sensors[i].layer_count, 4);
    EXPECT_EQ(car.sensors[i].origin.x > centre, i < 3) << car.sensors[i].name;
  }
}

// A mount in the wrong unit or with a wrong sign lies off the car.
TEST(Descriptions, SensorsStandOnTheirCar) {
  const auto hand = static_cast<std::int32_t>(0.15 * geometry::kSubcellsPerMetre);
  for (const vehicle::Vehicle* car : kAll) {
    for (const vehicle::Sensor& sensor : car->sensors) {
      EXPECT_GE(sensor.origin.x, car->footprint.x_min - hand) << car->name << " " << sensor.name;
      EXPECT_LE(sensor.origin.x, car->footprint.x_max + hand) << car->name << " " << sensor.name;
      EXPECT_GE(sensor.origin.y, car->footprint.y_min - hand) << car->name << " " << sensor.name;
      EXPECT_LE(sensor.origin.y, car->footprint.y_max + hand) << car->name << " " << sensor.name;
    }
  }
}

}  // namespace
}  // namespace iog::vehicles
