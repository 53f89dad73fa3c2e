#include "recorder.hpp"

#include <algorithm>
#include <iterator>
#include <ostream>

#include "marker.hpp"

namespace iog::a9_model {
namespace {

void print(std::ostream& out, std::string_view heading, std::string_view region,
           std::uint64_t entries, const Counters& counters) {
  out << heading << " region=" << region << " entries=" << entries;
  for (const Counter& counter : kCounters) {
    out << ' ' << counter.name << '=' << counters.*counter.member;
  }
  out << '\n';
}

// A program that never returns, or one with computed returns, must not grow the stack for ever.
constexpr std::size_t kMaxCalls = 4096;

}  // namespace

Recorder::Recorder(const Constants& constants, std::span<const Function> functions)
    : pipeline_(constants),
      marked_(kRegionIds),
      functions_(functions.begin(), functions.end()),
      called_(functions.size()) {}

void Recorder::begin(const ProgramInstruction& instruction) {
  finish_last(instruction.address);
  if (instruction.instruction.marker != Instruction::kNoMarker) {
    note_marker(instruction.instruction.marker);
    return;
  }
  marker_ = -1;
  last_ = &instruction;
}

void Recorder::finish_last(std::uint32_t next) {
  if (last_ == nullptr) {
    return;
  }
  pipeline_.execute(*last_, {accesses_.data(), access_count_}, next);
  access_count_ = 0;
  if (last_->instruction.flow != Flow::kNone && !functions_.empty()) {
    follow_calls(*last_, next);
  }
  last_ = nullptr;
}

void Recorder::note_marker(std::uint8_t half) {
  if (marker_ < 0) {
    marker_ = half;
    return;
  }
  const auto code = static_cast<std::uint8_t>(marker_ << 4 | half);
  marker_ = -1;
  Region& region = marked_[code % kRegionIds];
  if ((code & kMarkerEnd) == 0) {
    open(region);
  } else {
    close(region);
  }
}

// Calls push where they return to; arriving there ends them, and the functions that were entered
// since. A jump to a function's entry is a call that returns to the caller's caller.
void Recorder::follow_calls(const ProgramInstruction& from, std::uint32_t to) {
  const Flow flow = from.instruction.flow;
  if ((flow == Flow::kCall || flow == Flow::kIndirectCall) && to != from.address + 4) {
    if (returns_.size() < kMaxCalls) {
      returns_.push_back(from.address + 4);
    }
  } else if (const auto found = std::find(returns_.rbegin(), returns_.rend(), to);
             flow != Flow::kJump && found != returns_.rend()) {
    returns_.erase(std::prev(found.base()), returns_.end());
    for (Region& region : called_) {
      if (region.open > 0 && returns_.size() < region.depth) {
        close(region);
      }
    }
  }
  for (std::size_t index = 0; index < functions_.size(); ++index) {
    if (functions_[index].entry == to && called_[index].open == 0) {
      called_[index].depth = returns_.size();
      open(called_[index]);
    }
  }
}

void Recorder::open(Region& region) {
  ++region.entries;
  if (++region.open == 1) {
    region.begin = pipeline_.counters();
  }
}

void Recorder::close(Region& region) {
  if (region.open > 0 && --region.open == 0) {
    add_difference(region.sum, region.begin, pipeline_.counters());
  }
}

void Recorder::report(std::ostream& out, std::string_view heading) {
  if (last_ != nullptr) {
    finish_last(last_->address + 4);
  }
  const Counters all = pipeline_.counters();
  print(out, heading, "all", 1, all);
  for (std::size_t id = 0; id < marked_.size(); ++id) {
    if (marked_[id].entries > 0) {
      print(out, heading, std::to_string(id), marked_[id].entries, marked_[id].sum);
    }
  }
  for (std::size_t index = 0; index < functions_.size(); ++index) {
    print(out, heading, functions_[index].name, called_[index].entries, called_[index].sum);
  }
  if (unsupported_ > 0) {
    out << heading << " unsupported=" << unsupported_ << " (not A32: neither counted nor timed)\n";
  }
}

}  // namespace iog::a9_model
