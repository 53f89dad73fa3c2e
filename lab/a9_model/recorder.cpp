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

}  // namespace

Recorder::Recorder(const Constants& constants, std::span<const std::string> stages)
    : pipeline_(constants),
      marked_(kRegionIds),
      stages_(stages.begin(), stages.end()),
      own_(stages.size()) {}

void Recorder::begin(const ProgramInstruction& instruction) {
  finish_last(instruction.address, instruction.place.function);
  if (instruction.instruction.marker != Instruction::kNoMarker) {
    note_marker(instruction.instruction.marker);
    return;
  }
  marker_ = -1;
  if (!is_paused_) {
    enter(instruction.place.stage != 0 ? instruction.place.stage : inherited_);
    last_ = &instruction;
  }
}

// All of the model becomes one function: it is called for each instruction.
[[gnu::flatten]] void Recorder::finish_last(std::uint32_t next, std::uint32_t next_function) {
  if (last_ == nullptr) {
    access_count_ = 0;
    return;
  }
  pipeline_.execute(*last_, {accesses_.data(), access_count_}, next);
  access_count_ = 0;
  if (last_->instruction.flow != Flow::kNone) {
    follow(*last_, next, next_function);
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
  if (code == kMarkerKeepL2 || code == kMarkerReleaseL2) {
    pipeline_.keep_l2(code == kMarkerKeepL2);
    return;
  }
  Region& region = marked_[code % kRegionIds];
  if ((code & kMarkerEnd) == 0) {
    open(region);
  } else {
    close(region);
  }
}

// Calls push where they return to; arriving there ends them. A jump to another function is a call
// that returns to the caller's caller.
void Recorder::follow(const ProgramInstruction& from, std::uint32_t to, std::uint32_t to_function) {
  const Flow flow = from.instruction.flow;
  if ((flow == Flow::kCall || flow == Flow::kIndirectCall) && to != from.address + 4) {
    if (calls_.size() < kMaxCalls) {
      calls_.push_back({.return_to = from.address + 4, .inherited = inherited_});
    }
    inherited_ = stage_;
  } else if (flow == Flow::kReturn) {
    follow_return(to);
  } else if (to_function != from.place.function && (flow == Flow::kJump || !follow_return(to))) {
    inherited_ = stage_;
  }
}

bool Recorder::follow_return(std::uint32_t to) {
  const auto found = std::find_if(calls_.rbegin(), calls_.rend(),
                                  [to](const Call& call) { return call.return_to == to; });
  if (found == calls_.rend()) {
    return false;
  }
  inherited_ = found->inherited;
  calls_.erase(std::prev(found.base()), calls_.end());
  return true;
}

void Recorder::enter(std::uint8_t stage) {
  if (stage != stage_) {
    charge();
    stage_ = stage;
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

void Recorder::charge() {
  const Counters now = pipeline_.counters();
  add_difference(own_[stage_], charged_, now);
  charged_ = now;
}

void Recorder::forget() {
  forgotten_ = pipeline_.counters();
  charged_ = forgotten_;
  rounds_.clear();
  std::ranges::fill(own_, Counters{});
  for (Region& region : marked_) {
    region.sum = {};
    region.begin = forgotten_;
    region.entries = region.open > 0 ? 1 : 0;
  }
}

void Recorder::end_round() {
  charge();
  rounds_.push_back(own_);
}

void Recorder::report_stages(std::ostream& out, std::string_view heading) const {
  for (std::size_t stage = 1; stage < stages_.size(); ++stage) {
    print(out, heading, stages_[stage], 1, own_[stage], "self");
  }
  std::vector<Counters> before(stages_.size());
  for (std::size_t number = 0; number < rounds_.size(); ++number) {
    const std::string round = std::string(heading) + " round=" + std::to_string(number);
    for (std::size_t stage = 1; stage < stages_.size(); ++stage) {
      Counters own;
      add_difference(own, before[stage], rounds_[number][stage]);
      print(out, round, stages_[stage], 1, own, "of");
    }
    before = rounds_[number];
  }
}

void Recorder::report(std::ostream& out, std::string_view heading) {
  if (last_ != nullptr) {
    finish_last(last_->address + 4, last_->place.function);
  }
  charge();
  Counters all;
  add_difference(all, forgotten_, pipeline_.counters());
  print(out, heading, "all", 1, all);
  for (std::size_t id = 0; id < marked_.size(); ++id) {
    if (marked_[id].entries > 0) {
      print(out, heading, std::to_string(id), marked_[id].entries, marked_[id].sum);
    }
  }
  report_stages(out, heading);
  if (unsupported_ > 0) {
    out << heading << " unsupported=" << unsupported_ << " (not A32: neither counted nor timed)\n";
  }
}

}  // namespace iog::a9_model
