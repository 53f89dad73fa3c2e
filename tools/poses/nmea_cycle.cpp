#include "tools/poses/nmea_cycle.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/program/middle.hpp"

namespace iog::tools {
namespace {

using Own = std::vector<std::optional<std::size_t>>;

template <typename Value>
Value middle_of(const std::vector<Value>& values, Value if_none) {
  return values.empty() ? if_none : middle_value_of(values);
}

// The untimed sentences between one time and the next.
struct Group {
  std::size_t first = 0;
  std::size_t count = 0;
  bool is_inside = false;
};

class Bursts {
 public:
  Bursts(const std::vector<TimedMotion>& times, const std::vector<Untimed>& sentences)
      : times_(&times), sentences_(&sentences), groups_(times.size() + 1) {
    for (std::size_t i = 0; i < sentences.size(); ++i) {
      Group& group = groups_[sentences[i].times_before];
      if (group.count++ == 0) {
        group.first = i;
        group.is_inside = sentences[i].is_inside;
      }
    }
    measure();
  }

  // For each time the sentence that is nearest on that side, if none is missing there.
  [[nodiscard]] Own own(bool is_before) const {
    Own own(times_->size());
    for (std::size_t i = 0; i < times_->size(); ++i) {
      const Group& group = groups_[is_before ? i : i + 1];
      const bool is_own = is_irregular_ || usual_ > 1 || is_whole(i, is_before);
      if (group.count > 0 && is_own && (group.is_inside || inside_ < 0.5)) {
        own[i] = is_before ? group.first + group.count - 1 : group.first;
      }
    }
    return own;
  }

  // The possible error of the time: one sentence if the order is open, and as many as are lost.
  [[nodiscard]] std::vector<double> open_s(bool is_before, bool is_order_open) const {
    std::vector<double> open_s(times_->size(), is_order_open ? step_s() : 0);
    for (std::size_t i = 0; usual_ > 1 && !is_irregular_ && i < times_->size(); ++i) {
      open_s[i] += is_whole(i, is_before) ? 0 : step_s() * std::abs(missing(i, is_before));
    }
    return open_s;
  }

  // Whether the sentence comes before the times; empty: open.
  [[nodiscard]] std::optional<bool> order(bool angles_are_headings, bool is_cut_at_begin,
                                          bool is_cut_at_end) const {
    if (inside_ > 0.05) {
      return false;
    }
    if (is_irregular_) {
      return std::nullopt;
    }
    std::optional<bool> order = usual_ == 0 ? by_whole_periods() : std::nullopt;
    if (!order && angles_are_headings) {
      order = by_course();
    }
    const std::size_t begin = groups_.front().count;
    const std::size_t end = groups_.back().count;
    const bool is_uncut = !is_cut_at_begin && !is_cut_at_end && std::min(begin, end) == 0 &&
                          std::max(begin, end) == std::max(usual_, std::size_t{1});
    return order || !is_uncut ? order : std::optional(begin > 0);
  }

  [[nodiscard]] bool opens() const { return groups_.front().count == 1; }

 private:
  // From one sentence to the next, or to the next time if they are rarer.
  [[nodiscard]] double step_s() const {
    return period_s_ / (is_irregular_ ? 1 : std::max(1.0, static_cast<double>(usual_)));
  }

  [[nodiscard]] double seconds_between(std::size_t from, std::size_t to) const {
    const auto us = static_cast<std::int64_t>((*times_)[to].time_us - (*times_)[from].time_us);
    return static_cast<double>(us) / 1e6;
  }

  void measure() {
    std::vector<double> periods;
    std::vector<std::size_t> counts;
    std::vector<std::size_t> apart;
    std::size_t last = 0;
    for (std::size_t i = 1; i < times_->size(); ++i) {
      periods.push_back(seconds_between(i - 1, i));
      counts.push_back(groups_[i].count);
      if (groups_[i].count > 0) {
        apart.push_back(i - last);
        last = i;
      }
    }
    period_s_ = middle_of(periods, 1.0);
    usual_ = middle_of(counts, std::size_t{1});
    rare_s_ = period_s_ * static_cast<double>(middle_of(apart, std::size_t{1}));
    for (const bool is_before : {true, false}) {
      residues_[is_before ? 1 : 0] = usual_residue(is_before);
    }
    is_irregular_ = !is_regular();
    const auto filled = std::ranges::count_if(groups_, [](const Group& g) { return g.count > 0; });
    const auto inside = std::ranges::count_if(groups_, &Group::is_inside);
    inside_ =
        static_cast<double>(inside) / static_cast<double>(std::max<std::ptrdiff_t>(filled, 1));
  }

  // Some are lost, but what comes follows the period.
  [[nodiscard]] bool is_regular() const {
    constexpr std::size_t kMany = 5;
    std::size_t checked = 0;
    std::size_t whole = 0;
    double lost = 0;
    double expected = 0;
    bool is_more = false;
    for (std::size_t i = 0; i + 1 < times_->size(); ++i) {
      checked += usual_ > 0 || groups_[i + 1].count > 0 ? 1U : 0U;
      whole += is_whole(i, false) ? 1U : 0U;
      lost += missing(i, false);
      expected += missing(i, false) + static_cast<double>(groups_[i + 1].count);
      is_more = is_more || missing(i, false) < -0.5;
    }
    return 10 * whole >= 7 * checked || (usual_ >= kMany && !is_more && 10 * lost < expected);
  }

  // A time modulo the sentence's period, from -1/2 to 1/2 period.
  [[nodiscard]] double residue(std::size_t time) const {
    return std::remainder(static_cast<double>((*times_)[time].time_us % 86'400'000'000U) / 1e6,
                          rare_s_);
  }

  [[nodiscard]] double usual_residue(bool is_before) const {
    std::vector<double> residues;
    for (std::size_t i = 0; i < times_->size(); ++i) {
      if (groups_[is_before ? i : i + 1].count > 0) {
        residues.push_back(residue(i));
      }
    }
    return middle_of(residues, 0.0);
  }

  // As many sentences on that side of a time as there should be.
  [[nodiscard]] bool is_whole(std::size_t time, bool is_before) const {
    const Group& group = groups_[is_before ? time : time + 1];
    const bool is_at_end = is_before ? time == 0 : time + 1 == times_->size();
    if (group.count == 0 || is_at_end) {
      return group.count > 0;
    }
    if (usual_ == 0) {
      const double off = residue(time) - residues_[is_before ? 1 : 0];
      return std::abs(std::remainder(off, rare_s_)) < period_s_ / 2;
    }
    return std::abs(missing(time, is_before)) < 0.5;
  }

  // How many sentences fewer than usual are on that side of a time that is not the last there.
  [[nodiscard]] double missing(std::size_t time, bool is_before) const {
    const std::size_t from = time - (is_before ? 1 : 0);
    const double expected =
        static_cast<double>(usual_) * seconds_between(from, from + 1) / period_s_;
    return expected - static_cast<double>(groups_[from + 1].count);
  }

  [[nodiscard]] std::optional<bool> by_whole_periods() const {
    const auto is_even = [this](bool is_before) {
      return std::abs(residues_[is_before ? 1 : 0]) < period_s_ / 2;
    };
    return is_even(true) == is_even(false) ? std::nullopt : std::optional(is_even(true));
  }

  // Course minus heading spreads least if headings have their right times. An antenna ahead of the
  // rear axle spreads it, too, like a delay of that distance, which has to be short compared with
  // the distance between two headings.
  [[nodiscard]] std::optional<bool> by_course() const {
    constexpr double kLeastWayM = 4;
    constexpr std::size_t kLeastCount = 8;
    constexpr double kClearly = 4;
    constexpr double kLeastSpread = 1;  // square degrees
    const std::array<Own, 2> owns{own(false), own(true)};
    std::array<double, 2> sums{};
    std::array<double, 2> squares{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < times_->size(); ++i) {
      const TimedMotion& motion = (*times_)[i];
      const double way_m = motion.speed_mps.value_or(0) * step_s();
      if (!owns[0][i] || !owns[1][i] || !motion.course_deg || way_m < kLeastWayM) {
        continue;
      }
      ++count;
      for (std::size_t side = 0; side < 2; ++side) {
        const double heading_deg = *(*sentences_)[*owns[side][i]].angle_deg;
        const double off_deg = std::remainder(*motion.course_deg - heading_deg, 180);
        sums[side] += off_deg;
        squares[side] += off_deg * off_deg;
      }
    }
    const auto n = static_cast<double>(std::max(count, kLeastCount));
    const double after = squares[0] / n - sums[0] * sums[0] / n / n;
    const double before = squares[1] / n - sums[1] * sums[1] / n / n;
    const bool is_clear = count >= kLeastCount && std::max(after, before) > kLeastSpread &&
                          std::max(after, before) > kClearly * std::min(after, before);
    return is_clear ? std::optional(before < after) : std::nullopt;
  }

  const std::vector<TimedMotion>* times_;
  const std::vector<Untimed>* sentences_;
  std::vector<Group> groups_;  // before the first time, between two, behind the last
  double period_s_ = 1;        // of the times
  std::size_t usual_ = 1;      // sentences between two times
  double rare_s_ = 1;          // the period of sentences that are rarer than times
  std::array<double, 2> residues_{};
  bool is_irregular_ = false;
  double inside_ = 0;  // the share of sentences that stand between two of one time
};

}  // namespace

Cycle cycle_of(const std::vector<TimedMotion>& times, const std::vector<Untimed>& sentences,
               bool angles_are_headings, bool is_cut_at_begin, bool is_cut_at_end) {
  const Bursts bursts(times, sentences);
  const std::optional<bool> order =
      bursts.order(angles_are_headings, is_cut_at_begin, is_cut_at_end);
  const bool is_before = order.value_or(bursts.opens());
  return {.own = bursts.own(is_before),
          .open_s = bursts.open_s(is_before, !order),
          .is_order_open = !order};
}

}  // namespace iog::tools
