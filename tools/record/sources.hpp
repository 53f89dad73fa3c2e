// Where a stream comes from, until it ends or somebody interrupts: a target on the network, a
// capture of its sensors, which is fused here, or a recording of the stream.
#pragma once

#include <cstdint>
#include <string>

#include "tools/identity/car_capture.hpp"
#include "tools/record/recorder.hpp"

namespace iog::tools {

struct LiveSource {
  std::uint16_t port = 0;
  std::string bind = "127.0.0.1";
  std::uint64_t frames = 0;   // end after so many with evidence; 0: do not
  double idle_timeout_s = 0;  // end after so long without one; 0: do not
  bool notify = false;        // say `listening`, and a line for each (frame_notes.hpp)
};

// UsageError if that address and port cannot be bound, CheckFailed if nothing has come. The number
// of datagrams that were dropped here because the recordings were too slow.
[[nodiscard]] std::uint64_t record_live(const LiveSource& source, Recorder& recorder);

// UsageError if the capture cannot be read. The same capture gives the same datagrams, at the times
// of the capture. map: a file of `iog map`, which the target has from the start; empty: none.
// UsageError if that cannot be read, or the vehicle has no classes.
void record_capture(const DriveFiles& drive, const std::string& vehicle, const std::string& map,
                    Recorder& recorder);

// UsageError if the file is no recording, or has no stream in it.
void record_stream(const std::string& path, Recorder& recorder);

}  // namespace iog::tools
