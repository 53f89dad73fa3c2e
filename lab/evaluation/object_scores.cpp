#include "lab/evaluation/object_scores.hpp"

#include <algorithm>

namespace iog::lab {

void ObjectScorer::add(const ObjectFrame& frame) {
  ++totals_.frames;
  totals_.movers += frame.movers.size();
  totals_.reported += frame.reported.size();
  totals_.wrong += static_cast<std::uint64_t>(
      std::ranges::count(frame.reported, ReportedOn::kNothing, &Reported::on));
  for (const Mover& mover : frame.movers) {
    watch(frame.time_us, mover, frame.reported);
  }
  add_gospa(frame);
}

ObjectScorer::Newest& ObjectScorer::newest_of(std::uint64_t time_us, const Mover& mover) {
  const auto [known, is_new] = newest_.try_emplace(mover.thing);
  if (is_new || time_us - views_[known->second.view].last_us > kGoneUs) {
    known->second = {.view = views_.size()};
    views_.push_back({.thing = mover.thing,
                      .is_person = mover.is_person,
                      .first_us = time_us,
                      .last_us = time_us});
  }
  return known->second;
}

void ObjectScorer::watch(std::uint64_t time_us, const Mover& mover,
                         const std::vector<Reported>& reported) {
  Newest& newest = newest_of(time_us, mover);
  View& view = views_[newest.view];
  const bool is_late = time_us - view.first_us >= kLateUs;
  const std::uint64_t passed_us = time_us - view.last_us;
  view.seen_us += passed_us <= kOftenUs ? passed_us : 0;
  view.last_us = time_us;
  ++view.frames;
  view.late_frames += is_late ? 1U : 0U;
  if (!mover.told_by) {
    return;
  }
  const Reported& by = reported[*mover.told_by];
  ++view.told;
  view.late_told += is_late ? 1U : 0U;
  if (!view.delay_us) {
    view.delay_us = time_us - view.first_us;
  }
  view.other_ids += newest.id && *newest.id != by.id ? 1U : 0U;
  newest.id = by.id;
  if (time_us - by.born_us >= kLateUs) {
    const double error = distance(by.velocity, mover.velocity);
    view.errors.push_back({error, error <= 2 * by.deviation});
  }
}

void ObjectScorer::add_gospa(const ObjectFrame& frame) {
  std::vector<Vector2> truth(frame.movers.size());
  std::ranges::transform(frame.movers, truth.begin(), &Mover::at);
  std::vector<Vector2> reported;
  for (const Reported& its : frame.reported) {
    if (its.on != ReportedOn::kIgnored) {
      reported.push_back(its.at);
    }
  }
  const Gospa found = gospa(truth, reported, kCutM);
  totals_.gospa.place_m += found.place_m;
  totals_.gospa.missed += found.missed;
  totals_.gospa.wrong += found.wrong;
}

}  // namespace iog::lab
