// What becomes of the datagrams that come to a receiver, and of the tiles in them.
#pragma once

#include <cstdint>

namespace iog::tools {

struct MessageCounts {
  // Every datagram is counted in one of these.
  std::uint64_t messages = 0;        // ours, whole and of use, each once
  std::uint64_t repeated = 0;        // dropped
  std::uint64_t too_late = 0;        // its frame was given up already
  std::uint64_t other_run = 0;       // of a run that is over, or of which too little has come
  std::uint64_t corrupt = 0;         // of ours, but length, data id or CRC is wrong
  std::uint64_t malformed = 0;       // whole, and yet numbers contradict each other
  std::uint64_t not_ours = 0;        // another protocol, service or event
  std::uint64_t other_version = 0;   // of ours: another version of the interface
  std::uint64_t not_understood = 0;  // a type, a storage or a grid that is new to us
  std::uint64_t signatures = 0;      // of the others; with the target's key, those that are right
  // Of a receiver that has the target's key (tools/frames/signed_stream.hpp).
  std::uint64_t forged_signatures = 0;
  std::uint64_t not_signed = 0;

  std::uint64_t bytes = 0;            // in the messages
  std::uint64_t late = 0;             // of these, behind one that was sent after it, still in time
  std::uint64_t tiles = 0;            // of occupancy indexes that are known
  std::uint64_t class_tiles = 0;      // of classes that are known
  std::uint64_t tiles_malformed = 0;  // in a sound message
  std::uint64_t tiles_not_understood = 0;  // an encoding that is new to us
  std::uint64_t without_reference = 0;     // tiles against a frame of which we do not have them
  std::uint64_t restarts = 0;              // of the target

  // Whether a target was heard, though maybe of another version.
  [[nodiscard]] bool is_any_of_target() const { return messages > 0 || other_version > 0; }

  [[nodiscard]] std::uint64_t datagrams() const {
    return messages + repeated + too_late + other_run + corrupt + malformed + not_ours +
           other_version + not_understood + signatures + forged_signatures + not_signed;
  }
};

}  // namespace iog::tools
