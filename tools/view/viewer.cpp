#include "tools/view/viewer.hpp"

#include <charconv>
#include <string_view>

#include "tools/program/exit_status.hpp"
#include "tools/program/time_of_day.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools::view {
namespace {

constexpr std::string_view kJump = "jump ";

// Of "jump 12345"; nothing of other words.
std::optional<std::uint64_t> jump_of(std::string_view request) {
  if (!request.starts_with(kJump)) {
    return std::nullopt;
  }
  request.remove_prefix(kJump.size());
  std::uint64_t place_ms = 0;
  const auto [end, error] =
      std::from_chars(request.data(), request.data() + request.size(), place_ms);
  const bool is_whole = error == std::errc() && end == request.data() + request.size();
  return is_whole ? std::optional(place_ms) : std::nullopt;
}

}  // namespace

Viewer::Viewer(Scene& scene, Origin origin, Recorder recorder)
    : scene_(&scene),
      origin_(std::move(origin)),
      recorder_(std::move(recorder)),
      assembler_([this](GridFrame&& frame) {
        if (is_holding_) {
          held_.push_back(std::move(frame));
        } else {
          show(frame, {});
        }
      }) {
  scene_->publish_status(status());
}

std::int64_t Viewer::now_ms() const {
  return std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start_).count();
}

void Viewer::take(std::span<const std::byte> datagram, std::uint64_t time_us) {
  try {
    recorder_.take(datagram, time_us);
  } catch (const UsageError& error) {
    problem_ = error.what();  // what comes is shown all the same
  }
  for (Recording* const other : others_) {
    other->take_datagram({.time_us = time_us,
                          .source = {},
                          .destination = {},
                          .payload = {datagram.begin(), datagram.end()}});
  }
  assembler_.take(datagram);
}

void Viewer::show_next(const Surroundings& surroundings) {
  const GridFrame frame = std::move(held_.front());
  held_.erase(held_.begin());
  show(frame, surroundings);
}

void Viewer::show(const GridFrame& frame, const Surroundings& surroundings) {
  const MessageCounts& counts = assembler_.counts();
  grid_.take(frame);
  FrameFacts facts = facts_of(frame, grid_, counts.bytes - bytes_before_);
  facts.classes = take_classes(frame);
  frame_ = facts;
  bytes_before_ = counts.bytes;
  if (vehicle_id_ != frame.header.vehicle_id || epsilon_ != frame.epsilon()) {
    vehicle_id_ = frame.header.vehicle_id;
    epsilon_ = frame.epsilon();
    scene_->set_vehicle(vehicle_json(*vehicle_id_, epsilon_));
  }
  const std::int64_t now = now_ms();
  // A frame of which no tile can be shown makes no picture of now.
  const bool shows_classes = frame.classes && frame.classes->valid_tiles.any();
  if (frame.valid_tiles.any() || frame.is_damaged || shows_classes) {
    health_.note_frame(now);
  }
  health_.note_points_not_taken(frame.has_end ? points_not_taken(frame.end) : 0, now);
  health_.note_counts(counts, now);
  last_status_ms_ = now;
  scene_->publish_frame(grid_, classes_, surroundings, status(),
                        frame.knows_objects() ? &*frame.objects : nullptr);
  for (Recording* const other : others_) {
    other->take_frame({.frame = &frame,
                       .live = &grid_,
                       .classes = &classes_,
                       .time_us = time_of_day_us(),
                       .points = surroundings.points});
  }
}

std::optional<ClassFacts> Viewer::take_classes(const GridFrame& frame) {
  classes_.take(frame);
  if (!frame.classes || !frame.classes->has_window()) {
    return std::nullopt;
  }
  const bool had_classes = frame_ && frame_->classes;
  return class_facts_of(*frame.classes, classes_, had_classes ? &*frame_->classes : nullptr);
}

void Viewer::obey(const std::string& request) {
  try {
    problem_.clear();
    if (request == "record") {
      recorder_.start();
    } else if (request == "stop") {
      recorder_.stop();
    } else if (const auto place_ms = jump_of(request); place_ms && playback_) {
      jump_ms_ = std::min(*place_ms, playback_->span_ms);
    }
  } catch (const UsageError& error) {
    problem_ = error.what();
  }
}

void Viewer::tend(std::uint64_t overflow) {
  overflow_ = overflow;
  const std::vector<std::string> requests = scene_->take_requests();
  for (const std::string& request : requests) {
    obey(request);
  }
  const std::int64_t now = now_ms();
  health_.note_counts(assembler_.counts(), now);
  if (!requests.empty() || now - last_status_ms_ >= kStatusEveryMs) {
    last_status_ms_ = now;
    scene_->publish_status(status());
  }
}

void Viewer::note_silence() {
  assembler_.note_silence();
  note_gap();
}

void Viewer::note_gap() {
  grid_.forget();
  classes_.forget();
}

// Frames that still wait are of the place before.
void Viewer::begin_again() {
  is_holding_ = true;
  assembler_.forget();
  held_.clear();
  is_holding_ = false;
  health_.note_begin();
  grid_.forget();
  classes_.forget();
}

void Viewer::note_end() {
  is_holding_ = true;
  assembler_.finish();
  while (!held_.empty()) {
    const GridFrame frame = std::move(held_.front());
    held_.erase(held_.begin());
    if (frame.has_end || !held_.empty()) {
      show(frame, {});
    } else {
      health_.note_broken_off();
    }
  }
  health_.note_end();
  scene_->publish_status(status());
}

std::string Viewer::status() const {
  return status_json({.health = &health_,
                      .assembler = &assembler_,
                      .recorder = &recorder_,
                      .frame = &frame_,
                      .source = origin_.words,
                      .kind = origin_.kind,
                      .block = origin_.block,
                      .problem = problem_,
                      .playback = playback_,
                      .overflow = overflow_,
                      .now_ms = now_ms()});
}

}  // namespace iog::tools::view
