#include "perception_pass.hpp"

#include <algorithm>
#include <array>

#include "stream/class_hash.hpp"
#include "wire/byte_order.hpp"

namespace iog::lab {

void PerceptionPass::take(const intake::Datagram& datagram, std::uint32_t received,
                          std::uint64_t now_us) {
  const std::uint32_t start = counter_.now();
  pipeline_.take(datagram, now_us);
  end_call(received + (counter_.now() - start) - counter_.of_nothing());
}

void PerceptionPass::tick(std::uint64_t now_us) {
  const std::uint32_t start = counter_.now();
  pipeline_.tick(now_us);
  end_call(counter_.now() - start - counter_.of_nothing());
}

// A call closes two frames at most; the second is all but empty.
void PerceptionPass::end_call(std::uint32_t instructions) {
  spent_ += instructions - log_.take_instructions();
  if (log_.take_closed() > 0) {
    whole_.add(std::exchange(spent_, 0U));
  }
}

void ClassLog::take_classes(const stream::ClassEnd& end, const window::WindowView& classes) {
  const std::uint32_t start = counter_.now();
  const window::TileNumber corner = classes.area().corner();
  stream::ClassHash hash({.a = corner.a, .b = corner.b});
  std::uint32_t tiles = 0;
  for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
    if (const auto cells = classes.class_bytes(slot)) {
      hash.add(slot, *cells);
      ++tiles;
    }
  }
  std::array<std::byte, 4> crc{};
  wire::store_be32(crc, hash.value());
  if (has_evidence_) {
    run_hash_.update(crc);
  }
  if (end.slice_count > 0) {
    ++closed_;
    ++counts_.frames;
    counts_.points += points_;
    counts_.slices += end.slice_count;
    counts_.groups_fused += end.groups_fused;
    counts_.groups_left += end.groups_left;
    counts_.groups_refreshed += end.groups_refreshed;
    counts_.most_groups = std::max(counts_.most_groups, end.groups_fused);
    counts_.tiles += tiles;
  }
  instructions_ += counter_.now() - start;
}

}  // namespace iog::lab
