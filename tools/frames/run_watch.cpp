#include "tools/frames/run_watch.hpp"

#include <algorithm>
#include <utility>

namespace iog::tools {

RunWatch::Verdict RunWatch::arrive(const stream::Header& header,
                                   std::span<const std::byte> content) {
  const std::uint32_t run = header.run_number;
  if (newest_.value_or(run) == run) {
    newest_ = run;
    kept_.clear();
    return Verdict::kNewest;
  }
  if (std::ranges::find(replaced_, run) != replaced_.end()) {
    return Verdict::kReplaced;
  }
  if (candidate_ != run) {
    candidate_ = run;
    kept_.clear();
  }
  kept_.try_emplace(header.sequence, content.begin(), content.end());
  if (kept_.size() < kConfirmations) {
    return Verdict::kUnconfirmed;
  }
  replaced_.push_back(*newest_);
  if (replaced_.size() > kMaxReplaced) {
    replaced_.pop_front();
  }
  newest_ = run;
  return Verdict::kReplaces;
}

std::vector<std::vector<std::byte>> RunWatch::take_kept() {
  std::vector<std::vector<std::byte>> contents;
  for (auto& [sequence, content] : std::exchange(kept_, {})) {
    contents.push_back(std::move(content));
  }
  return contents;
}

}  // namespace iog::tools
