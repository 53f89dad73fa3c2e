#include "app/class_messages.hpp"

#include <array>
#include <utility>

namespace iog::app {
namespace {

constexpr std::array<std::pair<pose::Cause, std::uint16_t>, pose::kCauseCount - 1> kCauseFlags{{
    {pose::Cause::kLate, stream::kCauseLate},
    {pose::Cause::kImprecise, stream::kCauseImprecise},
    {pose::Cause::kLost, stream::kCauseLost},
    {pose::Cause::kJump, stream::kCauseJump},
    {pose::Cause::kRestart, stream::kCauseRestart},
    {pose::Cause::kContradicted, stream::kCauseContradicted},
    {pose::Cause::kDrifting, stream::kCauseDrifting},
}};

std::uint16_t causes_of(const PerceptionReport& report) {
  unsigned causes = 0;
  for (const auto& [cause, flag] : kCauseFlags) {
    causes |= (report.causes >> static_cast<unsigned>(cause) & 1U) != 0 ? flag : 0U;
  }
  const bool is_over_budget = report.slices_over_budget > 0 || report.window.groups_left > 0;
  return static_cast<std::uint16_t>(causes | (is_over_budget ? stream::kCauseOverBudget : 0U));
}

}  // namespace

stream::ClassWindow class_window_of(const PerceptionReport& report, window::TileNumber corner) {
  stream::ClassWindow window{.causes = causes_of(report),
                             .corner_a = corner.a,
                             .corner_b = corner.b,
                             .pose = report.end.pose,
                             .sigma = report.end.sigma,
                             .slices = static_cast<std::uint8_t>(report.slice_count),
                             .slice_ms = static_cast<std::uint8_t>(1U << report.log2_slice_ms),
                             .slices_begin_us = report.stamp_us,
                             .slices_end_us = report.stamp_us};
  if (report.slice_count > 0) {
    const pose::Slice& first = report.slices.front().slice;
    window.slices_begin_us = first.end_us - std::uint64_t{1000} * window.slice_ms;
    window.slices_end_us = report.slices[report.slice_count - 1].slice.end_us;
  }
  return window;
}

stream::MapState map_state_of(const PerceptionReport& report) {
  stream::MapState state{.layer = report.map, .delivery = report.map_delivery};
  if (report.map_block != nullptr) {
    state.in_use = stream::in_use(*report.map_block);
  }
  return state;
}

stream::ClassEnd class_end_of(const PerceptionReport& report, const stream::ClassWindow& window) {
  stream::ClassEnd end{.window = window,
                       .packets_placed = report.packets_placed,
                       .packets_not_placed = report.packets_not_placed,
                       .slices_over_budget = report.slices_over_budget,
                       .groups_fused = report.window.groups_fused,
                       .groups_left = report.window.groups_left,
                       .groups_refreshed = report.window.groups_refreshed,
                       .slice_count = window.slices,
                       .pose_fates = report.pose_fates,
                       .map = map_state_of(report)};
  for (std::size_t i = 0; i < report.slice_count; ++i) {
    const PlacedSlice& placed = report.slices[i];
    end.slices[i] = {
        .middle_us = placed.slice.middle_us, .pose = placed.pose, .sigma = placed.sigma};
  }
  for (std::size_t cause = 0; cause < pose::kCauseCount; ++cause) {
    end.causes[cause] = {.slices = report.slice_causes[cause], .began = report.tallies[cause]};
  }
  return end;
}

}  // namespace iog::app
