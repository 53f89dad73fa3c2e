#include "objects/clusters.hpp"

#include <algorithm>
#include <bit>

namespace iog::objects {
namespace {

bool is_fresh(const FrameHit& hit) { return hit.owner == kNobody && !hit.is_old; }

// Bits first ... last of a word, 0 <= first <= last <= 31.
constexpr std::uint32_t bits_between(std::int32_t first, std::int32_t last) {
  return (~std::uint32_t{0} << first) & (~std::uint32_t{0} >> (31 - last));
}

}  // namespace

std::int32_t gap_mm(Point car, Point at) {
  return kGapMm + range_mm(car, at) / 1000 * kGapOfAMetre;
}

std::uint32_t Clusters::find(const window::Area& area, Point car, FrameHits& hits) {
  first_ = {area.corner().a * window::kTileSide, area.corner().b * window::kTileSide};
  car_ = car;
  count_ = 0;
  begin(hits);
  std::uint32_t left = 0;
  const std::span<FrameHit> all = hits.all();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_fresh(all[i]) && all[i].cluster == kNobody) {
      if (count_ < clusters_.size()) {
        grow(i, hits);
      } else {
        ++left;
      }
    }
  }
  clear(hits);
  hits_.group(all, [](const FrameHit& hit) { return hit.cluster; });
  return left;
}

void Clusters::begin(FrameHits& hits) {
  for (const FrameHit& hit : hits.all()) {
    if (is_fresh(hit)) {
      const geometry::Cell cell = in_window(hit);
      plane_[static_cast<std::size_t>(cell.y)][static_cast<std::size_t>(cell.x) / 32] |=
          std::uint32_t{1} << (cell.x % 32);
    }
  }
}

void Clusters::grow(std::size_t seed, FrameHits& hits) {
  clusters_[count_] = {};
  queued_ = 0;
  take_cell(hits.all()[seed].cell, hits);
  for (std::size_t next = 0; next < queued_; ++next) {
    take_around(hits.all()[queue_[next]], hits);
  }
  ++count_;
}

// Takes all cells within the gap whose bits are still set.
void Clusters::take_around(const FrameHit& hit, FrameHits& hits) {
  const std::int32_t cells = gap_mm(car_, hit.at()) / geometry::kCellMm;
  const geometry::Cell middle = in_window(hit);
  const std::int32_t low_x = std::max<std::int32_t>(middle.x - cells, 0);
  const std::int32_t high_x = std::min(middle.x + cells, window::kCellsAcross - 1);
  const std::int32_t low_y = std::max<std::int32_t>(middle.y - cells, 0);
  const std::int32_t high_y = std::min(middle.y + cells, window::kCellsAcross - 1);
  for (std::int32_t word = low_x / 32; word <= high_x / 32; ++word) {
    const std::uint32_t asked = bits_between(std::max<std::int32_t>(low_x - word * 32, 0),
                                             std::min<std::int32_t>(high_x - word * 32, 31));
    for (std::int32_t y = low_y; y <= high_y; ++y) {
      const std::uint32_t found =
          plane_[static_cast<std::size_t>(y)][static_cast<std::size_t>(word)] & asked;
      for (std::uint32_t rest = found; rest != 0; rest &= rest - 1) {
        const std::int32_t x = word * 32 + std::countr_zero(rest);
        take_cell({first_.x + x, first_.y + y}, hits);
      }
    }
  }
}

// Takes all fresh hits of a cell.
void Clusters::take_cell(geometry::Cell cell, FrameHits& hits) {
  const std::span<FrameHit> all = hits.all();
  const std::size_t first = hits.first_of(cell);
  Cluster& cluster = clusters_[count_];
  bool is_queued = false;
  for (std::size_t i = first; i < all.size() && all[i].cell == cell; ++i) {
    if (!is_fresh(all[i])) {
      continue;
    }
    all[i].cluster = static_cast<std::int16_t>(count_);
    ++cluster.hits;
    if (!is_queued) {
      queue_[queued_++] = static_cast<std::uint16_t>(i);
      is_queued = true;
    }
  }
  cluster.bounds.include(centre_of(cell));
  const geometry::Cell place{cell.x - first_.x, cell.y - first_.y};
  plane_[static_cast<std::size_t>(place.y)][static_cast<std::size_t>(place.x) / 32] &=
      ~(std::uint32_t{1} << (place.x % 32));
}

// Clears the bits of hits that found no cluster.
void Clusters::clear(FrameHits& hits) {
  for (const FrameHit& hit : hits.all()) {
    if (!is_fresh(hit) || hit.cluster != kNobody) {
      continue;
    }
    const geometry::Cell cell = in_window(hit);
    plane_[static_cast<std::size_t>(cell.y)][static_cast<std::size_t>(cell.x) / 32] &=
        ~(std::uint32_t{1} << (cell.x % 32));
  }
}

}  // namespace iog::objects
