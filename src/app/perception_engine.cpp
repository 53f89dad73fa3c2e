#include "app/perception_engine.hpp"

#include <algorithm>
#include <utility>

#include "intake/measurement_time.hpp"
#include "require/require.hpp"

namespace iog::app {

static_assert(grid::kMaxMarks >= kMaxFrameMarks, "a frame's marks fit, too");

Unfit unfit_for_perception(const vehicle::Vehicle& vehicle) {
  if (vehicle.rule != vehicle::FusionRule::kHitsWin) {
    return Unfit::kFusionRule;
  }
  return vehicle.quantisation == index::Quantisation::kBlurring ? Unfit::kNone
                                                                : Unfit::kQuantisation;
}

PerceptionEngine::PerceptionEngine(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4)
    : frame_(vehicle, replayer_ipv4),
      window_(vehicle.window),
      shared_(vehicle),
      maps_(vehicle.maps, replayer_ipv4),
      poses_(vehicle.poses, replayer_ipv4),
      packets_(vehicle.sensors),
      vehicle_(&vehicle) {
  require(unfit_for_perception(vehicle) == Unfit::kNone);
  report_.log2_slice_ms = vehicle.poses.log2_slice_ms;
}

std::optional<intake::SensorPacket> PerceptionEngine::receive(const intake::Datagram& datagram,
                                                              std::uint64_t now_us) {
  if (poses_.listens_to(datagram.destination_port)) {
    static_cast<void>(poses_.receive(datagram.source_ipv4, datagram.payload, now_us));
    return std::nullopt;
  }
  if (maps_.listens_to(datagram.destination_port)) {
    static_cast<void>(maps_.receive(datagram.source_ipv4, datagram.payload, now_us));
    return std::nullopt;
  }
  return frame_.receive(datagram);
}

PerceptionEngine::Outcome PerceptionEngine::classify(const intake::SensorPacket& packet) {
  const Outcome outcome = frame_.classify(packet);
  if (outcome == Outcome::kThisFrame && !packets_.fits(packet)) {
    frame_.refuse(packet);
    return Outcome::kDropped;
  }
  return outcome;
}

// A VLP-16 counts from the hour, and the newest pose says of which.
void PerceptionEngine::fuse(const intake::SensorPacket& packet, std::uint64_t now_us,
                            const work::Crew& /*crew*/) {
  frame_.accept(packet, now_us);
  const vehicle::Sensor& sensor = vehicle_->sensors[packet.sensor];
  const std::optional<pose::Message> newest = poses_.newest();
  packets_.keep(packet, sensor.is_synchronised ? intake::measured_us(sensor, packet.packet.info(),
                                                                     newest ? newest->clock_us : 0)
                                               : now_us - sensor.latency_us);
}

// The slices of the frame, each with its place, and the frame's stamp. When the poses break off,
// the window is unknown.
void PerceptionEngine::open_slices(std::uint64_t now_us) {
  const std::optional<std::uint64_t> end_us =
      slices_.measure(vehicle_->sensors, packets_.packets(), poses_);
  if (!end_us) {
    poses_.pass_silence(now_us);
  }
  std::optional<std::uint64_t> time_us = poses_.source_time(now_us);
  if (time_us) {
    time_us = window::end_of_frame(end_us, *time_us, poses_.newest()->clock_us);
  }
  if (contradiction_.is_met()) {
    poses_.contradict();
  }
  if (time_us) {
    poses_.pass(*time_us);
  }
  report_.is_forgotten = std::exchange(epoch_, poses_.epoch()) != poses_.epoch();
  if (report_.is_forgotten) {
    window_.forget();
    contradiction_.clear();
  }
  clock_.end_frame(time_us, report_.is_forgotten, now_us);
  report_.stamp_us = clock_.stamp_us();
  slices_.place(packets_.packets(), poses_);
  report_slices();
  report_causes();
  if (report_.slice_count > 0) {
    time_us = slices_.placed().back().slice.end_us;
    window_.follow(slices_.placed().back().pose);
  }
  report_.end = time_us ? poses_.pose_at(*time_us) : pose::Placed{};
}

void PerceptionEngine::report_slices() {
  report_.packets_placed = 0;
  report_.slice_count = slices_.placed().size();
  report_.slices_over_budget = slices_.over_budget();
  std::ranges::copy(slices_.placed(), report_.slices.begin());
}

// The report still has the counts of the frame before.
void PerceptionEngine::report_causes() {
  unsigned causes = 0;
  for (std::size_t cause = 0; cause < pose::kCauseCount; ++cause) {
    const pose::Tally tally = poses_.tally(static_cast<pose::Cause>(cause));
    const bool is_met = tally.times != report_.tallies[cause].times ||
                        poses_.slices()[cause] != report_.slice_causes[cause];
    causes |= is_met ? 1U << cause : 0U;
    report_.tallies[cause] = tally;
  }
  constexpr unsigned kPlaced = 1U << static_cast<unsigned>(pose::Cause::kNone);
  report_.causes = static_cast<std::uint8_t>(causes & ~kPlaced);
  report_.pose_fates = poses_.fates();
  report_.slice_causes = poses_.slices();
}

// The points of a group's packets, and how many packets they are. What has no place is one group,
// because it only counts in the frame's own grid.
std::uint32_t PerceptionEngine::fuse_group(std::uint8_t group) {
  std::uint32_t packets = 0;
  const std::span<const KeptPacket> kept = packets_.packets();
  for (std::size_t number = 0; number < kept.size(); ++number) {
    if (kept[number].group == group) {
      frame_.add_points(kept[number].sensor, packets_.decoded(number));
      ++packets;
    }
  }
  return packets;
}

// Each tile is looked at once, while it is at hand.
void PerceptionEngine::join_group(std::size_t group) {
  frame_.finish();
  frame_.fusion().release([this, group](std::size_t tile, auto indexes) {
    joined_.add(tile, indexes);
    if (group != FrameSlices::kNowhere) {
      window_.take(tile, indexes);
    }
  });
}

// Those that were fused together.
void PerceptionEngine::place_slices(const work::Crew& crew) {
  for (auto fused = shared_.next_slices(crew); !fused.empty(); fused = shared_.next_slices(crew)) {
    std::array<window::PlacedCells, window::FrameEvidence::kMostAtOnce> placed;
    for (std::size_t i = 0; i < fused.size(); ++i) {
      const pose::Pose& pose = report_.slices[fused[i].group].pose;
      placed[i] = {.cells = fused[i].cells, .at = window::placement_of(pose)};
      report_.packets_placed += fused[i].packets;
    }
    window_.add(std::span(placed).first(fused.size()), crew);
  }
}

// The window has followed the vehicle, and another block comes into use only here.
void PerceptionEngine::lay_map() {
  maps_.work();
  const std::optional<pose::Message> newest = poses_.newest();
  const auto transform = newest ? newest->map : std::nullopt;
  if (window_.is_frame(report_.stamp_us)) {
    layer_.work(maps_.in_use(), transform, window_);
  } else {
    layer_.look(maps_.in_use(), transform, window_);
  }
  report_.map_block = maps_.in_use();
  report_.map = layer_.report();
  report_.map_delivery = maps_.report();
}

void PerceptionEngine::start_next(std::uint64_t now_us) {
  packets_.clear();
  frame_.start_next(now_us);
  report_.number = frame_.number();
}

}  // namespace iog::app
