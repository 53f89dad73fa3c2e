// A target's run once more on this PC: each datagram is taken when the target took it, as its
// stream says (docs/spec.md 3.13). So classes are the same also where packets are placed by their
// arrival, and frames end where the target ended them.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/frames/grid_frame.hpp"
#include "tools/fuse/offline_target.hpp"

namespace iog::tools {

class RepeatedRun {
 public:
  // vehicle: the target's; it outlives the run.
  explicit RepeatedRun(const vehicle::Vehicle& vehicle) : vehicle_(&vehicle) {}

  // The next frame of the stream, in order, from the target's start on. CheckFailed if the run
  // cannot be repeated: it is of another vehicle, frames are missing before it, it does not say
  // what it received, or not all of that, it is of another run, or the stream begins in the middle.
  void add(const GridFrame& frame);

  // A datagram of the capture that was played, in order.
  void add(CapturedDatagram datagram);

  [[nodiscard]] bool has_frames() const { return !frames_.empty(); }

  // CheckFailed if the capture lacks a datagram that the target took, or a frame does not end where
  // it did.
  void play(OfflineTarget& target);

 private:
  struct Frame {
    std::uint32_t number = 0;
    std::uint64_t closed_us = 0;
    std::vector<stream::Reception> receptions;
  };
  using Key = std::pair<std::uint16_t, std::uint32_t>;  // port, key

  [[nodiscard]] CapturedDatagram datagram_of(const stream::Reception& reception,
                                             std::uint32_t frame);

  const vehicle::Vehicle* vehicle_;
  std::uint32_t run_number_ = 0;
  std::uint64_t opened_us_ = 0;
  std::vector<Frame> frames_;
  std::map<Key, std::deque<CapturedDatagram>> datagrams_;
};

}  // namespace iog::tools
