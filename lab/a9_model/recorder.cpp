#include "recorder.hpp"

#include <algorithm>
#include <iterator>
#include <ostream>

#include "marker.hpp"

namespace iog::a9_model {
namespace {

void print(std::ostream& out, std::string_view heading, std::string_view region,
           std::uint64_t entries, const Counters& counters, std::string_view key = "region") {
  out << heading << ' ' << key << '=' << region << " entries=" << entries;
  for (const Counter& counter : kCounters) {
    out << ' ' << counter.name << '=' << counters.*counter.member;
  }
  out << '\n';
}

// A program that never returns, or one with computed returns, must not grow the stack for ever.
constexpr std::size_t kMaxCalls = 4096;

constexpr std::size_t place_of(std::uint32_t instruction) { return instruction / 4; }

}  // namespace

Recorder::Recorder(const Constants& constants, std::span<const Function> functions)
    : pipeline_(constants),
      marked_(kRegionIds),
      functions_(functions.begin(), functions.end()),
      called_(functions.size()) {
  for (const Function& function : functions_) {
    maybe_entry_.set(place_of(function.entry) % maybe_entry_.size());
  }
}

void Recorder::begin(const ProgramInstruction& instruction) {
  finish_last(instruction.address);
  if (instruction.instruction.marker != Instruction::kNoMarker) {
    note_marker(instruction.instruction.marker);
    return;
  }
  marker_ = -1;
  if (!is_paused_) {
    last_ = &instruction;
  }
}

// All of the model becomes one function: it is called for each instruction.
[[gnu::flatten]] void Recorder::finish_last(std::uint32_t next) {
  if (last_ == nullptr) {
    access_count_ = 0;
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
  if (code == kMarkerForget) {
    forget();
    return;
  }
  if (code == kMarkerRound) {
    end_round();
    return;
  }
  if (code == kMarkerPause || code == kMarkerResume) {
    is_paused_ = code == kMarkerPause;
    return;
  }
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
  } else if (flow != Flow::kJump) {
    follow_return(to);
  }
  if (!maybe_entry_[place_of(to) % maybe_entry_.size()]) {
    return;
  }
  for (std::size_t index = 0; index < functions_.size(); ++index) {
    if (functions_[index].entry == to && called_[index].open == 0) {
      charge_innermost();
      called_[index].depth = returns_.size();
      open(called_[index]);
      open_.push_back(index);
    }
  }
}

void Recorder::follow_return(std::uint32_t to) {
  const auto found = std::find(returns_.rbegin(), returns_.rend(), to);
  if (found == returns_.rend()) {
    return;
  }
  returns_.erase(std::prev(found.base()), returns_.end());
  while (!open_.empty() && returns_.size() < called_[open_.back()].depth) {
    charge_innermost();
    close(called_[open_.back()]);
    open_.pop_back();
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

// The innermost of the functions under way is what has cost something since the last call.
void Recorder::charge_innermost() {
  const Counters now = pipeline_.counters();
  if (!open_.empty()) {
    add_difference(called_[open_.back()].self, charged_, now);
  }
  charged_ = now;
}

void Recorder::forget() {
  forgotten_ = pipeline_.counters();
  charged_ = forgotten_;
  rounds_.clear();
  for (std::vector<Region>* const regions : {&marked_, &called_}) {
    for (Region& region : *regions) {
      region.sum = {};
      region.self = {};
      region.begin = forgotten_;
      region.entries = region.open > 0 ? 1 : 0;
    }
  }
}

void Recorder::end_round() {
  charge_innermost();
  std::vector<Counters>& round = rounds_.emplace_back();
  for (const Region& function : called_) {
    round.push_back(function.self);
  }
}

void Recorder::report_rounds(std::ostream& out, std::string_view heading) const {
  std::vector<Counters> before(functions_.size());
  for (std::size_t number = 0; number < rounds_.size(); ++number) {
    const std::string round = std::string(heading) + " round=" + std::to_string(number);
    for (std::size_t index = 0; index < functions_.size(); ++index) {
      Counters own;
      add_difference(own, before[index], rounds_[number][index]);
      print(out, round, functions_[index].name, 1, own, "of");
    }
    before = rounds_[number];
  }
}

void Recorder::report(std::ostream& out, std::string_view heading) {
  if (last_ != nullptr) {
    finish_last(last_->address + 4);
  }
  Counters all;
  add_difference(all, forgotten_, pipeline_.counters());
  print(out, heading, "all", 1, all);
  for (std::size_t id = 0; id < marked_.size(); ++id) {
    if (marked_[id].entries > 0) {
      print(out, heading, std::to_string(id), marked_[id].entries, marked_[id].sum);
    }
  }
  for (std::size_t index = 0; index < functions_.size(); ++index) {
    const Region& function = called_[index];
    print(out, heading, functions_[index].name, function.entries, function.sum);
    print(out, heading, functions_[index].name, function.entries, function.self, "self");
  }
  report_rounds(out, heading);
  if (unsupported_ > 0) {
    out << heading << " unsupported=" << unsupported_ << " (not A32: neither counted nor timed)\n";
  }
}

}  // namespace iog::a9_model
