// Groups hits by owner or by cluster. Each group contains the indices of its hits in ascending
// order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/rules.hpp"

namespace iog::objects {

template <std::size_t kGroups>
class Grouped {
 public:
  // `group_of(hit)` must return either a number below kGroups or kNobody.
  template <typename GroupOf>
  void group(std::span<const FrameHit> hits, GroupOf&& group_of) {
    begin_.fill(0);
    for (const FrameHit& hit : hits) {
      if (const std::int16_t its = group_of(hit); its != kNobody) {
        ++begin_[static_cast<std::size_t>(its) + 2];
      }
    }
    for (std::size_t i = 2; i < begin_.size(); ++i) {
      begin_[i] = static_cast<std::uint16_t>(begin_[i] + begin_[i - 1]);
    }
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (const std::int16_t its = group_of(hits[i]); its != kNobody) {
        of_[begin_[static_cast<std::size_t>(its) + 1]++] = static_cast<std::uint16_t>(i);
      }
    }
  }

  [[nodiscard]] std::span<const std::uint16_t> of(std::size_t group) const {
    return std::span(of_).subspan(begin_[group], std::size_t{begin_[group + 1]} - begin_[group]);
  }

 private:
  // Group i starts at begin_[i]. While group() fills in the indices, begin_[i + 1] is the next free
  // index of group i.
  std::array<std::uint16_t, kGroups + 2> begin_{};
  std::array<std::uint16_t, kMostHits> of_{};
};

using OwnedHits = Grouped<kMostTracks>;
using ClusterHits = Grouped<kMostClusters>;

}  // namespace iog::objects
