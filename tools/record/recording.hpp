// Something that a stream is recorded in: a file or a folder.
#pragma once

#include <cstdint>
#include <span>

#include "tools/formats/capture/datagram.hpp"
#include "tools/frames/grid_frame.hpp"
#include "tools/frames/live_classes.hpp"
#include "tools/frames/live_grid.hpp"
#include "tools/receive/run_statistics.hpp"
#include "tools/vehicles/seen_point.hpp"

namespace iog::tools {

// A frame and what was known when it had been put together.
struct RecordedFrame {
  const GridFrame* frame;
  const LiveGrid* live;        // with the older states of tiles that are missing in it
  const LiveClasses* classes;  // likewise, if the frame has classes
  std::uint64_t time_us = 0;   // since 1970, by the recorder's clock or the capture's
  std::span<const SeenPoint>
      points{};  // that it was made of, where the sensors' packets are at hand
};

class Recording {
 public:
  Recording() = default;
  virtual ~Recording() = default;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  // Whether the points of a frame are of any use here.
  [[nodiscard]] virtual bool wants_points() const { return false; }
  // Once, when it is known that the run has something to record: from then on its beginning
  // replaces what was there before. Without it, finish() does that.
  virtual void keep_beginning() {}
  // Every datagram, as it came.
  virtual void take_datagram(const CapturedDatagram& datagram) = 0;
  // Every frame, in order, after its last datagram.
  virtual void take_frame(const RecordedFrame& frame) = 0;
  // Once, at the end. facts: what is known of the whole run. UsageError if not all has been
  // written, as above.
  virtual void finish(const Facts& facts) = 0;
};

}  // namespace iog::tools
