// One feature of a block. `docs/spec.md`, section 6.3, describes each byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "map/plane.hpp"
#include "map/words.hpp"

namespace iog::map {

inline constexpr std::uint32_t kMaxFeatureVertices = 65'535;
inline constexpr std::size_t kFeatureHeaderBytes = 24;
inline constexpr std::size_t kRingHeaderBytes = 12;

// The bits that represent the map's classes (decision/decision.hpp). Cells with neither of these
// bits are intermediate.
enum class Kind : std::uint8_t { kBuilding = 1, kRoad = 2 };

// A building or a part of a road. The area of a feature is the inside of its rings according to the
// even-odd rule.
class Feature {
 public:
  explicit Feature(std::span<const std::byte> checked) : words_{checked} {}

  [[nodiscard]] Kind kind() const { return static_cast<Kind>(words_.u8(0)); }
  [[nodiscard]] std::uint32_t ring_count() const { return words_.u16(2); }
  [[nodiscard]] std::uint32_t edge_count() const { return words_.u32(4); }
  [[nodiscard]] BoxCm box() const { return words_.box(8); }

  // Calls visit(PointCm from, PointCm to) for each edge of each ring. The closing edge of a ring is
  // visited last.
  template <typename Visit>
  void for_each_edge(Visit&& visit) const;

 private:
  friend class EdgeWalk;

  Words words_;
};

struct Edge {
  PointCm from;
  PointCm to;
};

// Iterates over the edges of a feature one by one, so that the iteration can be suspended.
class EdgeWalk {
 public:
  explicit EdgeWalk(const Feature& feature)
      : words_(feature.words_), rings_(feature.ring_count()), at_(kFeatureHeaderBytes) {
    begin_ring();
  }

  [[nodiscard]] bool is_over() const { return rings_ == 0; }

  // Returns the next edge. Do not call this function if is_over() returns true.
  [[nodiscard]] Edge next() {
    const PointCm from = from_;
    if (deltas_ == 0) {
      --rings_;
      const PointCm first = first_;
      begin_ring();
      return {from, first};
    }
    --deltas_;
    from_ = {from.x + words_.i16(at_), from.y + words_.i16(at_ + 2)};
    at_ += 4;
    return {from, from_};
  }

 private:
  void begin_ring() {
    if (rings_ > 0) {
      deltas_ = words_.u32(at_) - 1;
      first_ = words_.point(at_ + 4);
      from_ = first_;
      at_ += kRingHeaderBytes;
    }
  }

  Words words_;
  std::uint32_t rings_;  // remaining rings
  std::uint32_t deltas_ = 0;
  std::size_t at_;
  PointCm first_{};
  PointCm from_{};
};

template <typename Visit>
void Feature::for_each_edge(Visit&& visit) const {
  for (EdgeWalk walk(*this); !walk.is_over();) {
    const auto [from, to] = walk.next();
    visit(from, to);
  }
}

}  // namespace iog::map
