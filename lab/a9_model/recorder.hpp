// From the events of an emulator to the pipeline, and what it costs by region.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "counters.hpp"
#include "pipeline.hpp"

namespace iog::a9_model {

class Recorder {
 public:
  // Stages by their number; the first has no name and is not reported.
  Recorder(const Constants& constants, std::span<const std::string> stages);

  // See MemorySystem.
  void set_uncached(std::uint32_t begin, std::uint32_t bytes) {
    pipeline_.set_uncached(begin, bytes);
  }

  // An instruction begins; it stays valid until the next one begins. Accesses that follow are its
  // own, in ascending order.
  void begin(const ProgramInstruction& instruction);
  void access(std::uint32_t address, std::uint8_t bytes) {
    if (access_count_ < accesses_.size()) {
      accesses_[access_count_++] = {.address = address, .bytes = bytes};
    }
  }
  // An instruction that is not A32.
  void skip_unsupported() { ++unsupported_; }

  // Executes the last instruction and writes a line for the whole run, one for each region that
  // was entered and, with self= for region=, one for each stage: key=value pairs after `heading`.
  // An instruction belongs to the stage that it lies in, or to that of whoever has called its
  // function, so that the stages add up to no more than the whole run. What came before the program
  // said kMarkerForget is left out. For each kMarkerRound since then there is a line for each
  // stage, with round= and of= for region=: what it cost since the round before.
  void report(std::ostream& out, std::string_view heading);

 private:
  struct Region {
    Counters sum;
    Counters begin;
    std::uint64_t entries = 0;
    std::uint32_t open = 0;
  };
  struct Call {
    std::uint32_t return_to;
    std::uint8_t inherited;
  };

  void finish_last(std::uint32_t next, std::uint32_t next_function);
  void note_marker(std::uint8_t half);
  void follow(const ProgramInstruction& from, std::uint32_t to, std::uint32_t to_function);
  bool follow_return(std::uint32_t to);
  void enter(std::uint8_t stage);
  void open(Region& region);
  void close(Region& region);
  void charge();
  void forget();
  void end_round();
  void report_stages(std::ostream& out, std::string_view heading) const;

  Pipeline pipeline_;
  const ProgramInstruction* last_ = nullptr;
  std::array<MemoryAccess, 64> accesses_{};
  std::size_t access_count_ = 0;
  std::uint64_t unsupported_ = 0;

  bool is_paused_ = false;
  int marker_ = -1;  // the upper half of a code, once it has been seen
  std::vector<Region> marked_;
  std::vector<std::string> stages_;
  std::vector<Counters> own_;   // of each stage
  std::uint8_t stage_ = 0;      // of the last instruction
  std::uint8_t inherited_ = 0;  // of whoever has called the function that is under way
  std::vector<Call> calls_;     // under way
  Counters charged_;            // up to here, to their stages
  Counters forgotten_;
  std::vector<std::vector<Counters>> rounds_;  // own_ at their ends
};

}  // namespace iog::a9_model
