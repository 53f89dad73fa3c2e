#include "tools/frames/sequence_watch.hpp"

#include <algorithm>

namespace iog::tools {

SequenceWatch::Arrival SequenceWatch::arrive(std::uint32_t sequence) {
  if (!has_started_) {
    has_started_ = true;
    first_ = sequence;
    wait_for(sequence - std::min(sequence, kBeginning), sequence);
    expected_ = sequence + 1;
    return Arrival::kInOrder;
  }
  const std::uint32_t ahead = sequence - expected_;
  if (ahead < 0x80000000U) {
    lost_ += ahead;
    wait_for(sequence - std::min(ahead, kPatience), sequence);
    expected_ = sequence + 1;
    return Arrival::kInOrder;
  }
  if (missing_.erase(sequence) == 0) {
    return Arrival::kRepeated;
  }
  const bool was_lost = sequence - first_ < 0x80000000U;
  lost_ -= was_lost ? 1U : 0U;
  return Arrival::kLate;
}

void SequenceWatch::wait_for(std::uint32_t first, std::uint32_t end) {
  for (std::uint32_t missing = first; missing != end; ++missing) {
    missing_.insert(missing);
  }
  while (missing_.size() > kPatience) {
    missing_.erase(missing_.begin());
  }
}

void SequenceWatch::restart() {
  has_started_ = false;
  missing_.clear();
}

}  // namespace iog::tools
