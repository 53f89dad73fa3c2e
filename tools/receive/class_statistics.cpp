#include "tools/receive/class_statistics.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <span>
#include <string_view>

#include "tools/program/hexadecimal.hpp"
#include "tools/report/map_words.hpp"
#include "tools/report/names.hpp"
#include "tools/report/words.hpp"
#include "tools/vehicles/grid_words.hpp"

namespace iog::tools {
namespace {

std::array<std::uint32_t, pose::kCauseCount> slices_of(const stream::ClassEnd& end) {
  std::array<std::uint32_t, pose::kCauseCount> slices{};
  std::ranges::transform(end.causes, slices.begin(), &stream::CauseRecord::slices);
  return slices;
}

// How often each began; that a slice was placed is no cause.
std::array<std::uint32_t, pose::kCauseCount> spells_of(const stream::ClassEnd& end) {
  std::array<std::uint32_t, pose::kCauseCount> spells{};
  std::ranges::transform(end.causes, spells.begin(),
                         [](const auto& cause) { return cause.began.times; });
  spells[0] = 0;
  return spells;
}

std::string row_of_lost(std::uint64_t lost, std::uint64_t all, std::string_view why) {
  return row_if(
      kOfManyLost * lost > all, "POSES?",
      percent(lost, std::max<std::uint64_t>(all, 1)) + " % of the slices are " + std::string(why));
}

}  // namespace

void ClassStatistics::add(const GridFrame& frame) {
  if (!frame.classes) {
    return;
  }
  const ClassGrid& classes = *frame.classes;
  was_restarted_ = was_restarted_ || (run_number_ && run_number_ != frame.header.run_number);
  run_number_ = frame.header.run_number;
  cell_mm_ = classes.cell_mm;
  extent_ = classes.extent;
  ++frames_;
  incomplete_ += classes.is_whole() || classes.is_damaged ? 0U : 1U;
  damaged_ += classes.is_damaged ? 1U : 0U;
  tiles_ += classes.known_tiles.count();
  if (classes.has_end) {
    tiles_not_sent_ += classes.end.tiles_lost;
    packets_placed_ += classes.end.packets_placed;
    packets_not_placed_ += classes.end.packets_not_placed;
    slices_over_budget_ += classes.end.slices_over_budget;
    groups_left_ += classes.end.groups_left;
    had_end_ = true;
    last_ = classes.end;
  }
  if (frame.header.has_evidence()) {
    records_.push_back(class_record_of(frame, frames_of_time_));
    hash_.add(records_.back().class_crc);
  } else if (!records_.empty() && classes.window.slices_end_us > stamp_us_) {
    ++frames_of_time_;
  }
  stamp_us_ = classes.window.slices_end_us;
}

Facts ClassStatistics::facts() const {
  Facts facts;
  add_fact(facts, "class_frames", frames_);
  add_fact(facts, "class_frames_incomplete", incomplete_);
  add_fact(facts, "class_frames_damaged", damaged_);
  add_fact(facts, "class_tiles", tiles_);
  add_fact(facts, "class_tiles_not_sent", tiles_not_sent_);
  add_fact(facts, "packets_placed", packets_placed_);
  add_fact(facts, "packets_not_placed", packets_not_placed_);
  add_fact(facts, "slices_over_budget", slices_over_budget_);
  add_fact(facts, "groups_over_budget", groups_left_);
  const auto spells = spells_of(last_);
  add_facts(facts, "slices_", slices_of(last_), kPoseCauseNames);
  add_facts(facts, "times_", std::span(spells).subspan(1), std::span(kPoseCauseNames).subspan(1));
  add_facts(facts, "poses_", last_.pose_fates, kPoseFateNames);
  if (had_end_) {
    std::ranges::move(map_facts(last_.map), std::back_inserter(facts));
  }
  facts.emplace_back("class_run_hash", hex(run_hash()));
  return facts;
}

std::string ClassStatistics::why_nothing_placed(std::uint16_t pose_port) const {
  const auto& fates = last_.pose_fates;
  const std::uint64_t poses = std::accumulate(fates.begin(), fates.end(), std::uint64_t{0});
  const std::string port = " on UDP port " + std::to_string(pose_port);
  if (poses == 0) {
    return "no pose message came" + port + "; --poses takes a log of them";
  }
  if (fates[0] == 0) {
    return "none of the " + std::to_string(poses) + " pose messages" + port +
           " was used: " + list_of(fates, kPoseFateNames);
  }
  const auto slices = slices_of(last_);
  const auto all = std::accumulate(slices.begin() + 1, slices.end(), std::uint64_t{0});
  const auto of = [&](pose::Cause cause) { return slices.at(static_cast<std::size_t>(cause)); };
  if (of(pose::Cause::kLate) + of(pose::Cause::kLost) < all) {
    return "its slices were not placed: " + list_of(slices, kPoseCauseNames);
  }
  return "the poses and the scans do not overlap in time: of " + std::to_string(all) +
         " slices of scans none has a pose within 100 ms; are their clocks the same?";
}

std::string ClassStatistics::table() const {
  if (frames_ == 0) {
    return {};
  }
  const auto spells = spells_of(last_);
  const bool had_spells = std::ranges::any_of(spells, [](auto times) { return times > 0; });
  const auto slices = slices_of(last_);
  const std::uint64_t all = std::accumulate(slices.begin(), slices.end(), std::uint64_t{0});
  const std::uint64_t jumped = slices[static_cast<std::size_t>(pose::Cause::kJump)];
  const std::uint64_t imprecise = slices[static_cast<std::size_t>(pose::Cause::kImprecise)];
  const bool had_poses =
      std::ranges::any_of(last_.pose_fates, [](auto poses) { return poses > 0; });
  const std::string since = was_restarted_ ? ", since the target's restart" : "";
  return row("class frames", std::to_string(frames_)) +
         row_if(incomplete_ + damaged_ > 0, "class frames not whole",
                std::to_string(incomplete_) + " incomplete, " + std::to_string(damaged_) +
                    " damaged") +
         row_if(cell_mm_ != geometry::kCellMm || extent_ != window::Extent{}, "class window",
                words_of_window(extent_, cell_mm_)) +
         row("class tiles", std::to_string(tiles_)) +
         row_if(tiles_not_sent_ > 0, "class tiles not sent", std::to_string(tiles_not_sent_)) +
         row("packets placed", std::to_string(packets_placed_) + ", and " +
                                   std::to_string(packets_not_placed_) + " without a place") +
         row("slices", list_of(slices, kPoseCauseNames) + since) +
         row_of_lost(jumped, all, kLostByJumps) +
         row_of_lost(imprecise, all,
                     "lost because the poses state standard deviations above 150 mm or 3 mrad in a "
                     "second; for a log that is better than it states, --poses-sigma MM MRAD says "
                     "so") +
         row_if(slices_over_budget_ + groups_left_ > 0, "over budget",
                std::to_string(slices_over_budget_) + " slices, " + std::to_string(groups_left_) +
                    " groups of cells") +
         row_if(had_spells, "times without a place", list_of(spells, kPoseCauseNames)) +
         row("poses", had_poses ? list_of(last_.pose_fates, kPoseFateNames) + since
                                : "none: classes need them, the index grid does not") +
         (had_end_ ? map_table(last_.map) : std::string()) + row("class run hash", hex(run_hash()));
}

}  // namespace iog::tools
