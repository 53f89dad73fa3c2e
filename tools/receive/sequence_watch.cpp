#include "tools/receive/sequence_watch.hpp"

namespace iog::tools {

SequenceWatch::Arrival SequenceWatch::arrive(std::uint32_t sequence) {
  if (!has_started_) {
    has_started_ = true;
    expected_ = sequence + 1;
    return Arrival::kInOrder;
  }
  const std::uint32_t ahead = sequence - expected_;
  if (ahead < 0x80000000U) {
    lost_ += ahead;
    const std::uint32_t first = ahead > kPatience ? sequence - kPatience : expected_;
    for (std::uint32_t missing = first; missing != sequence; ++missing) {
      missing_.insert(missing);
    }
    while (missing_.size() > kPatience) {
      missing_.erase(missing_.begin());
    }
    expected_ = sequence + 1;
    return Arrival::kInOrder;
  }
  if (missing_.erase(sequence) > 0) {
    --lost_;
    return Arrival::kLate;
  }
  return Arrival::kRepeated;
}

bool SequenceWatch::is_missing(std::uint32_t first, std::uint32_t end) const {
  const auto next = missing_.lower_bound(first);
  return next != missing_.end() && *next < end;
}

void SequenceWatch::restart() {
  has_started_ = false;
  missing_.clear();
}

}  // namespace iog::tools
