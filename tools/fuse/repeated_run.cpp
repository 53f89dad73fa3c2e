#include "tools/fuse/repeated_run.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "tools/program/exit_status.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

std::string name_of(std::uint32_t frame) { return "frame " + std::to_string(frame); }

// Poses that came before the stream's first frame placed what nobody can repeat.
bool begins_in_the_middle(const GridFrame& frame, std::uint16_t pose_port) {
  const auto& fates = frame.classes->end.pose_fates;
  const std::uint64_t strangers = fates[static_cast<std::size_t>(pose::Fate::kStranger)];
  const std::uint64_t received = std::accumulate(fates.begin(), fates.end(), std::uint64_t{0});
  const auto listed =
      std::ranges::count(frame.receptions->all, pose_port, &stream::Reception::port);
  return received - strangers > static_cast<std::uint64_t>(listed);
}

}  // namespace

void RepeatedRun::add(const GridFrame& frame) {
  const std::uint32_t number = frame.header.frame_number;
  if (frame.header.vehicle_id != vehicle_->id) {
    throw CheckFailed("the stream is of another car: " + words_of_vehicle(frame.header.vehicle_id));
  }
  if (!frame.header.has_receptions()) {
    throw CheckFailed(
        std::string("the stream does not say what its target received") +
        (!vehicle::have_classes(vehicle_->grids)
             ? ": its car has no classes, and without --as-received its grids are the same"
         : !vehicle_->depends_on_arrival()
             ? ": the clocks of its car's sensors are those of the poses, so leave "
               "--as-received away"
             : ""));
  }
  if (!frame.receptions || !frame.has_end || !frame.classes || !frame.classes->has_end) {
    throw CheckFailed(name_of(number) +
                      " of the stream is not whole: nobody knows what its target "
                      "received");
  }
  if (frame.receptions->not_listed > 0) {
    throw CheckFailed(name_of(number) + ": its target received more than it has room to list");
  }
  if (frames_.empty()) {
    if (begins_in_the_middle(frame, vehicle_->poses.udp_port)) {
      throw CheckFailed("the stream begins in the middle of its target's run, at " +
                        name_of(number) + ": record it from the target's start");
    }
    run_number_ = frame.header.run_number;
    opened_us_ = frame.end.opened_us;
  } else if (frame.header.run_number != run_number_) {
    throw CheckFailed("the stream is of two runs: its target started anew at " + name_of(number));
  } else if (number != frames_.back().number + 1) {
    throw CheckFailed("no message has come of " + name_of(frames_.back().number + 1));
  }
  frames_.push_back(
      {.number = number, .closed_us = frame.header.closed_us, .receptions = frame.receptions->all});
}

void RepeatedRun::add(CapturedDatagram datagram) {
  const Key key{datagram.destination.port, stream::key_of(datagram.payload)};
  datagrams_[key].push_back(std::move(datagram));
}

// The first one that the target has not taken yet: one that comes twice is taken twice.
CapturedDatagram RepeatedRun::datagram_of(const stream::Reception& reception, std::uint32_t frame) {
  const auto found = datagrams_.find({reception.port, reception.key});
  if (found == datagrams_.end() || found->second.empty()) {
    throw CheckFailed(name_of(frame) + ": its target took a datagram to port " +
                      std::to_string(reception.port) +
                      " that the capture does not have; was it another capture that was played?");
  }
  CapturedDatagram datagram = std::move(found->second.front());
  found->second.pop_front();
  return datagram;
}

// A frame ends with a datagram, or else when the target ended it. One datagram may end two.
void RepeatedRun::play(OfflineTarget& target) {
  if (frames_.empty()) {
    throw CheckFailed("the stream has no frame that can be repeated");
  }
  target.start(opened_us_);
  std::size_t ended = 0;
  for (const Frame& frame : frames_) {
    for (const stream::Reception& reception : frame.receptions) {
      target.take_at(datagram_of(reception, frame.number),
                     frame.closed_us - reception.before_close_us, reception.was_left);
    }
    ++ended;
    if (target.frames_ended() < ended) {
      target.pass(frame.closed_us);
    }
    if (target.frames_ended() < ended) {
      throw CheckFailed(name_of(frame.number) + " does not end here when its target ended it");
    }
  }
}

}  // namespace iog::tools
