// What is counted of a drive through hills: the same returns whatever a target makes of them, once
// each, and what it marks by what is true of them.
#include "lab/experiments/hills/scored_returns.hpp"

#include <gtest/gtest.h>
#include <utility>

#include "tools/formats/capture/made_capture.hpp"
#include "tools/simulate/drives/pose_source.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

constexpr std::uint64_t kSeed = 4;
constexpr std::uint32_t kSeconds = 2;
constexpr Keys kFollows{.ground = {.low_mm = 220, .top_mm = 2'200}};

struct Shares {
  std::uint64_t returns = 0;
  std::uint64_t marked = 0;
  [[nodiscard]] double percent() const {
    return 100.0 * static_cast<double>(marked) / static_cast<double>(returns);
  }
};

Shares of(const ReturnScores& scores, What what) {
  Shares shares;
  for (const auto& [on, ranges] : scores) {
    for (const SaidCounts& said : ranges) {
      shares.returns += on.what == what ? said.all() : 0;
      shares.marked += on.what == what && on.is_marked ? said.all() : 0;
    }
  }
  return shares;
}

TEST(ScoredReturns, AreTheSameWhateverATargetMakesOfThem) {
  const tools::CatalogueEntry& car = tools::find_vehicle("roof_vlp16");
  tools::Drive drive(car, kSeed, kSeconds, tools::find_scene("hills"), tools::Motion::kContinuous);
  tools::PoseFeed poses(tools::simulated_poses(drive.scene(), {}, kSeed, kSeconds));
  Listener band(*car.vehicle, {}, tools::kDriveStartUs);
  Listener ground(*car.vehicle, kFollows, tools::kDriveStartUs);
  const KeyedCar synchronised(*car.vehicle, {});
  Seen seen(synchronised.vehicle(), drive.scene());
  std::uint64_t on_road = 0;
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    seen.look(drive, frame);
    for (tools::SimulatedPacket& simulated : drive.packets(frame)) {
      const SeenPacket packet = seen.of(std::move(simulated));
      for (const SeenReturn& one : packet.returns) {
        on_road += one.on.what == What::kRoad ? 1U : 0U;
      }
      for (const tools::CapturedDatagram& pose : poses.take_until(packet.datagram.time_us)) {
        band.take(pose);
        ground.take(pose);
      }
      band.take(packet);
      ground.take(packet);
    }
  }
  for (const What what : {What::kRoad, What::kBeside, What::kStanding, What::kMoving}) {
    EXPECT_EQ(of(band.scores(), what).returns, of(ground.scores(), what).returns);
  }
  // What was sent before the third pose, and the frame that is open at the end, are not placed.
  EXPECT_LT(of(band.scores(), What::kRoad).returns, on_road);
  EXPECT_GT(of(band.scores(), What::kRoad).returns, on_road * 9 / 10);
  // The road climbs into the band.
  EXPECT_GT(of(band.scores(), What::kRoad).percent(), 10);
  EXPECT_LT(of(ground.scores(), What::kRoad).percent(), 3);
  EXPECT_GT(of(ground.scores(), What::kMoving).percent(), 80);
}

}  // namespace
}  // namespace iog::lab
