#include "tools/poses/nmea_epochs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "tools/poses/pose_log.hpp"

namespace iog::tools {
namespace {

// Headings further apart say nothing of the time between.
constexpr double kMostBetweenS = 2.5;

double seconds_between(const NmeaEpoch& from, const NmeaEpoch& to) {
  return static_cast<double>(static_cast<std::int64_t>(to.time_us() - from.time_us())) / 1e6;
}

// Gives the epochs days from one whose day is known, in either direction of time. A time of day
// that goes back by more than half a day is of the next day. Epochs without a fix do not count.
template <typename Iterator>
void count_days(Iterator begin, Iterator end, const NmeaEpoch& start, bool is_forwards) {
  std::uint64_t midnight_us = start.stated_midnight_us.value_or(0);
  std::uint64_t last_us = start.time_of_day_us;
  for (Iterator epoch = begin; epoch != end; ++epoch) {
    const std::uint64_t earlier_us = is_forwards ? last_us : epoch->time_of_day_us;
    const std::uint64_t later_us = is_forwards ? epoch->time_of_day_us : last_us;
    const std::uint64_t step_us = later_us + kDayUs / 2 < earlier_us ? kDayUs : 0;
    epoch->midnight_us = epoch->stated_midnight_us.value_or(
        is_forwards ? midnight_us + step_us : midnight_us - std::min(midnight_us, step_us));
    if (epoch->has_fix()) {
      midnight_us = epoch->midnight_us;
      last_us = epoch->time_of_day_us;
    }
  }
}

void give_days(std::vector<NmeaEpoch>& epochs) {
  const auto is_dated = [](const NmeaEpoch& epoch) { return epoch.stated_midnight_us.has_value(); };
  auto start = std::ranges::find_if(epochs, is_dated);
  start = start == epochs.end() ? epochs.begin() : start;
  if (start != epochs.end()) {
    const NmeaEpoch known = *start;
    count_days(start, epochs.end(), known, true);
    count_days(std::make_reverse_iterator(start), epochs.rend(), known, false);
  }
}

Cycle cycle_in(const std::vector<NmeaEpoch>& epochs, const UntimedSentences& untimed,
               bool angles_are_headings) {
  std::vector<TimedMotion> times;
  times.reserve(epochs.size());
  for (const NmeaEpoch& epoch : epochs) {
    times.push_back({epoch.time_us(), epoch.speed_mps, epoch.course_deg});
  }
  return cycle_of(times, untimed.all, angles_are_headings, untimed.is_cut_at_begin,
                  untimed.is_cut_at_end);
}

void note_order(const Cycle& cycle, const std::vector<NmeaEpoch>& epochs, std::string_view name,
                std::vector<std::string>& notes) {
  Tally open;
  double most_s = 0;
  for (std::size_t i = 0; i < epochs.size(); ++i) {
    if (cycle.own[i] && cycle.open_s[i] > 0) {
      open.add(epochs[i].line);
      most_s = std::max(most_s, cycle.open_s[i]);
    }
  }
  std::string text(name);
  text += " may be up to ";
  text += std::to_string(std::llround(most_s * 1000));
  text += " ms off, as the headings' standard deviation says: it has no time, and ";
  text += cycle.is_order_open ? "the log leaves open whether it comes first or last in a burst"
                              : "some are lost";
  remark(open, text, "line", notes);
}

// The turn from one epoch with that angle to the next one.
struct Turn {
  std::size_t from;
  std::size_t to;
  double seconds;
  double degrees;

  [[nodiscard]] double rate() const { return degrees / seconds; }
};

using Angle = std::optional<double> NmeaEpoch::*;

std::vector<Turn> turns_in(const std::vector<NmeaEpoch>& epochs, Angle angle) {
  std::vector<Turn> turns;
  std::optional<std::size_t> from;
  for (std::size_t to = 0; to < epochs.size(); ++to) {
    if (!(epochs[to].*angle)) {
      continue;
    }
    const double seconds = from ? seconds_between(epochs[*from], epochs[to]) : 0;
    if (seconds > 0 && seconds <= kMostBetweenS) {
      const double degrees = *(epochs[to].*angle) - *(epochs[*from].*angle);
      turns.push_back({*from, to, seconds, std::remainder(degrees, 360)});
    }
    from = to;
  }
  return turns;
}

// An angle of another time is off by the turn of the car in between.
void doubt(std::vector<NmeaEpoch>& epochs, Angle angle, const Cycle& cycle) {
  for (const Turn& turn : turns_in(epochs, angle)) {
    for (const std::size_t i : {turn.from, turn.to}) {
      const double open_rad = std::abs(turn.rate()) * kRadians * cycle.open_s[i];
      epochs[i].doubt_rad = std::max(epochs[i].doubt_rad, open_rad);
    }
  }
}

// Between two headings the car is taken to turn evenly. The error is that of a turn rate which
// changes from one pair to the next: in the worst case at once and half way.
void interpolate(std::vector<NmeaEpoch>& epochs, std::vector<std::string>& notes) {
  Tally between;
  const std::vector<Turn> turns = turns_in(epochs, &NmeaEpoch::heading_deg);
  for (std::size_t k = 0; k < turns.size(); ++k) {
    const Turn& turn = turns[k];
    const Turn& before = turns[k > 0 ? k - 1 : k];
    const Turn& after = turns[k + 1 < turns.size() ? k + 1 : k];
    const double change =
        std::max(std::abs(before.rate() - turn.rate()), std::abs(after.rate() - turn.rate()));
    const NmeaEpoch& from = epochs[turn.from];
    for (std::size_t i = turn.from + 1; i < turn.to; ++i) {
      const double share = seconds_between(from, epochs[i]) / turn.seconds;
      epochs[i].heading_deg = *from.heading_deg + turn.degrees * share;
      epochs[i].doubt_rad = std::max(from.doubt_rad, epochs[turn.to].doubt_rad) +
                            change * kRadians * turn.seconds / 2;
      between.add(epochs[i].line);
    }
  }
  remark(between, "heading|headings is|are between two HDT", "line", notes);
}

}  // namespace

void complete(std::vector<NmeaEpoch>& epochs, const UntimedSentences& headings,
              const UntimedSentences& courses, std::vector<std::string>& notes) {
  give_days(epochs);
  const bool has_speeds = std::ranges::any_of(
      epochs, [](const NmeaEpoch& epoch) { return epoch.speed_mps.has_value(); });
  if (!has_speeds && !courses.all.empty() && !epochs.empty()) {
    const Cycle cycle = cycle_in(epochs, courses, false);
    for (std::size_t i = 0; i < epochs.size(); ++i) {
      if (cycle.own[i]) {
        epochs[i].course_deg = courses.all[*cycle.own[i]].angle_deg;
        epochs[i].speed_mps = courses.all[*cycle.own[i]].speed_mps;
      }
    }
    note_order(cycle, epochs, "VTG", notes);
    if (headings.all.empty()) {
      doubt(epochs, &NmeaEpoch::course_deg, cycle);
    }
  }
  if (!headings.all.empty() && !epochs.empty()) {
    const Cycle cycle = cycle_in(epochs, headings, true);
    for (std::size_t i = 0; i < epochs.size(); ++i) {
      if (cycle.own[i]) {
        epochs[i].heading_deg = headings.all[*cycle.own[i]].angle_deg;
      }
    }
    note_order(cycle, epochs, "HDT", notes);
    doubt(epochs, &NmeaEpoch::heading_deg, cycle);
    interpolate(epochs, notes);
  }
}

}  // namespace iog::tools
