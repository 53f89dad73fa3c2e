// A map block byte by byte, as docs/spec.md, section 6, describes it: small, and without care for
// speed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fakes/bitwise_crc32.hpp"
#include "map/feature.hpp"
#include "map/plane.hpp"

namespace iog::tests {

using ReferenceRing = std::vector<map::PointCm>;

inline ReferenceRing rectangle(const map::BoxCm& box) {
  return {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
}

// The box around a place, so far to each side of it.
constexpr map::BoxCm box_around(map::PointCm middle, std::int32_t reach_cm) {
  return {{middle.x - reach_cm, middle.y - reach_cm}, {middle.x + reach_cm, middle.y + reach_cm}};
}

struct ReferenceFeature {
  map::Kind kind = map::Kind::kBuilding;
  std::vector<ReferenceRing> rings{};

  [[nodiscard]] map::BoxCm box() const {
    map::BoxCm box{rings[0][0], rings[0][0]};
    for (const auto& ring : rings) {
      for (const map::PointCm& point : ring) {
        box.low = {std::min(box.low.x, point.x), std::min(box.low.y, point.y)};
        box.high = {std::max(box.high.x, point.x), std::max(box.high.y, point.y)};
      }
    }
    return box;
  }
};

struct ReferenceBlock {
  std::int64_t latitude = 49'012'345'678;
  std::int64_t longitude = -8'765'432'109;
  map::BoxCm extent{{-5'000, -4'000}, {5'000, 4'000}};
  std::uint8_t source = 1;
  std::uint8_t belief = 248;
  std::uint32_t date_s = 1'700'000'000;
  std::uint32_t accuracy_mm = 500;
  std::string attribution = "A town";
  std::vector<ReferenceFeature> features{};

  [[nodiscard]] std::uint32_t columns() const {
    return static_cast<std::uint32_t>((extent.high.x - extent.low.x) / 2'560 + 1);
  }
  [[nodiscard]] std::uint32_t rows() const {
    return static_cast<std::uint32_t>((extent.high.y - extent.low.y) / 2'560 + 1);
  }
  // Where the tables of its bytes are.
  [[nodiscard]] std::size_t starts_at() const { return 64 + (attribution.size() + 3) / 4 * 4; }
  [[nodiscard]] std::size_t entries_at() const {
    const std::size_t count = std::size_t{columns()} * rows();
    return starts_at() + 4 * (count + 1);
  }
  [[nodiscard]] std::size_t offsets_at() const {
    std::size_t entries = 0;
    for (const auto& bucket : buckets()) {
      entries += bucket.size();
    }
    return entries_at() + 4 * entries;
  }
  [[nodiscard]] std::size_t features_at() const { return offsets_at() + 4 * features.size(); }

  // The features whose boxes meet each bucket.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> buckets() const {
    std::vector<std::vector<std::uint32_t>> all(std::size_t{columns()} * rows());
    const auto bucket = [](std::int32_t at, std::int32_t low) {
      return static_cast<std::size_t>((at - low) / 2'560);
    };
    for (std::uint32_t i = 0; i < features.size(); ++i) {
      const map::BoxCm box = features[i].box();
      const std::size_t last_row = bucket(box.high.y, extent.low.y);
      const std::size_t last_column = bucket(box.high.x, extent.low.x);
      for (std::size_t row = bucket(box.low.y, extent.low.y); row <= last_row; ++row) {
        for (std::size_t column = bucket(box.low.x, extent.low.x); column <= last_column;
             ++column) {
          all.at(row * columns() + column).push_back(i);
        }
      }
    }
    return all;
  }

  [[nodiscard]] std::vector<std::uint8_t> bytes() const;
};

inline void put(std::vector<std::uint8_t>& bytes, std::size_t at, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) {
    bytes.at(at + static_cast<std::size_t>(i)) =
        static_cast<std::uint8_t>(value >> 8 * (count - 1 - i));
  }
}

inline void append(std::vector<std::uint8_t>& bytes, std::int64_t value, int count) {
  bytes.resize(bytes.size() + static_cast<std::size_t>(count));
  put(bytes, bytes.size() - static_cast<std::size_t>(count), static_cast<std::uint64_t>(value),
      count);
}

// The CRC that a block says, which is its name.
inline std::uint32_t crc_of(const std::vector<std::uint8_t>& block) {
  return std::uint32_t{block.at(12)} << 24 | std::uint32_t{block.at(13)} << 16 |
         std::uint32_t{block.at(14)} << 8 | block.at(15);
}

// Says how long the block is, and its CRC-32 without bytes 12 ... 15.
inline std::vector<std::uint8_t> sealed(std::vector<std::uint8_t> bytes) {
  put(bytes, 8, bytes.size(), 4);
  const auto all = std::as_bytes(std::span(bytes));
  put(bytes, 12, BitwiseCrc32().add(all.first(12)).add(all.subspan(16)).value(), 4);
  return bytes;
}

inline void append_feature(std::vector<std::uint8_t>& bytes, const ReferenceFeature& feature) {
  append(bytes, static_cast<std::int64_t>(feature.kind), 1);
  append(bytes, 0, 1);
  append(bytes, static_cast<std::int64_t>(feature.rings.size()), 2);
  std::size_t vertices = 0;
  for (const auto& ring : feature.rings) {
    vertices += ring.size();
  }
  append(bytes, static_cast<std::int64_t>(vertices), 4);
  const map::BoxCm box = feature.box();
  for (const std::int32_t side : {box.low.x, box.low.y, box.high.x, box.high.y}) {
    append(bytes, side, 4);
  }
  for (const auto& ring : feature.rings) {
    append(bytes, static_cast<std::int64_t>(ring.size()), 4);
    append(bytes, ring[0].x, 4);
    append(bytes, ring[0].y, 4);
    for (std::size_t i = 1; i < ring.size(); ++i) {
      append(bytes, ring[i].x - ring[i - 1].x, 2);
      append(bytes, ring[i].y - ring[i - 1].y, 2);
    }
  }
}

inline std::vector<std::uint8_t> ReferenceBlock::bytes() const {
  std::vector<std::uint8_t> bytes;
  append(bytes, 0x494F474D, 4);
  append(bytes, 1, 2);
  append(bytes, source, 1);
  append(bytes, belief, 1);
  append(bytes, 0, 8);
  append(bytes, latitude, 8);
  append(bytes, longitude, 8);
  for (const std::int32_t side : {extent.low.x, extent.low.y, extent.high.x, extent.high.y}) {
    append(bytes, side, 4);
  }
  append(bytes, date_s, 4);
  append(bytes, accuracy_mm, 4);
  append(bytes, static_cast<std::int64_t>(features.size()), 4);
  append(bytes, static_cast<std::int64_t>(attribution.size()), 2);
  append(bytes, 0, 2);
  bytes.insert(bytes.end(), attribution.begin(), attribution.end());
  bytes.resize(starts_at());

  std::size_t entries = 0;
  append(bytes, 0, 4);
  for (const auto& bucket : buckets()) {
    entries += bucket.size();
    append(bytes, static_cast<std::int64_t>(entries), 4);
  }
  for (const auto& bucket : buckets()) {
    for (const std::uint32_t number : bucket) {
      append(bytes, number, 4);
    }
  }
  const std::size_t offset_at = bytes.size();
  bytes.resize(features_at());
  for (std::size_t i = 0; i < features.size(); ++i) {
    put(bytes, offset_at + 4 * i, bytes.size(), 4);
    append_feature(bytes, features[i]);
  }
  return sealed(std::move(bytes));
}

}  // namespace iog::tests
