#include "lab/experiments/hills/scored_returns.hpp"

#include <algorithm>
#include <utility>

#include "intake/measurement_time.hpp"
#include "intake/packet.hpp"
#include "require/require.hpp"
#include "vehicle/beam.hpp"

namespace iog::lab {
namespace {

using tools::PointClass;

// From the car's origin to the cell's centre.
std::uint8_t range_of(geometry::Cell cell) {
  const double x_m = (cell.x - geometry::kOriginCell + 0.5) * geometry::kCellMm / 1000.0;
  const double y_m = (cell.y - geometry::kOriginCell + 0.5) * geometry::kCellMm / 1000.0;
  const double squared = x_m * x_m + y_m * y_m;
  return static_cast<std::uint8_t>(std::ranges::count_if(
      kReturnRangesM, [&](double edge_m) { return squared >= edge_m * edge_m; }));
}

bool marks(vehicle::Fate fate) {
  return fate == vehicle::Fate::kUsed || fate == vehicle::Fate::kLaterEcho;
}

}  // namespace

void Seen::look(const tools::Drive& drive, std::uint32_t frame) {
  for (const tools::Solid& solid : drive.solids(frame)) {
    materials_.try_emplace(solid.thing, solid.material);
  }
}

std::optional<ReturnOn> Seen::on(const tools::PointTruth& truth) const {
  switch (truth.what) {
    case PointClass::kGround: {
      const bool is_road = ground_.at(truth.at.x, truth.at.y) == tools::Ground::kRoad;
      return ReturnOn{.what = is_road ? What::kRoad : What::kBeside};
    }
    case PointClass::kMoving:
    case PointClass::kMovable:
    case PointClass::kInfrastructure:
      if (truth.height_m >= kLowestM && truth.height_m <= kHighestM) {
        const auto material = materials_.find(truth.thing);
        require(material != materials_.end());
        return ReturnOn{.what = truth.what == PointClass::kMoving ? What::kMoving : What::kStanding,
                        .material = material->second};
      }
      break;
    case PointClass::kClutter:
    case PointClass::kNothing:
      break;
  }
  return std::nullopt;
}

SeenPacket Seen::of(tools::SimulatedPacket&& packet) const {
  SeenPacket seen;
  seen.datagram = std::move(packet.datagram);
  const std::uint16_t port = seen.datagram.destination.port;
  const auto sensor = std::ranges::find(vehicle_->sensors, port, &vehicle::Sensor::udp_port);
  require(sensor != vehicle_->sensors.end());
  const intake::Packet decoded =
      intake::Packet::decode(sensor->format, seen.datagram.payload, sensor->unit());
  const std::uint64_t measured_us =
      intake::measured_us(*sensor, decoded.info(), seen.datagram.time_us);
  seen.slice = pose::Slicing(vehicle_->poses.log2_slice_ms).slice_of(measured_us);
  std::size_t number = 0;
  decoded.for_each_point([&](const lidar::ScanPoint& point) {
    const std::size_t own = number++;
    const tools::PointTruth& truth = packet.points.at(own);
    const std::uint32_t along_mm = sensor->layers[point.layer].along_line_mm(point.range_mm);
    if (point.range_mm < sensor->range_min_mm || along_mm > sensor->range.mm()) {
      return;
    }
    const std::optional<ReturnOn> what = on(truth);
    const vehicle::Beam beam = vehicle::aim(*sensor, point.layer, point.azimuth_ticks);
    const geometry::Cell cell = beam.line.cell(beam.line.through(along_mm, sensor->range));
    if (what && geometry::kGridArea.contains(cell)) {
      seen.returns.push_back({.point = own, .cell = cell, .range = range_of(cell), .on = *what});
    }
  });
  require(number == packet.points.size());
  return seen;
}

Listener::Listener(const vehicle::Vehicle& car, const Keys& keys, std::uint64_t scored_from_us)
    : car_(car, keys),
      scored_from_us_(scored_from_us),
      fates_(car_.vehicle()),
      perceiver_(car_.vehicle(), {},
                 [this](const Perceiver& perceiver) { score_frame(perceiver); }) {}

// The packet may close the frame that it is in.
void Listener::take(const SeenPacket& packet) {
  const std::vector<vehicle::Fate>& fates = fates_.take(packet.datagram);
  if (packet.datagram.time_us >= scored_from_us_) {
    waiting_.push_back({packet.datagram.time_us, packet.slice, packet.returns, false});
    for (SeenReturn& seen : waiting_.back().returns) {
      seen.on.is_marked = seen.point < fates.size() && marks(fates[seen.point]);
    }
  }
  perceiver_.take(packet.datagram);
  note_taken();
}

// A packet that closes the frame before its own may be in the slice in which that one has ended.
void Listener::note_taken() {
  if (!waiting_.empty() && perceiver_.has_fused_newest()) {
    waiting_.back().is_taken = true;
  }
}

void Listener::score_frame(const Perceiver& perceiver) {
  const std::vector<std::int8_t> classes = perceiver.classes();
  const auto placed = perceiver.engine().slices();
  note_taken();
  std::erase_if(waiting_, [&](const Waiting& packet) {
    const auto slice = std::ranges::find(placed, packet.slice, &fusion::PlacedSlice::slice);
    if (slice == placed.end() || !packet.is_taken) {
      return false;
    }
    score(packet, placing::CellMap::to_window(perceiver.area(), placing::placement_of(slice->pose)),
          classes);
    return true;
  });
  while (!waiting_.empty() && waiting_.back().time_us - waiting_.front().time_us > kLostUs) {
    waiting_.pop_front();
    ++lost_;
  }
}

void Listener::score(const Waiting& packet, const placing::CellMap& to_window,
                     std::span<const std::int8_t> classes) {
  for (const SeenReturn& seen : packet.returns) {
    const geometry::Cell cell = to_window.exact(seen.cell).cell();
    if (window::kWindowCells.contains(cell)) {
      scores_[seen.on][seen.range].add(
          said_by(classes[static_cast<std::size_t>(cell.y) * window::kCellsAcross +
                          static_cast<std::size_t>(cell.x)]));
    }
  }
}

}  // namespace iog::lab
