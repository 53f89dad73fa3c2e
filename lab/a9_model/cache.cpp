#include "cache.hpp"

#include <algorithm>

namespace iog::a9_model {

Cache::Cache(std::uint32_t bytes, std::uint32_t ways, Replacement replacement)
    : ways_(ways),
      set_mask_(bytes / ways / kLineBytes - 1),
      replacement_(replacement),
      lines_(bytes / kLineBytes),
      recent_(lines_.data()) {}

Cache::Allocation Cache::allocate(LineAddress address) {
  Line& line = victim(&lines_[std::size_t{address & set_mask_} * ways_]);
  const Line evicted = line;
  line = {.address = address, .valid = true, .used = ++clock_};
  return {.line = &line, .evicted = evicted};
}

// An empty way first. The random choice is a Galois shift register of 16 bits, stepped at every
// replacement: like the hardware's it knows nothing of use, and every run repeats it.
Cache::Line& Cache::victim(Line* set) {
  Line* const end = set + open_ways_;
  Line* const empty = std::find_if(set, end, [](const Line& line) { return !line.valid; });
  if (empty != end) {
    return *empty;
  }
  if (replacement_ == Replacement::kRandom) {
    constexpr std::uint32_t kTaps = 0xb400;
    shift_register_ = (shift_register_ >> 1) ^ ((shift_register_ & 1u) != 0 ? kTaps : 0u);
    return set[shift_register_ % open_ways_];
  }
  return *std::min_element(set, end, [](const Line& a, const Line& b) { return a.used < b.used; });
}

}  // namespace iog::a9_model
