// A unit whose points are sent as such is the same to the target as the unit itself: the drives of
// a VLP-16 and a LUX, each once in the unit's own packets and once in points made of them.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "../drive_sample.hpp"
#include "fakes/points_packet.hpp"
#include "fakes/temporary_folder.hpp"
#include "intake/packet.hpp"
#include "lidar/velodyne_vlp16.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/program/file.hpp"
#include "tools/vehicles/packet_points.hpp"

namespace iog::tools {
namespace {

constexpr int kDegree = 3'200;
constexpr std::size_t kMostPoints = 85;

// A car with one unit.
struct OwnUnit {
  std::string type;
  std::string of_points;  // its type, its numbers and its layers
  std::string common;
  int scan_ticks;
  std::vector<double> elevations_deg;  // by the unit's own layers
  bool is_exact = true;                // by directions: not a cell differs
};

const OwnUnit kVlp16{.type = "type = \"velodyne_vlp16\"\n",
                     .of_points =
                         "type = \"points_turning\"\nmax_points_per_scan = 30_000\n"
                         "layers = { from_deg = -15, to_deg = 15, count = 16 }\n",
                     .common = "mount = { x_m = 0, y_m = 0, z_m = 1.5 }\nground = false\n",
                     .scan_ticks = 36'000,
                     .elevations_deg{lidar::VelodyneVlp16::kElevationsDeg.begin(),
                                     lidar::VelodyneVlp16::kElevationsDeg.end()}};
const OwnUnit kLux{.type = "type = \"ibeo_lux\"\n",
                   .of_points =
                       "type = \"points\"\nscan_width_ticks = 3200\nrange_min_mm = 300\n"
                       "range_max_mm = 50_000\nprecision_mm = 100\nsigma_m = 0.10\n"
                       "layers = { from_deg = -1.2, to_deg = 1.2, count = 4 }\n",
                   .common =
                       "mount = { x_m = 2, y_m = 0, z_m = 0.5 }\n"
                       "max_points_per_scan = 4812\n",
                   .scan_ticks = 11'520,
                   .elevations_deg{-1.2, -0.4, 0.4, 1.2}};

// What it samples of a packet to see how the car is tilted, other samples of the same points say a
// little differently.
const OwnUnit kVlp16OnGround = [] {
  OwnUnit unit = kVlp16;
  unit.common.replace(unit.common.rfind("false"), 5, "{ low_m = 0.22, top_m = 2.20 }");
  unit.is_exact = false;
  return unit;
}();

class Equality : public ::testing::Test {
 protected:
  // The name of a car with that unit.
  std::string car(const std::string& name, const std::string& type, const OwnUnit& unit) {
    const std::string path = folder_ / (name + ".toml");
    OutputFile file(path);
    file.write("name = \"" + name +
               "\"\ngrids = \"indexes\"\nframe_period_us = 150_000\n"
               "footprint = { x_min_m = -2.2, x_max_m = 2.2, y_min_m = -0.9, y_max_m = 0.9 }\n"
               "[[sensors]]\nname = \"it\"\nudp_port = 2368\n" +
               type + unit.common);
    file.finish();
    return add_vehicle_file(path);
  }

  struct Frames {
    std::vector<std::uint32_t> crcs;
    std::vector<std::vector<index::OccupancyIndex>> cells;
    std::uint64_t points = 0;
  };

  static Frames fused(const CatalogueEntry& car, const std::vector<CapturedDatagram>& datagrams) {
    Frames frames;
    FrameAssembler assembler([&](GridFrame&& frame) {
      frames.crcs.push_back(grid_crc_of(frame));
      frames.cells.push_back(std::move(frame.cells));
      EXPECT_EQ(frame.header.packets_dropped, 0U);
    });
    for (const auto& message : messages_of(car, datagrams)) {
      assembler.take(message);
    }
    assembler.finish();
    return frames;
  }

  tests::TemporaryFolder folder_;
};

tests::SentPoint direction_of(const lidar::ScanPoint& point, const OwnUnit& unit) {
  const int flags = point.echo | (point.range_mm == 0 ? 4 : 0) | (point.is_ground ? 8 : 0) |
                    (point.is_dirt ? 16 : 0) | (point.is_rain ? 32 : 0);
  return {.first = std::int64_t{point.azimuth_ticks} * 360 * kDegree / unit.scan_ticks,
          .second = std::lround(unit.elevations_deg.at(point.layer) * kDegree),
          .third = point.range_mm,
          .flags = flags};
}

tests::SentPoint place_of(const lidar::ScanPoint& point, const OwnUnit& unit) {
  tests::SentPoint sent = direction_of(point, unit);
  const double azimuth = point.azimuth_ticks * 2 * std::numbers::pi / unit.scan_ticks;
  const double elevation = unit.elevations_deg.at(point.layer) * std::numbers::pi / 180;
  const double range = point.range_mm == 0 ? 10'000 : point.range_mm;
  sent.first = std::lround(range * std::cos(elevation) * std::cos(azimuth));
  sent.second = std::lround(range * std::cos(elevation) * std::sin(azimuth));
  sent.third = std::lround(range * std::sin(elevation));
  return sent;
}

// A packet as points. The frame shall end where it does with the unit's own packets, so the last
// datagram has all of their sector.
std::vector<CapturedDatagram> points_of(const CapturedDatagram& own, const vehicle::Sensor& sensor,
                                        const OwnUnit& unit, bool are_places) {
  const intake::Packet packet = intake::Packet::decode(sensor.format, own.payload, sensor.unit());
  EXPECT_TRUE(packet.is_sound());
  const lidar::PacketInfo& info = packet.info();
  std::vector<tests::SentPoint> points;
  for (const lidar::ScanPoint& point : tools::points_of(packet)) {
    points.push_back(are_places ? place_of(point, unit) : direction_of(point, unit));
  }
  const auto parts_of = [&](std::uint32_t ticks) {
    return static_cast<std::uint32_t>(std::uint64_t{ticks} * 360 * kDegree /
                                      static_cast<std::uint64_t>(unit.scan_ticks));
  };
  const std::size_t count =
      std::max<std::size_t>((points.size() + kMostPoints - 1) / kMostPoints, 1);
  std::vector<CapturedDatagram> datagrams;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_last = i + 1 == count;
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>(i * kMostPoints);
    const auto end = is_last ? points.end() : begin + kMostPoints;
    const tests::PointsPacket sent{.flags = are_places ? 1 : 0,
                                   .scan_number = info.scan_number,
                                   .number = static_cast<int>(i),
                                   .datagrams = static_cast<int>(count),
                                   .time_us = own.time_us + i,
                                   .sector_begin = parts_of(info.sector.first_ticks),
                                   .sector_width = is_last ? parts_of(info.sector.width_ticks) : 0,
                                   .points{begin, end}};
    datagrams.push_back(own);
    datagrams.back().payload = sent.bytes();
  }
  return datagrams;
}

// Of the cells that are known in both or in one, how many have the same sign.
double share_of_signs(const std::vector<std::vector<index::OccupancyIndex>>& one,
                      const std::vector<std::vector<index::OccupancyIndex>>& other) {
  std::uint64_t known = 0;
  std::uint64_t same = 0;
  const auto sign = [](int value) { return (value > 0) - (value < 0); };
  for (std::size_t frame = 0; frame < one.size(); ++frame) {
    for (std::size_t i = 0; i < one[frame].size(); ++i) {
      const int first = sign(one[frame][i]);
      const int second = sign(other.at(frame)[i]);
      known += first != 0 || second != 0 ? 1U : 0U;
      same += first != 0 && first == second ? 1U : 0U;
    }
  }
  return static_cast<double>(same) / static_cast<double>(known);
}

TEST_F(Equality, DirectionsHaveTheSameGridsAndPlacesTheSameSigns) {
  for (const OwnUnit* unit : {&kVlp16, &kVlp16OnGround, &kLux}) {
    const testing::ScopedTrace trace(__FILE__, __LINE__, unit->type);
    static_cast<void>(car("own_unit", unit->type, *unit));
    static_cast<void>(car("its_points", unit->of_points, *unit));
    const CatalogueEntry& own = find_vehicle("own_unit");
    const CatalogueEntry& of_points = find_vehicle("its_points");
    const std::vector<CapturedDatagram> packets = sample_drive(own, 1, 10, "city");
    const Frames expected = fused(own, packets);
    ASSERT_GE(expected.crcs.size(), 9U);
    for (const bool are_places : {false, true}) {
      std::vector<CapturedDatagram> datagrams;
      for (const CapturedDatagram& packet : packets) {
        std::ranges::move(points_of(packet, own.vehicle->sensors[0], *unit, are_places),
                          std::back_inserter(datagrams));
      }
      const Frames frames = fused(of_points, datagrams);
      ASSERT_EQ(frames.crcs.size(), expected.crcs.size());
      if (!are_places && unit->is_exact) {
        EXPECT_EQ(frames.crcs, expected.crcs);
      }
      const double share = share_of_signs(expected.cells, frames.cells);
      EXPECT_GE(share, unit->is_exact || !are_places ? 0.999 : 0.9985) << are_places;
    }
  }
}

}  // namespace
}  // namespace iog::tools
