// From the events of an emulator to the pipeline, and what it costs by region.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "counters.hpp"
#include "pipeline.hpp"

namespace iog::a9_model {

// A function that is to be reported: from its entry to its return, once with whatever it calls and
// once on its own, without the reported functions that it calls. The latter add up to no more than
// the whole run.
struct Function {
  std::string name;
  std::uint32_t entry;
};

class Recorder {
 public:
  Recorder(const Constants& constants, std::span<const Function> functions);

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
  // was entered and two for each function, the second with self= for region=: key=value pairs after
  // `heading`. What came before the program said kMarkerForget is left out. For each kMarkerRound
  // since then there is a line for each function, with round= and of= for region=: what it cost on
  // its own since the round before.
  void report(std::ostream& out, std::string_view heading);

 private:
  struct Region {
    Counters sum;
    Counters begin;
    Counters self;  // for functions
    std::uint64_t entries = 0;
    std::uint32_t open = 0;
    std::size_t depth = 0;  // of the call stack at entry, for functions
  };

  void finish_last(std::uint32_t next);
  void note_marker(std::uint8_t half);
  void follow_calls(const ProgramInstruction& from, std::uint32_t to);
  void follow_return(std::uint32_t to);
  void open(Region& region);
  void close(Region& region);
  void charge_innermost();
  void forget();
  void end_round();
  void report_rounds(std::ostream& out, std::string_view heading) const;

  Pipeline pipeline_;
  const ProgramInstruction* last_ = nullptr;
  std::array<MemoryAccess, 64> accesses_{};
  std::size_t access_count_ = 0;
  std::uint64_t unsupported_ = 0;

  bool is_paused_ = false;
  int marker_ = -1;  // the upper half of a code, once it has been seen
  std::vector<Region> marked_;
  std::vector<Function> functions_;
  std::bitset<4096> maybe_entry_;       // by the address: false where no function begins
  std::vector<Region> called_;          // parallel to functions_
  std::vector<std::uint32_t> returns_;  // where the calls under way will return to
  std::vector<std::size_t> open_;       // the functions under way, the innermost last
  Counters charged_;                    // up to here, to whoever was the innermost
  Counters forgotten_;
  std::vector<std::vector<Counters>> rounds_;  // Region::self of each function at their ends
};

}  // namespace iog::a9_model
