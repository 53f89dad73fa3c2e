// What standard output says of frames as they come, for whoever waits for the target.
#pragma once

#include <cstdint>
#include <iostream>
#include <string>

#include "tools/receive/run_statistics.hpp"

namespace iog::tools {

// A line for each frame that scan points came for, so that `iog replay --step` has an answer to
// each frame that it sends: `frame N` by its number among those with evidence, or `nothing taken`
// where the target had no time for any of it, or no use.
class FrameNotes {
 public:
  explicit FrameNotes(bool is_wanted) : is_wanted_(is_wanted) {}

  void say_listening() const { say("listening"); }

  // A message has come. Until a target knows its peer's MAC address its messages are lost, so a
  // sender that does not wait for this may wait for an answer forever.
  void say_heard() {
    if (!is_heard_) {
      is_heard_ = true;
      say("heard");
    }
  }

  // Of the frames that have been added since.
  void say_frames(const RunStatistics& statistics) {
    for (; frames_ < statistics.records().size(); ++frames_) {
      say("frame " + std::to_string(frames_));
    }
    for (; nothing_taken_ < statistics.nothing_taken(); ++nothing_taken_) {
      say("nothing taken");
    }
  }

 private:
  void say(const std::string& line) const {
    if (is_wanted_) {
      std::cout << line << std::endl;
    }
  }

  bool is_wanted_;
  bool is_heard_ = false;
  std::uint64_t frames_ = 0;
  std::uint64_t nothing_taken_ = 0;
};

}  // namespace iog::tools
