#include "app/grid_engine.hpp"

#include <algorithm>

#include "grid/pending_marks.hpp"

namespace iog::app {
namespace {

// More than any LUX sends in a scan, and less than a turn of any lidar that turns.
constexpr std::uint32_t kDensePoints = 16'384;

// A full part, in cells that its points can mark. A frame that marks as much as it can has a place
// for each of its parts.
constexpr std::size_t kPartMarks = grid::kMaxMarks / PartsFusion::kPlaces;
static_assert(kPartMarks * hal::kMaxCores <= kMaxFrameMarks);

}  // namespace

bool is_fused_together(const vehicle::Vehicle& vehicle) {
  return vehicle.rule == vehicle::FusionRule::kHitsWin &&
         std::ranges::any_of(vehicle.sensors, [](const vehicle::Sensor& sensor) {
           return sensor.max_points_per_scan > kDensePoints;
         });
}

// A frame stays as it was begun, whatever becomes of the cores meanwhile.
void GridEngine::fuse(const intake::SensorPacket& packet, std::uint64_t now_us,
                      const work::Crew& crew) {
  if (!frame_.is_begun()) {
    is_shared_ = may_share_ && !crew.is_one();
  }
  if (!is_shared_) {
    frame_.fuse(packet, now_us);
    return;
  }
  if (!has_room(packet, crew)) {
    frame_.refuse(packet);
    return;
  }
  if (!packets_.fits(packet)) {
    fuse_kept(crew);
  }
  frame_.accept(packet, now_us);
  packets_.keep(packet, now_us);
  if (packets_.marks() >= kPartMarks * crew.cores()) {
    fuse_kept(crew);
  }
}

// As one core says, which knows what all points before have marked: where that decides, they are
// fused first.
bool GridEngine::has_room(const intake::SensorPacket& packet, const work::Crew& crew) {
  const std::uint64_t needed = std::uint64_t{packet.packet.info().point_count} *
                               grid::max_marks_per_point(vehicle_->sensors[packet.sensor]);
  if (marks_ + packets_.marks() + needed > grid::kMaxMarks) {
    fuse_kept(crew);
  }
  return marks_ + packets_.marks() + needed <= grid::kMaxMarks;
}

void GridEngine::fuse_kept(const work::Crew& crew) {
  parts_.deal_evenly(packets_.packets(), crew.cores());
  const std::span<const FramePart> round = parts_.next_round();
  if (round.size() > PartsFusion::kPlaces - places_) {
    join(crew);
  }
  fused_.fuse(crew, parts_, round, packets_, frame_, places_);
  marks_ += fused_.marks(places_, round.size());
  places_ += round.size();
  packets_.clear();
}

void GridEngine::join(const work::Crew& crew) {
  fused_.join(crew, places_, joined_, !is_joined_);
  is_joined_ = true;
  places_ = 0;
}

void GridEngine::start_next(std::uint64_t now_us) {
  is_shared_ = false;
  is_joined_ = false;
  marks_ = 0;
  frame_.start_next(now_us);
}

}  // namespace iog::app
