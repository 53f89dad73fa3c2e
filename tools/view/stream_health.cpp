#include "tools/view/stream_health.hpp"

namespace iog::tools::view {

std::string_view name_of(StreamState state) {
  switch (state) {
    case StreamState::kWaiting:
      return "waiting";
    case StreamState::kLive:
      return "live";
    case StreamState::kStale:
      return "stale";
    case StreamState::kIncompatible:
      return "incompatible";
    case StreamState::kEnded:
      return "ended";
  }
  return "stale";
}

void StreamHealth::Watch::note(std::uint64_t now_count, std::int64_t now_ms) {
  if (now_count > count) {
    grown_ms = now_ms;
  }
  count = now_count;
}

bool StreamHealth::Watch::is_recent(std::int64_t now_ms) const {
  return grown_ms && now_ms - *grown_ms < kRecentMs;
}

void StreamHealth::note_counts(const MessageCounts& counts, std::int64_t now_ms) {
  restarts_.note(counts.restarts, now_ms);
  corrupt_.note(counts.corrupt + counts.malformed + counts.tiles_malformed +
                    counts.forged_signatures + counts.not_signed,
                now_ms);
  other_version_.note(counts.other_version, now_ms);
  not_understood_.note(counts.not_understood + counts.tiles_not_understood, now_ms);
}

StreamState StreamHealth::state(std::int64_t now_ms) const {
  if (has_ended_) {
    return StreamState::kEnded;
  }
  if (last_frame_ms_ && now_ms - *last_frame_ms_ < kStaleAfterMs) {
    return StreamState::kLive;
  }
  if (other_version_.is_recent(now_ms) || not_understood_.is_recent(now_ms)) {
    return StreamState::kIncompatible;
  }
  return last_frame_ms_ ? StreamState::kStale : StreamState::kWaiting;
}

std::int64_t StreamHealth::silent_ms(std::int64_t now_ms) const {
  return last_frame_ms_ ? now_ms - *last_frame_ms_ : 0;
}

bool StreamHealth::has_restarted_lately(std::int64_t now_ms) const {
  return restarts_.is_recent(now_ms);
}

bool StreamHealth::is_corrupt_lately(std::int64_t now_ms) const {
  return corrupt_.is_recent(now_ms);
}

bool StreamHealth::is_too_slow_lately(std::int64_t now_ms) const {
  return too_slow_.is_recent(now_ms);
}

bool StreamHealth::has_other_version_lately(std::int64_t now_ms) const {
  return other_version_.is_recent(now_ms);
}

}  // namespace iog::tools::view
