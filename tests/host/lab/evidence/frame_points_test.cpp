// The grids that follow from a drive's points are those that the target's pipeline sends of it.
#include "lab/evidence/frame_points.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <iterator>
#include <memory>

#include "lab/evidence/fusion_rules.hpp"
#include "lab/evidence/projection.hpp"
#include "lab/evidence/values.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/fuse/offline_target.hpp"

namespace iog::lab {
namespace {

using Grids = std::vector<std::vector<std::int32_t>>;
using Datagrams = std::vector<tools::CapturedDatagram>;

// The frames with evidence of the target's own pipeline.
Grids grids_of_target(const tools::CatalogueEntry& car, const Datagrams& datagrams) {
  Grids grids;
  tools::FrameAssembler assembler([&](const tools::GridFrame& frame) {
    if (frame.header.has_evidence()) {
      grids.emplace_back(frame.cells.begin(), frame.cells.end());
    }
  });
  const auto target = std::make_unique<tools::OfflineTarget>(
      *car.vehicle, [&](std::span<const std::byte> message) { assembler.take(message); });
  for (const tools::CapturedDatagram& datagram : datagrams) {
    if (tools::sensor_of_port(car, datagram.destination.port) < car.sensors.size()) {
      static_cast<void>(target->take(datagram));
    }
  }
  target->finish();
  assembler.finish();
  return grids;
}

Grids grids_of_points(const tools::CatalogueEntry& car, const std::vector<FramePoints>& frames) {
  const auto values = indexes(probabilities({}), 0.05, index::Quantisation::kBlurring);
  Grids grids;
  for (const FramePoints& points : frames) {
    grids.push_back(fuse_indexes(project(*car.vehicle, points), values, IndexRule::kHitsWin, 127));
  }
  return grids;
}

TEST(FramePoints, ADriveHasTheFramesOfTheTarget) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  tools::Drive drive(car, 3, 1);
  Datagrams datagrams;
  std::vector<FramePoints> frames;
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    std::ranges::move(drive.datagrams(frame), std::back_inserter(datagrams));
    frames.push_back(points_of(drive, frame, car));
  }
  EXPECT_EQ(grids_of_points(car, frames), grids_of_target(car, datagrams));
}

}  // namespace
}  // namespace iog::lab
