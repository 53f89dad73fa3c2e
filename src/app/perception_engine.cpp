#include "app/perception_engine.hpp"

#include <array>
#include <utility>

#include "app/object_messages.hpp"
#include "intake/measurement_time.hpp"
#include "require/require.hpp"

namespace iog::app {
namespace {

constexpr std::array<std::pair<pose::Cause, std::uint16_t>, pose::kCauseCount - 1> kCauseFlags{{
    {pose::Cause::kLate, stream::kCauseLate},
    {pose::Cause::kImprecise, stream::kCauseImprecise},
    {pose::Cause::kLost, stream::kCauseLost},
    {pose::Cause::kJump, stream::kCauseJump},
    {pose::Cause::kRestart, stream::kCauseRestart},
    {pose::Cause::kContradicted, stream::kCauseContradicted},
    {pose::Cause::kDrifting, stream::kCauseDrifting},
}};

// Flags of the causes in `met`. Bit c stands for pose::Cause c. It is set if the cause has begun,
// or kept a slice from being registered, since the previous frame.
std::uint16_t causes_of(unsigned met, bool is_over_budget) {
  unsigned causes = is_over_budget ? stream::kCauseOverBudget : 0U;
  for (const auto& [cause, flag] : kCauseFlags) {
    causes |= (met >> static_cast<unsigned>(cause) & 1U) != 0 ? flag : 0U;
  }
  return static_cast<std::uint16_t>(causes);
}

}  // namespace

Unfit unfit_for_perception(const vehicle::Vehicle& vehicle) {
  if (vehicle.rule != vehicle::FusionRule::kHitsWin) {
    return Unfit::kFusionRule;
  }
  return vehicle.quantisation == index::Quantisation::kBlurring ? Unfit::kNone
                                                                : Unfit::kQuantisation;
}

PerceptionEngine::PerceptionEngine(Frame& frame, const vehicle::Vehicle& vehicle,
                                   std::uint32_t replayer_ipv4)
    : fused_(vehicle.grid),
      window_(vehicle.window, vehicle.has_objects, vehicle.grid.cell_mm),
      maps_(vehicle.maps, replayer_ipv4),
      poses_(vehicle.poses, replayer_ipv4, vehicle.depends_on_arrival()),
      receptions_(vehicle.depends_on_arrival()),
      frame_(&frame),
      vehicle_(&vehicle) {
  require(unfit_for_perception(vehicle) == Unfit::kNone);
}

bool PerceptionEngine::receive(const intake::Datagram& datagram, std::uint64_t now_us) {
  if (poses_.listens_to(datagram.destination_port)) {
    const pose::Fate fate = poses_.receive(datagram.source_ipv4, datagram.payload, now_us);
    if (fate != pose::Fate::kStranger) {
      receptions_.add(datagram, now_us);
    }
    return true;
  }
  if (maps_.listens_to(datagram.destination_port)) {
    static_cast<void>(maps_.receive(datagram.source_ipv4, datagram.payload, now_us));
    return true;
  }
  if (receptions_.is_on() && frame_->listens_to(datagram)) {
    receptions_.add(datagram, now_us);
  }
  return false;
}

// A VLP-16 counts its time from the hour. The newest pose tells which hour.
void PerceptionEngine::keep(const intake::SensorPacket& packet, std::uint64_t now_us) {
  const vehicle::Sensor& sensor = vehicle_->sensors[packet.sensor];
  const std::optional<pose::Message> newest = poses_.newest();
  frame_->keep(packet, now_us,
               sensor.is_synchronised ? intake::measured_us(sensor, packet.packet.info(),
                                                            newest ? newest->clock_us : 0)
                                      : now_us - sensor.latency_us);
}

// Finds the slices of the frame, the position of each, and the frame's stamp. If the poses break
// off, all of the window becomes unknown.
void PerceptionEngine::open_slices(std::uint64_t now_us) {
  const std::span<fusion::KeptPacket> packets = frame_->fusion().packets().packets();
  const std::optional<std::uint64_t> end_us = slices_.measure(vehicle_->sensors, packets, poses_);
  if (!end_us) {
    poses_.pass_silence(now_us);
  }
  std::optional<std::uint64_t> time_us = poses_.source_time(now_us);
  if (time_us) {
    time_us = perception::end_of_frame(end_us, *time_us, poses_.newest()->clock_us);
  }
  if (contradiction_.is_met(poses_.has_moved(), vehicle_->grid.cell_mm)) {
    poses_.contradict();
  }
  if (time_us) {
    poses_.pass(*time_us);
  }
  is_forgotten_ = std::exchange(epoch_, poses_.epoch()) != poses_.epoch();
  if (is_forgotten_) {
    window_.forget();
    follower_.forget();
    contradiction_.clear();
  }
  clock_.end_frame(time_us, is_forgotten_, now_us);
  slices_.place(packets, poses_);
  if (!slices_.placed().empty()) {
    const fusion::PlacedSlice& last = slices_.placed().back();
    time_us = last.slice.end_us;
    window_.follow(last.pose);
  }
  end_ = time_us ? poses_.pose_at(*time_us) : pose::Placed{};
  const std::uint64_t half_us = std::uint64_t{500} << vehicle_->poses.log2_slice_ms;
  frame_end_us_ = vehicle_->has_objects && time_us && *time_us > half_us ? *time_us - half_us : 0;
  causes_before_ = std::exchange(causes_, poses_.cause_counts());
}

// Fuses the points of a group's packets. All unregistered packets form one group, because they only
// count in the frame's own grid.
void PerceptionEngine::fuse_group(std::uint8_t group) {
  fusion::SharedFusion& fusion = frame_->fusion();
  const std::span<const fusion::KeptPacket> kept = fusion.packets().packets();
  for (std::size_t number = 0; number < kept.size(); ++number) {
    if (kept[number].group == group) {
      fusion.fuse_alone(number);
    }
  }
}

// Each tile is read once, while it is in the cache.
void PerceptionEngine::join_group(std::size_t group) {
  placing::SliceCells& cells = fused_.one();
  cells.clear();
  frame_->fusion().join_alone(
      [&](std::size_t tile, auto indexes, const grid::TileBits& low_and_tall) {
        if (group != fusion::FrameSlices::kNowhere) {
          cells.set(tile, indexes, low_and_tall);
        }
      });
}

// Adds the slices of a round to the window.
void PerceptionEngine::place_slices(const work::Crew& crew) {
  fused_.begin(frame_->fusion());
  for (auto fused = fused_.next(crew); !fused.empty(); fused = fused_.next(crew)) {
    std::array<placing::PlacedCells, placing::FrameEvidence::kMostAtOnce> placed;
    for (std::size_t i = 0; i < fused.size(); ++i) {
      const pose::Pose& pose = slices_.placed()[fused[i].group].pose;
      placed[i] = {.cells = fused[i].cells,
                   .at = placing::placement_of(pose, vehicle_->grid),
                   .number = fused[i].group};
    }
    window_.add(std::span(placed).first(fused.size()), crew);
  }
}

// Call it after the window has followed the vehicle. A new map block comes into use only here.
void PerceptionEngine::lay_map() {
  maps_.work();
  const std::optional<pose::Message> newest = poses_.newest();
  const auto transform = newest ? newest->map : std::nullopt;
  if (window_.is_frame(clock_.stamp_us())) {
    layer_.work(maps_.in_use(), transform, window_);
  } else {
    layer_.look(maps_.in_use(), transform, window_);
  }
}

void PerceptionEngine::begin_following() {
  const std::span<const fusion::PlacedSlice> placed = slices_.placed();
  is_following_ = !placed.empty() && frame_end_us_ != 0;
  if (is_following_) {
    follower_.begin(frame_end_us_, placed, placed.back().pose, window_);
  }
}

void PerceptionEngine::look_at_hits(const work::Crew& crew) {
  if (is_following_) {
    follower_.look_at_hits(window_, crew);
  }
}

void PerceptionEngine::follow_objects() {
  object_counts_ = {};
  if (is_following_) {
    object_counts_ = follower_.follow(window_);
  } else if (frame_end_us_ != 0) {
    follower_.pass(frame_end_us_, window_);
  }
}

void PerceptionEngine::describe(stream::Header& header) const {
  const unsigned indexes = vehicle::have_indexes(vehicle_->grids) ? 0U : stream::kFlagNoIndexes;
  const unsigned objects = vehicle_->has_objects ? stream::kFlagObjects : 0U;
  const unsigned receptions = receptions_.is_on() ? stream::kFlagReceptions : 0U;
  header.flags = static_cast<std::uint8_t>(header.flags | stream::kFlagClasses | indexes | objects |
                                           receptions);
}

// If no slice was registered, the window's slices begin and end at the frame's stamp.
void PerceptionEngine::describe(stream::ClassEnd& end) const {
  slices_.describe(end);
  end.groups_fused = counts_.groups_fused;
  end.groups_left = counts_.groups_left;
  end.groups_refreshed = counts_.groups_refreshed;
  end.pose_fates = poses_.fates();
  for (std::size_t cause = 0; cause < pose::kCauseCount; ++cause) {
    end.causes[cause] = {.slices = causes_.slices[cause], .began = causes_.began[cause]};
  }
  end.map = {.layer = layer_.report(), .delivery = maps_.report()};
  if (maps_.in_use() != nullptr) {
    end.map.in_use = stream::in_use(*maps_.in_use());
  }
  const bool is_over_budget = end.slices_over_budget > 0 || counts_.groups_left > 0;
  const window::TileNumber corner = window_.view().area().corner();
  const std::uint64_t stamp_us = clock_.stamp_us();
  end.window = {.causes = causes_of(causes_.since(causes_before_), is_over_budget),
                .corner_a = corner.a,
                .corner_b = corner.b,
                .pose = end_.pose,
                .sigma = end_.sigma,
                .slices = end.slice_count,
                .slice_ms = static_cast<std::uint8_t>(1U << vehicle_->poses.log2_slice_ms),
                .slices_begin_us = stamp_us,
                .slices_end_us = stamp_us};
  if (!slices().empty()) {
    end.window.slices_begin_us =
        slices().front().slice.end_us - std::uint64_t{1000} * end.window.slice_ms;
    end.window.slices_end_us = slices().back().slice.end_us;
  }
}

void PerceptionEngine::list_objects(stream::ObjectList& list) const {
  app::list_objects(objects().tracks(), objects().time_us(), object_counts_,
                    {end_.pose.x_mm, end_.pose.y_mm}, list);
}

}  // namespace iog::app
