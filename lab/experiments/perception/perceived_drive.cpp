#include "lab/experiments/perception/perceived_drive.hpp"

#include <deque>
#include <memory>

#include "fusion/frame_fusion.hpp"
#include "intake/measurement_time.hpp"
#include "intake/packet.hpp"
#include "lab/experiments/keyed_car.hpp"
#include "lab/experiments/perceiver.hpp"
#include "placing/frame_evidence.hpp"
#include "require/require.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

using Datagrams = std::vector<tools::CapturedDatagram>;

// The slices of a frame fused again, for the evidence that the classes were made of.
class Evidence {
 public:
  explicit Evidence(const tools::CatalogueEntry& car) : car_(&car), fusion_(*car.vehicle) {}

  static geometry::Cell first_cell(const window::Area& area) {
    return {area.corner().a * window::kTileSide, area.corner().b * window::kTileSide};
  }

  // is_shown: with the frame's joined indexes.
  void find(const Datagrams& datagrams, const window::Area& area, bool is_shown,
            PerceivedFrame& frame) {
    const std::span<const fusion::PlacedSlice> slices = frame.engine->slices();
    for (std::size_t i = 0; i < slices.size(); ++i) {
      const fusion::PlacedSlice& slice = slices[i];
      fuse(datagrams, slice.slice);
      const placing::Placement at = placing::placement_of(slice.pose);
      add_hits(area, placing::CellMap::to_window(area, at), static_cast<std::uint8_t>(i), frame);
      fusion_.release([this](std::size_t tile, auto indexes) { cells_.set(tile, indexes); });
      if (is_shown) {
        joined_.add(cells_, area, at);
      }
      cells_.clear();
    }
    if (is_shown) {
      frame.evidence = rows_of(area, [this](std::size_t slot, auto& tile) {
        tile = joined_.tile(slot);
        return joined_.is_touched(slot);
      });
      joined_.clear();
    }
  }

 private:
  void fuse(const Datagrams& datagrams, const pose::Slice& slice) {
    const pose::Slicing slicing;
    for (const tools::CapturedDatagram& datagram : datagrams) {
      const std::size_t sensor = tools::sensor_of_port(*car_, datagram.destination.port);
      const vehicle::Sensor& described = car_->vehicle->sensors[sensor];
      const intake::Packet packet = intake::Packet::decode(described.format, datagram.payload);
      if (slicing.slice_of(intake::measured_us(described, packet.info(), 0)) == slice) {
        packet.for_each_point(
            [&](const lidar::ScanPoint& point) { fusion_.add(described, point); });
      }
    }
    fusion_.finish();
  }

  void add_hits(const window::Area& area, const placing::CellMap& to_window, std::uint8_t slice,
                PerceivedFrame& frame) {
    const geometry::Cell first = first_cell(area);
    const grid::BlockGrid& view = fusion_.view();
    std::array<std::int8_t, geometry::kTileCells> cells{};
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      if (!view.is_touched(tile) || !view.copy_tile(tile, cells)) {
        continue;
      }
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i] <= 0) {
          continue;
        }
        const auto x = static_cast<std::int32_t>(
            tile % geometry::kTilesPerSide * geometry::kTileSide + i % geometry::kTileSide);
        const auto y = static_cast<std::int32_t>(
            tile / geometry::kTilesPerSide * geometry::kTileSide + i / geometry::kTileSide);
        const geometry::Cell at = to_window.exact({x, y}).cell();
        if (window::kWindowCells.contains(at)) {
          frame.hits.push_back({{first.x + at.x, first.y + at.y}, slice});
        }
      }
    }
  }

  const tools::CatalogueEntry* car_;
  fusion::FrameFusion fusion_;
  placing::SliceCells cells_;
  placing::FrameEvidence joined_;
};

}  // namespace

void perceive_drive(const PerceivedDrive& drive, std::span<const PerceptionRule> rules,
                    const std::function<void(const PerceivedFrame&)>& use) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  tools::Drive moving(car, drive.seed, drive.seconds, tools::find_scene(drive.scene),
                      tools::Motion::kContinuous);
  tools::PoseFeed poses(
      tools::simulated_poses(moving.scene(), drive.poses, drive.seed, drive.seconds + 0.1));
  std::deque<KeyedCar> cars;
  std::vector<std::unique_ptr<Perceiver>> perceivers;
  for (const PerceptionRule& rule : rules) {
    cars.emplace_back(*car.vehicle, Keys{.moved = rule.moved, .has_objects = rule.has_objects},
                      rule.rules);
    perceivers.push_back(std::make_unique<Perceiver>(cars.back().vehicle(), rule.map));
  }
  const auto evidence = std::make_unique<Evidence>(car);  // too large for the stack
  for (std::uint32_t number = 0; number < moving.frame_count(); ++number) {
    const Datagrams datagrams = moving.datagrams(number);
    for (const tools::CapturedDatagram& datagram : tools::with_poses(datagrams, poses)) {
      for (const auto& perceiver : perceivers) {
        perceiver->take(datagram);
      }
    }
    const Perceiver& first = *perceivers.front();
    require(first.frames() == number + 1);  // the last packet of a frame closes it
    PerceivedFrame frame{
        .number = number, .drive = &moving, .engine = &first.engine(), .end = &first.end()};
    frame.window.first = Evidence::first_cell(first.area());
    const bool is_shown = drive.has_evidence && number % drive.shown_every == drive.shown_every - 1;
    if (drive.has_evidence) {
      evidence->find(datagrams, first.area(), is_shown, frame);
    }
    for (const auto& perceiver : perceivers) {
      frame.objects.push_back(&perceiver->objects());
      if (is_shown) {
        frame.classes.push_back(perceiver->classes());
      }
    }
    use(frame);
  }
}

}  // namespace iog::lab
