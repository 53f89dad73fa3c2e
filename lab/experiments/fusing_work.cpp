#include "lab/experiments/fusing_work.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "intake/packet.hpp"
#include "vehicle/beam.hpp"

namespace iog::lab {
namespace {

constexpr double kGridM = 102.4;
constexpr double kSubcellsPerM = geometry::kResolution * 1000.0 / geometry::kCellMm;

// One axis of a walk from square to square.
struct AxisWalk {
  AxisWalk(double from, double to, double side)
      : square(static_cast<std::int32_t>(std::floor(from / side))),
        last(static_cast<std::int32_t>(std::floor(to / side))),
        step(to < from ? -1 : 1) {
    if (square != last) {
      const double border = (square + (step > 0 ? 1 : 0)) * side;
      next = (border - from) / (to - from);
      each = side / std::abs(to - from);
    }
  }
  void go() {
    square += step;
    next = square == last ? std::numeric_limits<double>::infinity() : next + each;
  }

  std::int32_t square;
  std::int32_t last;
  std::int32_t step;
  double next = std::numeric_limits<double>::infinity();  // share of the way at the next border
  double each = 0;
};

// The line of a point on the plane, from the sensor to where it carves at last.
Way2 way_of(const vehicle::Sensor& sensor, const vehicle::Beam& beam, double share) {
  const auto metres = [](std::int64_t subcells) {
    return static_cast<double>(subcells) / kSubcellsPerM - kGridM / 2;
  };
  const auto along = [](const auto& axis) {
    return static_cast<double>(axis.step()) * static_cast<double>(axis.length()) / kSubcellsPerM;
  };
  const double x = metres(sensor.origin.x);
  const double y = metres(sensor.origin.y);
  return {x, y, x + share * along(beam.line.x()), y + share * along(beam.line.y())};
}

double value_of(const traversal::Share& share) {
  return static_cast<double>(share.numerator) / static_cast<double>(share.denominator);
}

// How far along its line a point carves, and marks, as a share of the line; 0: not at all.
struct Reach {
  double carves = 0;
  double marks = 0;
};

Reach reach_of(const vehicle::Vehicle& car, const vehicle::Sensor& sensor,
               const vehicle::Beam& beam, const lidar::ScanPoint& point) {
  const auto its = vehicle::classify(sensor, beam, point);
  const std::uint32_t along_mm = sensor.layers[point.layer].along_line_mm(point.range_mm);
  const std::uint32_t to_mm = std::min(along_mm, sensor.range.mm());
  const double share = static_cast<double>(to_mm) / sensor.range.mm();
  Reach reach{.carves = its.carves ? share : 0, .marks = its.marks ? share : 0};
  if (its.carves && !its.is_whole_in_band) {
    const vehicle::BandPart part = vehicle::part_in_band(car, sensor, beam.end_z, to_mm);
    if (!part.is_whole) {
      reach.carves = part.is_empty ? 0 : std::min(share, value_of(part.to));
    }
  }
  return reach;
}

class Collector {
 public:
  Collector(const tools::CatalogueEntry& car, const BlockPlane& plane)
      : car_(car.vehicle), plane_(plane) {}

  void add(std::size_t sensor_number, const lidar::ScanPoint& point) {
    const vehicle::Sensor& sensor = car_->sensors[sensor_number];
    const std::uint32_t step = sensor.azimuths.nearest(point.azimuth_ticks);
    const auto [at, is_new] =
        places_.try_emplace(std::pair(sensor_number, step), work_.lines.size());
    if (is_new) {
      work_.lines.push_back({sensor_number, work_.packets, step, 0, {}, {}});
      farthest_.emplace_back();
    }
    LineWork& line = work_.lines[at->second];
    ++line.points;
    const vehicle::Beam beam = vehicle::aim(sensor, point.layer, point.azimuth_ticks);
    const Reach reach = reach_of(*car_, sensor, beam, point);
    Farthest& farthest = farthest_[at->second];
    if (reach.carves > farthest.share) {
      farthest = {reach.carves, way_of(sensor, beam, reach.carves)};
    }
    if (reach.marks > 0) {
      const Way2 way = way_of(sensor, beam, reach.marks);
      const auto hit = blocks_on(plane_, {way.x1, way.y1, way.x1, way.y1});
      line.marks.insert(line.marks.end(), hit.begin(), hit.end());
    }
  }
  void end_packet() { ++work_.packets; }

  [[nodiscard]] FusingWork finish() {
    for (std::size_t i = 0; i < work_.lines.size(); ++i) {
      if (farthest_[i].share > 0) {
        work_.lines[i].blocks = blocks_on(plane_, farthest_[i].way);
      }
    }
    return std::move(work_);
  }

 private:
  struct Farthest {
    double share = 0;
    Way2 way;
  };

  const vehicle::Vehicle* car_;
  BlockPlane plane_;
  FusingWork work_;
  std::vector<Farthest> farthest_;
  std::map<std::pair<std::size_t, std::uint32_t>, std::size_t> places_;
};

}  // namespace

std::int32_t BlockPlane::side() const {
  return static_cast<std::int32_t>(std::lround(kGridM / block_m()));
}

std::uint32_t BlockPlane::tile_row_of(std::uint32_t block) const {
  return block / static_cast<std::uint32_t>(side()) / 8;
}

std::uint32_t BlockPlane::tile_of(std::uint32_t block) const {
  const std::uint32_t column = block % static_cast<std::uint32_t>(side()) / 8;
  return tile_row_of(block) * tile_rows() + column;
}

std::uint32_t BlockPlane::tile_count() const { return tile_rows() * tile_rows(); }

std::vector<std::uint32_t> blocks_on(const BlockPlane& plane, const Way2& way) {
  const std::int32_t side = plane.side();
  AxisWalk x(way.x0 + kGridM / 2, way.x1 + kGridM / 2, plane.block_m());
  AxisWalk y(way.y0 + kGridM / 2, way.y1 + kGridM / 2, plane.block_m());
  std::vector<std::uint32_t> blocks;
  const auto visit = [&] {
    if (x.square >= 0 && y.square >= 0 && x.square < side && y.square < side) {
      blocks.push_back(static_cast<std::uint32_t>(y.square * side + x.square));
    }
  };
  visit();
  while (x.square != x.last || y.square != y.last) {
    (x.next < y.next ? x : y).go();
    visit();
  }
  return blocks;
}

FusingWork work_of(const tools::CatalogueEntry& car,
                   const std::vector<tools::CapturedDatagram>& datagrams, const BlockPlane& plane) {
  Collector collector(car, plane);
  for (const tools::CapturedDatagram& datagram : datagrams) {
    const std::size_t number = tools::sensor_of_port(car, datagram.destination.port);
    if (number == car.sensors.size()) {
      continue;
    }
    const vehicle::Sensor& sensor = car.vehicle->sensors[number];
    const auto packet = intake::Packet::decode(sensor.format, datagram.payload, sensor.unit());
    packet.for_each_point([&](const lidar::ScanPoint& point) { collector.add(number, point); });
    collector.end_packet();
  }
  return collector.finish();
}

void append(FusingWork& to, const FusingWork& more, std::size_t sensors_before) {
  for (LineWork line : more.lines) {
    line.sensor += sensors_before;
    line.packet += to.packets;
    to.lines.push_back(std::move(line));
  }
  to.packets += more.packets;
}

}  // namespace iog::lab
