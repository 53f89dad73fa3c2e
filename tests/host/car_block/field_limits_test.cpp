// Limits of the fields of a block that a car's file and a forged block have in common: each side of
// each of them.
#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <string_view>

#include "changed_car.hpp"
#include "geometry/grid.hpp"

namespace iog::car_block {
namespace {

using std::string_view_literals::operator""sv;
using tests::Changed;
using tests::fault_with;

TEST(FieldLimits, NamesAreShortWordsOfLettersAndDigits) {
  const auto fault_of_car = [](std::string_view name) {
    return fault_with([&](Changed& c) { c.car.name = name; });
  };
  EXPECT_EQ(fault_of_car(""), "name");
  EXPECT_EQ(fault_of_car("a_car_with_31_letters_as_allowed"), "name") << "32 letters";
  EXPECT_EQ(fault_of_car("a_car_with_31_letters_is_allowed"sv.substr(1)), "");
  EXPECT_EQ(fault_of_car("my-car"), "name");
  EXPECT_EQ(fault_of_car("_Car9"), "");
  const auto fault_of_sensor = [](std::string_view name) {
    return fault_with([&](Changed& c) { c.sensors[0].name = name; });
  };
  EXPECT_EQ(fault_of_sensor(""), "0.name");
  EXPECT_EQ(fault_of_sensor("roof_in_the_rear"), "0.name") << "16 letters";
  EXPECT_EQ(fault_of_sensor("roof_in_the_rea"), "");
}

// RFC 1122, 3.2.1.3: 0, 127 and what is a group or beyond are nobody's address.
TEST(FieldLimits, AddressesAreThoseOfHosts) {
  for (const std::uint32_t nobody : {net::ipv4(0, 1, 2, 3).value, net::ipv4(127, 0, 0, 1).value,
                                     net::ipv4(224, 0, 0, 1).value, net::kLimitedBroadcast.value}) {
    EXPECT_EQ(fault_with([&](Changed& c) { c.sensors[2].source_ipv4 = nobody; }), "2.source_ipv4");
    EXPECT_EQ(fault_with([&](Changed& c) { c.car.poses.source_ipv4 = nobody; }),
              "poses.source_ipv4");
    EXPECT_EQ(fault_with([&](Changed& c) { c.car.maps.source_ipv4 = nobody; }), "maps.source_ipv4");
  }
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].source_ipv4 = 0; }), "") << "from anybody";
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].source_ipv4 = c.network.address.value; }),
            "0.source_ipv4");
  EXPECT_EQ(fault_with([](Changed& c) { c.car.poses.source_ipv4 = c.network.address.value; }),
            "poses.source_ipv4");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[1].udp_port = 0; }), "1.udp_port");
}

// IEEE 802: the lowest bit of a group's first octet is set. RFC 1122: neither the subnet's own name
// nor its broadcast is a host's.
TEST(FieldLimits, OfTheNetwork) {
  const auto fault_of = [](auto&& change) {
    return fault_with([&](Changed& c) { change(c.network); });
  };
  EXPECT_EQ(fault_of([](net::Config& n) { n.prefix_bits = 7; }), "network.prefix_bits");
  EXPECT_EQ(fault_of([](net::Config& n) { n.prefix_bits = 31; }), "network.prefix_bits");
  EXPECT_EQ(fault_of([](net::Config& n) { n.prefix_bits = 8; }), "");
  EXPECT_EQ(fault_of([](net::Config& n) { n.prefix_bits = 27; }), "") << "10.0.2.15 and .2";
  EXPECT_EQ(fault_of([](net::Config& n) { n.mac.octets[0] = 1; }), "network.mac");
  EXPECT_EQ(fault_of([](net::Config& n) { n.address = net::ipv4(10, 0, 2, 0); }),
            "network.address");
  EXPECT_EQ(fault_of([](net::Config& n) { n.address = net::ipv4(10, 0, 2, 255); }),
            "network.address");
  EXPECT_EQ(fault_of([](net::Config& n) { n.address = net::ipv4(127, 0, 0, 1); }),
            "network.address");
  EXPECT_EQ(fault_of([](net::Config& n) { n.peer = net::ipv4(10, 0, 3, 2); }), "network.peer");
  EXPECT_EQ(fault_of([](net::Config& n) { n.peer = net::ipv4(10, 0, 2, 255); }), "network.peer");
  EXPECT_EQ(fault_of([](net::Config& n) { n.peer_port = 0; }), "network.peer_port");
  EXPECT_EQ(fault_of([](net::Config& n) { n.source_port = 0; }), "network.source_port");
}

// An Ouster of before firmware 2.0 does not say in which mode it is: 1024 columns ten times a
// second are a column each 97,656 ns.
TEST(FieldLimits, OfAnOustersMode) {
  const auto fault_of_mode = [](std::uint16_t columns, std::uint32_t column_ns) {
    return fault_with(
        [&](Changed& c) {
          c.sensors[0].columns_per_turn = columns;
          c.sensors[0].column_ns = column_ns;
        },
        "roof_os1_64");
  };
  EXPECT_EQ(fault_of_mode(1024, 97'656), "");
  EXPECT_EQ(fault_of_mode(512, 195'312), "");
  EXPECT_EQ(fault_of_mode(1024, 48'828), "") << "twenty times a second";
  EXPECT_EQ(fault_of_mode(1024, 97'657), "0.mode");
  EXPECT_EQ(fault_of_mode(2048, 24'414), "0.mode") << "no unit turns that fast with 2048";
  EXPECT_EQ(fault_of_mode(0, 0), "0.mode");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].column_ns = 1; }), "0.mode");
}

// The elevations of an Ouster are each unit's own.
TEST(FieldLimits, OfLasers) {
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].is_calibrated = false; }, "roof_os1_64"),
            "0.lasers");
  EXPECT_EQ(fault_with([](Changed& c) { c.sensors[0].layer_count = 129; }, "roof_os1_64"),
            "0.lasers");
  const auto fault_of = [](std::int16_t ticks, std::int16_t mm) {
    return fault_with(
        [&](Changed& c) {
          c.sensors[0].laser_corrections[3] = {.azimuth_ticks = ticks, .range_mm = mm};
        },
        "roof_hdl64e");
  };
  EXPECT_EQ(fault_of(3'000, 10'000), "");
  EXPECT_EQ(fault_of(-3'000, -10'000), "");
  EXPECT_EQ(fault_of(3'001, 0), "0.lasers");
  EXPECT_EQ(fault_of(0, 10'001), "0.lasers");
  EXPECT_EQ(fault_of(0, -10'001), "0.lasers");
}

TEST(FieldLimits, SharedLinesAreLevel) {
  const auto fault_of = [](auto&& change) {
    return fault_with([&](Changed& c) { change(c.sensors[0].layers[3]); }, "roof_vlp16");
  };
  EXPECT_EQ(fault_of([](vehicle::Layer& layer) { layer.z.forward = 1; }), "0.mount");
  EXPECT_EQ(fault_of([](vehicle::Layer& layer) { layer.range_share = (1U << 30) + 1; }), "0.mount");
  EXPECT_EQ(fault_of([](vehicle::Layer& layer) { layer.z.base = INT64_MAX / 4; }), "0.mount");
  EXPECT_EQ(fault_of([](vehicle::Layer& layer) { layer.z.base = -(INT64_MAX / 4); }), "0.mount");
}

// In subcells, 1024 a cell of 100 mm, from the grid's corner; the grid ends behind its last cell.
TEST(FieldLimits, TheFootprintLiesInTheGrid) {
  constexpr std::int32_t kEnd = geometry::kCellsPerSide * geometry::kResolution;
  const auto fault_of = [](vehicle::Footprint footprint) {
    const std::string fault = fault_with([&](Changed& c) { c.car.footprint = footprint; });
    return fault.find("footprint") == 0 ? fault : "";
  };
  EXPECT_EQ(fault_of({.x_min = 0, .x_max = kEnd, .y_min = 0, .y_max = kEnd}), "");
  EXPECT_EQ(fault_of({.x_min = -1, .x_max = kEnd, .y_min = 0, .y_max = kEnd}), "footprint.x_max_m");
  EXPECT_EQ(fault_of({.x_min = 0, .x_max = kEnd + 1, .y_min = 0, .y_max = 1}), "footprint.x_max_m");
  EXPECT_EQ(fault_of({.x_min = 0, .x_max = 1, .y_min = -1, .y_max = 1}), "footprint.y_max_m");
  EXPECT_EQ(fault_of({.x_min = 0, .x_max = 1, .y_min = 0, .y_max = kEnd + 1}), "footprint.y_max_m");
}

TEST(FieldLimits, OfAUnitEachFromBothSides) {
  const auto fault_of = [](auto&& change) {
    return fault_with([&](Changed& c) { change(c.sensors[0]); });
  };
  EXPECT_EQ(fault_of([](vehicle::Sensor& s) { s.scan_width_ticks = 0; }), "0.scan_width_ticks");
  EXPECT_EQ(fault_of([](vehicle::Sensor& s) { s.scan_width_ticks = 1; }), "");
  EXPECT_EQ(fault_of([](vehicle::Sensor& s) { s.latency_us = 1'000'000; }), "");
  EXPECT_EQ(fault_of([](vehicle::Sensor& s) { s.range_min_mm = s.range.mm(); }), "0.range_max_mm");
  EXPECT_EQ(fault_of([](vehicle::Sensor& s) { s.range_min_mm = s.range.mm() - 1; }), "");
  EXPECT_EQ(fault_of([](vehicle::Sensor& s) { s.no_return_clears_mm = s.range.mm(); }), "");
}

TEST(FieldLimits, ABeamIsAsLongAsItsRangeAlongEachAxis) {
  using vehicle::EndCoordinate;
  using vehicle::Layer;
  for (EndCoordinate Layer::*const axis : {&Layer::x, &Layer::y, &Layer::z}) {
    for (std::int32_t EndCoordinate::*const part :
         {&EndCoordinate::forward, &EndCoordinate::left}) {
      for (const std::int32_t sign : {1, -1}) {
        EXPECT_EQ(fault_with([&](Changed& c) {
                    std::int32_t& end = c.sensors[0].layers[2].*axis.*part;
                    end = sign * (std::abs(end) + 9'000'000);
                  }),
                  "0.mount");
      }
    }
  }
}

// A height band below the car is met as long as the lowest end of a tilted unit's beams is in it.
TEST(FieldLimits, SomeBeamMeetsTheBandHoweverFarItSwings) {
  const auto fault_of_top = [](std::int32_t over_lowest) {
    return fault_with(
        [&](Changed& c) {
          std::int64_t lowest = INT64_MAX;
          for (std::size_t i = 0; i < c.sensors[0].layer_count; ++i) {
            const vehicle::EndCoordinate& z = c.sensors[0].layers[i].z;
            lowest =
                std::min<std::int64_t>(lowest, z.base - std::abs(z.forward) - std::abs(z.left));
          }
          c.car.z_max = static_cast<std::int32_t>(lowest >> 10) + over_lowest;
          c.car.z_min = c.car.z_max - 1'000;
          c.sensors[0].moved = {};
        },
        "roof_ld_mrs");
  };
  EXPECT_EQ(fault_of_top(1), "");
  EXPECT_EQ(fault_of_top(-1), "0.mount.z_m");
}

}  // namespace
}  // namespace iog::car_block
