// What the tables of a block must keep to, whoever has made it: each limit is told by its field,
// and what is accepted has beams that the loops can walk.
#include "car_block/limits.hpp"

#include <gtest/gtest.h>
#include <string>

#include "car_bytes.hpp"
#include "changed_car.hpp"
#include "fakes/random.hpp"
#include "vehicle/beam.hpp"

namespace iog::car_block {
namespace {
using tests::Changed;
using tests::fault_with;
using vehicle::Sensor;

TEST(CarLimits, ThoseOfEachCarHold) {
  for (const vehicles::Car& car : vehicles::cars()) {
    EXPECT_EQ(Changed(car).fault(), "") << car.vehicle.name;
  }
}

TEST(CarLimits, OfTheCarAreToldByTheirField) {
  EXPECT_EQ(fault_with([](Changed& c) { c.car.name = "9"; }), "name");
  EXPECT_EQ(fault_with([](Changed& c) { c.car.frame_period_us = 9'999; }), "frame_period_us");
  EXPECT_EQ(fault_with([](Changed& c) { c.car.window.group_budget = 0; }), "window.group_budget");
  EXPECT_EQ(fault_with([](Changed& c) { c.car.sensors = {}; }), "sensors");
  EXPECT_EQ(fault_with([](Changed& c) { c.car.footprint.x_min = -1; }), "footprint.x_max_m");
  EXPECT_EQ(fault_with([](Changed& c) { c.car.footprint.y_max = 1 << 30; }), "footprint.y_max_m");
  EXPECT_EQ(fault_with([](Changed& c) { c.car.z_max = c.car.z_min; }), "z_min_m");
  EXPECT_EQ(fault_with([](Changed& c) { c.car.rule = vehicle::FusionRule::kBayes; }), "rule");
  EXPECT_EQ(fault_with([](Changed& c) { c.car.poses.log2_slice_ms = 7; }), "poses.log2_slice_ms");
  EXPECT_EQ(fault_with([](Changed& c) { c.car.poses.udp_port = c.sensors[1].udp_port; }),
            "poses.udp_port");
  EXPECT_EQ(fault_with([](Changed& c) { c.car.maps.source_ipv4 = c.network.address.value; }),
            "maps.source_ipv4");
  EXPECT_EQ(fault_with([](Changed& c) { c.network.peer = c.network.address; }), "network.peer");
}

// Four sizes of cells, sides of whole tiles, and at most 1024 x 1024 cells.
TEST(CarLimits, OfTheGrid) {
  const auto fault_of = [](const geometry::Grid& grid) {
    return fault_with([&](Changed& c) {
      c.car.grid = grid;
      c.car.grids = vehicle::Grids::kIndexes;
      c.car.has_objects = false;
    });
  };
  EXPECT_EQ(fault_of({}), "");
  EXPECT_EQ(fault_of({.cell_mm = 0}), "grid.cell_m");
  EXPECT_EQ(fault_of({.cell_mm = 99}), "grid.cell_m");
  EXPECT_EQ(fault_of({.columns = 0, .origin_column = 0}), "grid.ahead_m");
  EXPECT_EQ(fault_of({.columns = 1056}), "grid.ahead_m");
  EXPECT_EQ(fault_of({.columns = 1000}), "grid.ahead_m");
  EXPECT_EQ(fault_of({.columns = 480}), "grid.ahead_m");  // the origin is farther than that
  EXPECT_EQ(fault_of({.columns = 512}), "");
  EXPECT_EQ(fault_of({.columns = 2048, .rows = 512, .origin_row = 256}), "");
  EXPECT_EQ(fault_of({.columns = 4096, .rows = 256, .origin_row = 256}), "");
  EXPECT_EQ(fault_of({.columns = 4128, .rows = 32, .origin_row = 0}), "grid.ahead_m");
  EXPECT_EQ(fault_of({.columns = 32, .rows = 4128, .origin_column = 0}), "grid.left_m");
  EXPECT_EQ(fault_of({.rows = 1023}), "grid.left_m");
  EXPECT_EQ(fault_of({.rows = 992, .origin_row = 993}), "grid.left_m");
}

TEST(CarLimits, OfTheWindow) {
  const auto fault_of = [](std::uint8_t columns, std::uint8_t rows) {
    return fault_with([&](Changed& c) { c.car.window.extent = {columns, rows}; });
  };
  EXPECT_EQ(fault_of(32, 32), "");
  EXPECT_EQ(fault_of(4, 32), "");
  EXPECT_EQ(fault_of(9, 4), "");
  EXPECT_EQ(fault_of(3, 32), "window.side_x_m");
  EXPECT_EQ(fault_of(33, 32), "window.side_x_m");
  EXPECT_EQ(fault_of(32, 0), "window.side_y_m");
  EXPECT_EQ(fault_of(32, 255), "window.side_y_m");
}

// Classes have cells of 0.1 m or more, objects 0.1 m, and `moved` needs classes and at most 0.2 m.
TEST(CarLimits, OfTheCellsOfClasses) {
  struct Case {
    geometry::Grid grid;
    vehicle::Grids grids;
    bool has_objects;
    bool has_moved;
    std::string fault;
  };
  constexpr auto kBoth = vehicle::Grids::kBoth;
  constexpr auto kIndexes = vehicle::Grids::kIndexes;
  constexpr geometry::Grid kRectangle{.columns = 512};
  for (const Case& its :
       {Case{{.cell_mm = 50}, kBoth, false, false, "grids"},
        Case{{.cell_mm = 200}, kBoth, false, false, ""},
        Case{{.cell_mm = 200}, kBoth, false, true, ""},
        Case{{.cell_mm = 200}, kBoth, true, false, "objects"},
        Case{{.cell_mm = 500}, kBoth, false, false, ""},
        Case{{.cell_mm = 500}, kBoth, false, true, "0.moved"},
        Case{kRectangle, kBoth, true, true, ""}, Case{kRectangle, kIndexes, false, true, "0.moved"},
        Case{{.cell_mm = 200}, kIndexes, false, true, "0.moved"},
        Case{{}, kIndexes, false, true, ""}}) {
    EXPECT_EQ(fault_with([&](Changed& c) {
                c.car.grid = its.grid;
                c.car.grids = its.grids;
                c.car.has_objects = its.has_objects;
                c.sensors[0].moved =
                    its.has_moved ? vehicle::MovedLimits{600, 700} : vehicle::MovedLimits{};
              }),
              its.fault)
        << its.grid.cell_mm << ", " << its.grid.columns;
  }
}

TEST(CarLimits, OfTheEvidentialConstants) {
  const auto fault_of = [](auto&& change) {
    ageing::Tables tables{.decays = ageing::kUsualDecays,
                          .free = ageing::make_free_masses(0.3),
                          .hit_mass = 111 * 256};
    change(tables);
    return fault_with([&](Changed& c) { c.car.window.tables = &tables; });
  };
  using ageing::Tables;
  EXPECT_EQ(fault_of([](Tables&) {}), "");
  EXPECT_EQ(fault_of([](Tables& t) { t.decays.fixed[3] = ageing::kUndecayed; }),
            "window.moving_half_life_s");
  EXPECT_EQ(fault_of([](Tables& t) { t.decays.shared[0] = ageing::kUndecayed + 1; }),
            "window.moving_half_life_s");
  EXPECT_EQ(fault_of([](Tables& t) { t.accumulation.full_ms = 99; }), "window.object_m");
  EXPECT_EQ(fault_of([](Tables& t) { t.accumulation.empty_ms = 3'001; }), "window.object_m");
  EXPECT_EQ(fault_of([](Tables& t) { t.accumulation.specialisations_per_second = 101; }),
            "window.object_m");
  EXPECT_EQ(fault_of([](Tables& t) { t.free[50] = -1; }), "window.free_mass");
  EXPECT_EQ(fault_of([](Tables& t) { t.hit_mass = -256; }), "window.hit_mass");
}

TEST(CarLimits, OfASensorAreToldByItsNumberAndField) {
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[1].name = c.sensors[0].name; }), "1.name");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[2].udp_port = c.sensors[0].udp_port; }),
            "2.udp_port");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[3].source_ipv4 = c.sensors[0].source_ipv4; }),
            "3.source_ipv4");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].origin.x += 1 << 20; }), "0.mount.x_m");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].origin_z = 1 << 28; }), "0.mount.z_m");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].range_min_mm = 50'000; }), "0.range_max_mm");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].range = traversal::LineLength(130'001); }),
            "0.range_max_mm");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].no_return_clears_mm = 50'001; }),
            "0.no_return_clears_mm");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].precision_mm = 0; }), "0.precision_mm");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].profile.hit = 0; }), "0.precision_mm");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].scan_width_ticks = 11'521; }),
            "0.scan_width_ticks");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].max_points_per_scan = 0; }),
            "0.max_points_per_scan");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].max_points_per_scan = 11; }),
            "0.max_points_per_scan");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].max_points_per_scan = 262'145; }),
            "0.max_points_per_scan");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].layer_count = 3; }), "0.lasers");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].columns_per_turn = 512; }), "0.mode");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].latency_us = 1'000'001; }), "0.latency_us");
}

// A laser of a QT128 that did not fire has no range, and says of nothing that it is free.
TEST(CarLimits, OfAScannerWithSilentLasers) {
  const auto fault_of = [](auto&& change) { return fault_with(change, "roof_qt128"); };
  EXPECT_EQ(fault_of([](Changed& c) { c.sensors[0].no_return_clears_mm = 1; }),
            "0.no_return_clears_mm");
}

// A radar marks an arc, and says of nothing that it is free.
TEST(CarLimits, OfARadar) {
  const auto fault_of = [](auto&& change) { return fault_with(change, "roof_vlp16_radar"); };
  EXPECT_EQ(fault_of([](Changed& c) { c.car.grids = vehicle::Grids::kClasses; }), "1.type");
  EXPECT_EQ(fault_of([](Changed& c) { c.car.grids = vehicle::Grids::kBoth; }), "1.type");
  EXPECT_EQ(fault_of([](Changed& c) { c.sensors[1].no_return_clears_mm = 1; }),
            "1.no_return_clears_mm");
  EXPECT_EQ(fault_of([](Changed& c) { c.sensors[1].moved = {600, 700}; }), "1.moved");
  EXPECT_EQ(fault_of([](Changed& c) { c.sensors[1].ground = {220, 2'200}; }), "1.ground");
  EXPECT_EQ(fault_of([](Changed& c) { c.sensors[1].is_calibrated = true; }), "1.lasers");
  EXPECT_EQ(fault_of([](Changed& c) { c.sensors[1].layer_count = 60; }), "1.lasers");
  EXPECT_EQ(fault_of([](Changed& c) { c.sensors[1].max_points_per_scan = 799; }),
            "1.max_points_per_scan");
  const auto fault_of_arc = [&](const sensor_model::Arc& arc) {
    return fault_of([&](Changed& c) { c.sensors[1].arc = arc; });
  };
  EXPECT_EQ(fault_of_arc({.cell_ticks = 32, .count = 3, .marks = {9, 9, 1}}), "");
  EXPECT_EQ(fault_of_arc({.cell_ticks = 33, .count = 3, .marks = {9, 9, 1}}),
            "1.azimuth_sigma_deg");
  EXPECT_EQ(fault_of_arc({.cell_ticks = 32, .count = 3, .marks = {9, 9, 0}}),
            "1.azimuth_sigma_deg");
  EXPECT_EQ(fault_of_arc({.cell_ticks = 32, .count = 2, .marks = {1, 2}}), "1.azimuth_sigma_deg");
  EXPECT_EQ(fault_of_arc({}), "1.azimuth_sigma_deg");
  EXPECT_EQ(fault_with([](Changed& c) {
              c.sensors[0].arc = {16, 2, {2, 1}};
            }),
            "0.azimuth_sigma_deg");
}

// Its cone is at most 50 degrees to either side, and 10 m long, and it frees little.
TEST(CarLimits, OfAnUltrasonicUnit) {
  const auto fault_of = [](auto&& change) { return fault_with(change, "roof_vlp16_ultrasonic"); };
  EXPECT_EQ(fault_of([](Changed&) {}), "");
  EXPECT_EQ(fault_of([](Changed& c) { c.car.grids = vehicle::Grids::kClasses; }), "1.type");
  EXPECT_EQ(fault_of([](Changed& c) { c.sensors[1].no_return_clears_mm = 1; }),
            "1.no_return_clears_mm");
  EXPECT_EQ(fault_of([](Changed& c) { c.sensors[1].moved = {600, 700}; }), "1.moved");
  EXPECT_EQ(fault_of([](Changed& c) { c.sensors[1].ground = {220, 2'200}; }), "1.ground");
  EXPECT_EQ(fault_of([](Changed& c) { c.sensors[1].is_calibrated = true; }), "1.lasers");
  EXPECT_EQ(fault_of([](Changed& c) { c.sensors[1].range = traversal::LineLength(10'001); }),
            "1.range_max_mm");
  const auto fault_of_arc = [&](const sensor_model::Arc& arc) {
    return fault_of([&](Changed& c) { c.sensors[1].arc = arc; });
  };
  EXPECT_EQ(fault_of_arc({.cell_ticks = 640, .count = 3, .marks = {9, 9, 1}, .free = -127}), "");
  EXPECT_EQ(fault_of_arc({.cell_ticks = 641, .count = 3, .marks = {9, 9, 1}, .free = -1}),
            "1.azimuth_sigma_deg");
  EXPECT_EQ(fault_of_arc({.cell_ticks = 640, .count = 3, .marks = {9, 9, 1}, .free = 1}),
            "1.azimuth_sigma_deg");
  EXPECT_EQ(fault_of_arc({}), "1.azimuth_sigma_deg");
}

// 800 detections of 79 steps at 73 m, and a turn of the lidar beside it.
TEST(CarLimits, AllStepsOfAnArcMark) {
  const auto fault_of_points = [](std::uint32_t points) {
    return fault_with(
        [&](Changed& c) {
          c.sensors[1].arc = {32, 3, {9, 9, 1}};
          c.sensors[0].max_points_per_scan = points;
        },
        "roof_vlp16_radar");
  };
  EXPECT_EQ(fault_of_points(262'144 - 800 * 79), "");
  EXPECT_EQ(fault_of_points(262'144 - 800 * 79 + 1), "1.max_points_per_scan");
}

TEST(CarLimits, OfTheGround) {
  const auto fault_of_limits = [](std::uint16_t low_mm, std::uint16_t top_mm) {
    return fault_with(
        [&](Changed& c) {
          c.sensors[0].ground = {low_mm, top_mm};
          c.sensors[0].moved = {};
        },
        "roof_hdl64e");
  };
  EXPECT_EQ(fault_of_limits(100, 10'000), "");
  EXPECT_EQ(fault_of_limits(1'000, 2'200), "");
  EXPECT_EQ(fault_of_limits(99, 2'200), "0.ground.low_m");
  EXPECT_EQ(fault_of_limits(1'001, 2'200), "0.ground.low_m");
  EXPECT_EQ(fault_of_limits(220, 719), "0.ground.top_m");
  EXPECT_EQ(fault_of_limits(220, 10'001), "0.ground.top_m");
  EXPECT_EQ(fault_of_limits(220, 1'600), "0.ground.top_m");  // the sensor is higher
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].ground = {220, 2'200}; }), "0.ground");
}

// Over the plane from z_min to z_max, over the ground from its lower limit to its upper one, and
// where no beam may have passed under a car.
TEST(CarLimits, OfWhatOpensGround) {
  const auto fault_of = [](vehicle::MovedLimits moved, vehicle::GroundLimits ground) {
    return fault_with(
        [&](Changed& c) {
          c.sensors[0].moved = moved;
          c.sensors[0].ground = ground;
          c.car.z_min = c.car.grid.subcells(300);
          c.car.z_max = c.car.grid.subcells(2'200);
        },
        "roof_hdl64e");
  };
  EXPECT_EQ(fault_of({400, 0}, {}), "");
  EXPECT_EQ(fault_of({10'000, 2'200}, {}), "");
  EXPECT_EQ(fault_of({399, 700}, {}), "0.moved.low_m");
  EXPECT_EQ(fault_of({10'001, 700}, {}), "0.moved.low_m");
  EXPECT_EQ(fault_of({600, 2'201}, {}), "0.moved.tall_m");
  EXPECT_EQ(fault_of({400, 3'000}, {220, 3'000}), "");
  EXPECT_EQ(fault_of({399, 3'000}, {220, 3'000}), "0.moved.low_m");
  EXPECT_EQ(fault_of({550, 3'000}, {450, 3'000}), "");
  EXPECT_EQ(fault_of({549, 3'000}, {450, 3'000}), "0.moved.low_m");
  EXPECT_EQ(fault_of({600, 3'001}, {220, 3'000}), "0.moved.tall_m");
}

TEST(CarLimits, TwoSensorsFollowTheGround) {
  const auto fault_of_several = [](std::size_t count) {
    return fault_with(
        [&](Changed& c) {
          c.sensors.assign(count, c.sensors[0]);
          for (std::size_t i = 0; i < count; ++i) {
            c.sensors[i].ground = {220, 2'200};
            c.sensors[i].azimuths = vehicle::AzimuthSteps(36'000, 2'048);
            c.sensors[i].name = std::string_view("abc").substr(i, 1);
            c.sensors[i].udp_port = static_cast<std::uint16_t>(2'000 + i);
          }
          c.car.sensors = c.sensors;
        },
        "roof_vlp16");
  };
  EXPECT_EQ(fault_of_several(2), "");
  EXPECT_EQ(fault_of_several(3), "2.ground");
}

TEST(CarLimits, LayersAreARotationOfBeams) {
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].layers[2].x.forward += 9'000'000; }),
            "0.mount");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].layers[2].y.base = INT64_MIN; }), "0.mount");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].layers[2].z.base = INT64_MAX; }), "0.mount");
  EXPECT_EQ(fault_with([](Changed& c) {
              for (vehicle::EndCoordinate* axis :
                   {&c.sensors[0].layers[1].x, &c.sensors[0].layers[1].y}) {
                axis->left = axis->forward;
              }
            }),
            "0.mount");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].layers[2].range_share = 5; }), "0.mount");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].layers[2].line = 3; }), "0.type");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].layers_share_lines = true; }), "0.type");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].layers[3].range_share = 0; }, "roof_vlp16"),
            "0.mount");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].layers[3].z.left = 1; }, "roof_vlp16"),
            "0.mount");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].laser_corrections[3].azimuth_ticks = 30'000; },
                       "roof_hdl64e"),
            "0.lasers");
}

// Of a tilted mirror nothing is quite at right angles. It still has to be beams.
TEST(CarLimits, LayersOfATiltedMirrorAreNearlyARotation) {
  const auto fault = [](auto&& change) { return fault_with(change, "roof_ld_mrs"); };
  EXPECT_EQ(fault([](Changed& c) { c.sensors[0].layers[5].z.base += 1 << 26; }), "0.mount");
  EXPECT_EQ(fault([](Changed& c) { c.sensors[0].layers[5].x.forward += 9'000'000; }), "0.mount");
  EXPECT_EQ(fault([](Changed& c) {
              for (vehicle::EndCoordinate* axis :
                   {&c.sensors[0].layers[6].x, &c.sensors[0].layers[6].z}) {
                axis->left = axis->forward / 100;
              }
            }),
            "0.mount");
  EXPECT_EQ(fault([](Changed& c) { c.sensors[0].layers[7].y.base = INT64_MIN; }), "0.mount");
  EXPECT_EQ(fault([](Changed& c) { c.sensors[0].layer_count = 4; }), "0.lasers");
  EXPECT_EQ(fault([](Changed& c) { c.sensors[0].range = traversal::LineLength(128'000); }),
            "0.range_max_mm");
}

// Every turned, tilted and rolled unit passes: the limits are no narrower than those of a
// description.
TEST(CarLimits, EndsOfAcceptedBeamsAreAsFarAsTheirRange) {
  tests::Random random(20);
  for (const vehicles::Car& car : vehicles::cars()) {
    for (const Sensor& sensor : car.vehicle.sensors) {
      const double length = static_cast<double>(
          subcells_up(longest_line_mm(sensor.format, sensor.range.mm()), sensor.grid));
      for (int i = 0; i < 200; ++i) {
        const auto layer = static_cast<std::uint8_t>(random.below(sensor.layer_count));
        const auto step =
            static_cast<std::uint32_t>(random.below(sensor.azimuths.steps_per_turn()));
        const vehicle::BeamLine line =
            vehicle::line_of(sensor, sensor.layers[layer], vehicle::direction_of(sensor, step));
        const double x = line.x().length();
        const double y = line.y().length();
        EXPECT_LE(x * x + y * y, (length + 6) * (length + 6));
        EXPECT_LT((std::uint64_t{line.x().length()} + line.y().length()) * geometry::kResolution,
                  std::uint64_t{1} << 31);
      }
    }
  }
}

// Blocks that somebody has changed and given a right CRC: what passes can still be walked.
TEST(CarLimits, WhatIsAcceptedCanBeWalked) {
  tests::Random random(21);
  int accepted = 0;
  for (int round = 0; round < 4'000; ++round) {
    tests::CarBytes bytes(vehicles::car(round < 3'000 ? "reference_car" : "roof_ld_mrs"));
    const std::span<std::byte> content = bytes.content();
    const auto where = random.below(content.size());
    content[where] ^= std::byte{1} << random.below(8);
    bytes.mend_crc();
    if (bytes.read().refusal != Refusal::kNone) {
      continue;
    }
    ++accepted;
    for (const Sensor& sensor : bytes.car.sensors) {
      for (std::uint32_t step = 0; step < sensor.azimuths.steps_per_turn(); step += 211) {
        for (std::uint8_t layer = 0; layer < sensor.layer_count; ++layer) {
          const vehicle::Direction direction = vehicle::direction_of(sensor, step);
          const vehicle::BeamLine line = vehicle::line_of(sensor, sensor.layers[layer], direction);
          ASSERT_LT((std::uint64_t{line.x().length()} + line.y().length()) * geometry::kResolution,
                    std::uint64_t{1} << 31);
        }
      }
    }
  }
  EXPECT_GT(accepted, 10);
}

}  // namespace
}  // namespace iog::car_block
