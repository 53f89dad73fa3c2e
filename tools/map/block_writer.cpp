#include "tools/map/block_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "checksum/crc32.hpp"

namespace iog::tools {
namespace {

using map::Buckets;
using map::PointCm;
using CmRing = std::vector<PointCm>;

constexpr std::size_t kSizeAt = 8;
constexpr std::size_t kCrcAt = 12;
constexpr std::int32_t kLongestStep = 32'767;  // of a ring, in x and in y

std::int32_t rounded(double cm) { return static_cast<std::int32_t>(std::lround(cm)); }

// With points in between where an edge is too long for a step.
CmRing in_steps(const CmRing& corners) {
  CmRing ring;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PointCm from = corners[i];
    const PointCm to = corners[(i + 1) % corners.size()];
    const std::int32_t longest = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
    const std::int32_t steps =
        std::max<std::int32_t>(1, (longest + kLongestStep - 1) / kLongestStep);
    for (std::int32_t step = 0; step < steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      ring.push_back(
          {from.x + rounded((to.x - from.x) * share), from.y + rounded((to.y - from.y) * share)});
    }
  }
  return ring;
}

// Does the outline turn back on itself at `at`? Differences fit in 25 bits.
bool is_spike(const PointCm& before, const PointCm& at, const PointCm& after) {
  const std::int64_t in_x = before.x - at.x;
  const std::int64_t in_y = before.y - at.y;
  const std::int64_t out_x = after.x - at.x;
  const std::int64_t out_y = after.y - at.y;
  return at == after || (in_x * out_y == in_y * out_x && in_x * out_x + in_y * out_y >= 0);
}

// Rounded, without points that repeat and without spikes, such as what is left of a ring that lies
// outside of what it was cut at; empty if there are fewer than three points.
CmRing in_centimetres(const Ring& ring) {
  CmRing corners;
  for (const PlanePoint& point : ring) {
    const PointCm corner{rounded(point.x), rounded(point.y)};
    while (corners.size() >= 2 && is_spike(corners[corners.size() - 2], corners.back(), corner)) {
      corners.pop_back();
    }
    if (corners.empty() || corners.back() != corner) {
      corners.push_back(corner);
    }
  }
  bool is_clean = false;
  while (!is_clean && corners.size() >= 3) {
    is_clean = true;
    if (is_spike(corners[corners.size() - 2], corners.back(), corners.front())) {
      corners.pop_back();
      is_clean = false;
    } else if (is_spike(corners.back(), corners[0], corners[1])) {
      corners.erase(corners.begin());
      is_clean = false;
    }
  }
  return corners.size() >= 3 ? in_steps(corners) : CmRing{};
}

class Bytes {
 public:
  void u8(std::uint8_t value) { bytes_.push_back(value); }
  void u16(std::uint32_t value) {
    u8(static_cast<std::uint8_t>(value >> 8));
    u8(static_cast<std::uint8_t>(value));
  }
  void u32(std::uint32_t value) {
    u16(value >> 16);
    u16(value & 0xFFFF);
  }
  void i32(std::int32_t value) { u32(static_cast<std::uint32_t>(value)); }
  void i64(std::int64_t value) {
    u32(static_cast<std::uint32_t>(static_cast<std::uint64_t>(value) >> 32));
    u32(static_cast<std::uint32_t>(value));
  }
  void point(const PointCm& point) {
    i32(point.x);
    i32(point.y);
  }
  void box(const map::BoxCm& box) {
    point(box.low);
    point(box.high);
  }
  void text(const std::string& text) {
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
  }
  void set_u32(std::size_t at, std::uint32_t value) {
    Bytes word;
    word.u32(value);
    std::ranges::copy(word.bytes_, bytes_.begin() + static_cast<std::ptrdiff_t>(at));
  }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::vector<std::uint8_t>& all() { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

void add_header(Bytes& out, const BlockInfo& info, std::size_t features) {
  out.u32(map::kMagic);
  out.u16(map::kVersion);
  out.u8(static_cast<std::uint8_t>(info.source));
  out.u8(info.belief);
  out.u32(0);  // the size and the CRC are known at the end
  out.u32(0);
  out.i64(info.latitude);
  out.i64(info.longitude);
  out.box(info.extent);
  out.u32(info.date_s);
  out.u32(info.accuracy_mm);
  out.u32(static_cast<std::uint32_t>(features));
  out.u16(static_cast<std::uint32_t>(info.attribution.size()));
  out.u16(0);
  out.text(info.attribution);
}

void add_ring(Bytes& out, const CmRing& ring) {
  out.u32(static_cast<std::uint32_t>(ring.size()));
  out.point(ring.front());
  for (std::size_t i = 1; i < ring.size(); ++i) {
    out.u16(static_cast<std::uint16_t>(ring[i].x - ring[i - 1].x));
    out.u16(static_cast<std::uint16_t>(ring[i].y - ring[i - 1].y));
  }
}

std::size_t vertices_of(const std::vector<CmRing>& rings) {
  std::size_t count = 0;
  for (const CmRing& ring : rings) {
    count += ring.size();
  }
  return count;
}

std::uint32_t crc_of(std::span<const std::uint8_t> block) {
  const auto bytes = std::as_bytes(block);
  checksum::Crc32 crc;
  crc.update(bytes.first(kCrcAt));
  crc.update(bytes.subspan(kCrcAt + 4));
  return crc.value();
}

}  // namespace

BlockWriter::Fate BlockWriter::add(const Polygon& polygon) {
  Shape shape{polygon.kind, {{INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN}}, {}};
  bool is_outside = true;
  for (const Ring& ring : polygon.rings) {
    const Ring inside = clipped(ring, info_.extent);
    is_outside = is_outside && inside.empty();
    CmRing corners = in_centimetres(inside);
    for (const PointCm& point : corners) {
      shape.box.low = {std::min(shape.box.low.x, point.x), std::min(shape.box.low.y, point.y)};
      shape.box.high = {std::max(shape.box.high.x, point.x), std::max(shape.box.high.y, point.y)};
    }
    if (!corners.empty()) {
      shape.rings.push_back(std::move(corners));
    }
  }
  if (shape.rings.empty()) {
    return is_outside ? Fate::kOutside : Fate::kTooSmall;
  }
  if (vertices_of(shape.rings) > map::kMaxFeatureVertices || shape.rings.size() > UINT16_MAX) {
    return Fate::kTooManyVertices;
  }
  shapes_.push_back(std::move(shape));
  return Fate::kTaken;
}

std::vector<std::uint8_t> BlockWriter::block() {
  std::ranges::stable_sort(shapes_, {}, [this](const Shape& shape) {
    const Buckets buckets = buckets_of(shape);
    return std::pair(buckets.first_row, buckets.first_column);
  });
  const Buckets all = Buckets::of(info_.extent, info_.extent);
  std::vector<std::vector<std::uint32_t>> entries(all.count());
  for (std::uint32_t number = 0; number < shapes_.size(); ++number) {
    const Buckets own = buckets_of(shapes_[number]);
    for (std::uint32_t row = own.first_row; row <= own.last_row; ++row) {
      for (std::uint32_t column = own.first_column; column <= own.last_column; ++column) {
        entries[std::size_t{row} * all.columns() + column].push_back(number);
      }
    }
  }

  Bytes out;
  add_header(out, info_, shapes_.size());
  std::uint32_t start = 0;
  out.u32(start);
  for (const auto& bucket : entries) {
    start += static_cast<std::uint32_t>(bucket.size());
    out.u32(start);
  }
  for (const auto& bucket : entries) {
    for (const std::uint32_t number : bucket) {
      out.u32(number);
    }
  }
  const std::size_t offsets_at = out.size();
  out.all().resize(offsets_at + 4 * shapes_.size());
  for (std::size_t number = 0; number < shapes_.size(); ++number) {
    out.set_u32(offsets_at + 4 * number, static_cast<std::uint32_t>(out.size()));
    const Shape& shape = shapes_[number];
    out.u8(static_cast<std::uint8_t>(shape.kind));
    out.u8(0);
    out.u16(static_cast<std::uint32_t>(shape.rings.size()));
    out.u32(static_cast<std::uint32_t>(vertices_of(shape.rings)));
    out.box(shape.box);
    for (const CmRing& ring : shape.rings) {
      add_ring(out, ring);
    }
  }
  out.set_u32(kSizeAt, static_cast<std::uint32_t>(out.size()));
  out.set_u32(kCrcAt, crc_of(out.all()));
  return std::move(out.all());
}

}  // namespace iog::tools
