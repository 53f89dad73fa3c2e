// Polygons to the bytes of a map block (map/block.hpp).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "map/block.hpp"
#include "tools/map/polygon.hpp"

namespace iog::tools {

struct BlockInfo {
  std::int64_t latitude = 0;   // of the origin, 1e-9 degrees
  std::int64_t longitude = 0;  // of the origin, 1e-9 degrees
  map::BoxCm extent{};
  map::Source source = map::Source::kSurveyed;
  std::uint8_t belief = 0;  // of 256
  std::uint32_t date_s = 0;
  std::uint32_t accuracy_mm = 0;
  std::string attribution{};
};

class BlockWriter {
 public:
  // What a polygon became.
  enum class Fate : std::uint8_t { kTaken, kOutside, kTooSmall, kTooManyVertices };

  explicit BlockWriter(BlockInfo info) : info_(std::move(info)) {}

  // Cuts the polygon at the extent and rounds it to centimetres.
  Fate add(const Polygon& polygon);

  // The whole block, which map::check() passes if it is not longer than map::kMaxBlockBytes.
  // Features come in the order of their buckets, then of add().
  [[nodiscard]] std::vector<std::uint8_t> block();

 private:
  struct Shape {
    map::Kind kind;
    map::BoxCm box;
    std::vector<std::vector<map::PointCm>> rings;
  };

  [[nodiscard]] map::Buckets buckets_of(const Shape& shape) const {
    return map::Buckets::of(shape.box, info_.extent);
  }

  BlockInfo info_;
  std::vector<Shape> shapes_;
};

}  // namespace iog::tools
