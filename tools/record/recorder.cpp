#include "tools/record/recorder.hpp"

#include <algorithm>
#include <utility>

#include "net/udp.hpp"

namespace iog::tools {

Recorder::Recorder(Recordings recordings)
    : recordings_(std::move(recordings)),
      census_([this](const GridFrame& frame) { take_frame(frame); }) {}

void Recorder::take(const CapturedDatagram& datagram) {
  now_us_ = datagram.time_us;
  if (datagram.payload.size() > net::kMaxUdpPayloadBytes) {
    ++too_long_;
    return;
  }
  ++datagrams_;
  for (const std::unique_ptr<Recording>& recording : recordings_) {
    recording->take_datagram(datagram);
  }
  census_.take(datagram.payload);
}

void Recorder::add_points(std::span<const SeenPoint> points) {
  points_.insert(points_.end(), points.begin(), points.end());
}

bool Recorder::wants_points() const {
  return std::ranges::any_of(recordings_, [](const auto& each) { return each->wants_points(); });
}

void Recorder::note_silence(std::uint64_t now_us) {
  now_us_ = now_us;
  census_.note_silence();
  note_gap();
}

void Recorder::note_gap() {
  live_.forget();
  live_classes_.forget();
}

void Recorder::keep_beginning() {
  if (std::exchange(is_kept_, true)) {
    return;
  }
  for (const std::unique_ptr<Recording>& recording : recordings_) {
    recording->keep_beginning();
  }
}

void Recorder::finish() {
  is_over_ = true;
  census_.finish();
  for (const std::unique_ptr<Recording>& recording : recordings_) {
    recording->finish(census_.facts());
  }
}

void Recorder::take_frame(const GridFrame& frame) {
  if (is_over_ && !frame.has_end) {
    return;
  }
  const bool has_evidence = frame.header.has_evidence();
  if (has_evidence) {
    keep_beginning();
  }
  live_.take(frame);
  live_classes_.take(frame);
  for (const std::unique_ptr<Recording>& recording : recordings_) {
    recording->take_frame({.frame = &frame,
                           .live = &live_,
                           .classes = &live_classes_,
                           .time_us = now_us_,
                           .points = has_evidence ? std::span<const SeenPoint>(points_)
                                                  : std::span<const SeenPoint>()});
  }
  if (has_evidence) {
    ++evidence_frames_;
    points_.clear();
  }
}

}  // namespace iog::tools
