#include "health/memory_check.hpp"

#include <algorithm>

namespace iog::health {

std::uint32_t crc_of(std::span<const std::byte> bytes) {
  checksum::Crc32 crc;
  crc.update(bytes);
  return crc.value();
}

// Even an empty region takes one slice.
MemoryCheck::MemoryCheck(std::span<const Region> regions) : regions_(regions) {
  for (const Region& region : regions) {
    slices_ += std::max<std::size_t>((region.bytes.size() + kSliceBytes - 1) / kSliceBytes, 1);
  }
  interval_us_ = std::max(kRoundUs / std::max<std::size_t>(slices_, 1), kLeastIntervalUs);
}

std::optional<std::size_t> MemoryCheck::look_at_all() const {
  const auto damaged = std::ranges::find_if(
      regions_, [](const Region& region) { return crc_of(region.bytes) != region.crc; });
  if (damaged == regions_.end()) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(damaged - regions_.begin());
}

std::optional<std::size_t> MemoryCheck::step(std::uint64_t now_us) {
  if (!next_us_) {
    next_us_ = now_us + interval_us_;
  }
  for (std::size_t slice = 0; slice < kMostSlices && *next_us_ <= now_us; ++slice) {
    *next_us_ += interval_us_;
    if (regions_.empty()) {
      ++rounds_;
      continue;
    }
    const std::size_t region = region_;
    if (!look_at_next_slice()) {
      return region;
    }
  }
  return std::nullopt;
}

bool MemoryCheck::look_at_next_slice() {
  const Region& region = regions_[region_];
  const auto rest = region.bytes.subspan(offset_);
  if (rest.size() > kSliceBytes) {
    crc_.update(rest.first(kSliceBytes));
    offset_ += kSliceBytes;
    return true;
  }
  crc_.update(rest);
  const bool is_whole = crc_.value() == region.crc;
  crc_ = {};
  offset_ = 0;
  region_ = region_ + 1 == regions_.size() ? 0 : region_ + 1;
  rounds_ += region_ == 0 ? 1U : 0U;
  return is_whole;
}

}  // namespace iog::health
