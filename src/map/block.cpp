#include "map/block.hpp"

namespace iog::map {
namespace {

constexpr std::int64_t kMaxLatitude = 90'000'000'000;    // 1e-9 degrees
constexpr std::int64_t kMaxLongitude = 180'000'000'000;  // 1e-9 degrees
constexpr std::size_t kCrcAt = 12;

std::uint32_t attribution_bytes(const Words& block) { return block.u16(60); }

// Where the attribution ends, padded to whole words.
std::size_t end_of_text(const Words& block) {
  return kHeaderBytes + (std::size_t{attribution_bytes(block)} + 3) / 4 * 4;
}

// The end of a table of `count` numbers, or size + 1 if it does not fit.
std::size_t end_of_table(std::size_t at, std::uint32_t count, std::size_t size) {
  return at <= size && count <= (size - at) / 4 ? at + 4 * std::size_t{count} : size + 1;
}

// Header and text must be valid. features_at is beyond the bytes if a table does not fit.
Tables tables_of(const Words& block) {
  const std::size_t size = block.bytes().size();
  const BoxCm extent = block.box(32);
  Tables tables{.extent = extent,
                .buckets = Buckets::of(extent, extent),
                .features = block.u32(56),
                .starts_at = end_of_text(block)};
  const std::uint32_t buckets = tables.buckets.count();
  tables.entries_at = end_of_table(tables.starts_at, buckets + 1, size);
  const std::uint32_t entries = tables.entries_at <= size ? block.u32(tables.entries_at - 4) : 0;
  tables.offsets_at = end_of_table(tables.entries_at, entries, size);
  tables.features_at = end_of_table(tables.offsets_at, tables.features, size);
  return tables;
}

Refusal check_envelope(const Words& block) {
  const std::size_t size = block.bytes().size();
  if (size < kHeaderBytes) {
    return Refusal::kTooShort;
  }
  if (size > kMaxBlockBytes) {
    return Refusal::kTooLong;
  }
  if (block.u32(0) != kMagic) {
    return Refusal::kNotABlock;
  }
  if (block.u16(4) != kVersion) {
    return Refusal::kWrongVersion;
  }
  return block.u32(8) == size ? Refusal::kNone : Refusal::kWrongLength;
}

bool is_within(std::int64_t value, std::int64_t limit) { return -limit <= value && value <= limit; }

bool is_extent(const BoxCm& box) {
  return box.low.x < box.high.x && box.low.y < box.high.y &&
         is_within(box.low.x, kMaxCoordinateCm) && is_within(box.low.y, kMaxCoordinateCm) &&
         is_within(box.high.x, kMaxCoordinateCm) && is_within(box.high.y, kMaxCoordinateCm);
}

bool is_control(std::byte letter) { return letter < std::byte{0x20} || letter == std::byte{0x7F}; }

Refusal check_header(const Words& block) {
  const std::uint8_t source = block.u8(6);
  if (source < 1 || source > 2 || block.u8(7) == 0) {
    return Refusal::kWrongSource;
  }
  if (!is_within(block.i64(16), kMaxLatitude) || !is_within(block.i64(24), kMaxLongitude)) {
    return Refusal::kWrongOrigin;
  }
  if (!is_extent(block.box(32))) {
    return Refusal::kWrongExtent;
  }
  if (block.u32(52) == 0 || block.u32(52) > kMaxAccuracyMm) {
    return Refusal::kWrongAccuracy;
  }
  const std::uint32_t text = attribution_bytes(block);
  const std::size_t end = end_of_text(block);
  if (text == 0 || text > kMaxAttributionBytes || end > block.bytes().size()) {
    return Refusal::kWrongText;
  }
  const auto letters = block.bytes().subspan(kHeaderBytes, text);
  if (std::ranges::any_of(letters, is_control)) {
    return Refusal::kWrongText;
  }
  const auto padding = block.bytes().first(end).subspan(kHeaderBytes + text);
  const bool is_padded =
      std::ranges::all_of(padding, [](std::byte byte) { return byte == std::byte{0}; });
  return is_padded && block.u16(62) == 0 ? Refusal::kNone : Refusal::kNotZero;
}

// Checks the rings of a feature. Its header must be within the bytes.
Refusal check_rings(const Words& feature) {
  const std::size_t size = feature.bytes().size();
  std::size_t at = kFeatureHeaderBytes;
  std::uint32_t vertices = 0;
  for (std::uint32_t ring = feature.u16(2); ring > 0; --ring) {
    if (size - at < kRingHeaderBytes) {
      return Refusal::kWrongRing;
    }
    const std::uint32_t count = feature.u32(at);
    if (count < 3 || count - 1 > (size - at - kRingHeaderBytes) / 4) {
      return Refusal::kWrongRing;
    }
    at += kRingHeaderBytes + 4 * std::size_t{count - 1};
    vertices += count;
  }
  const bool is_full = at == size && vertices == feature.u32(4) && vertices > 0;
  return is_full ? Refusal::kNone : Refusal::kWrongRing;
}

// The box of rings that check_rings() has passed; empty if a point is beyond kMaxCoordinateCm.
// Coordinates need 64 bits here, because those of a foreign block may reach 2^31 + 65,535 * 2^15.
std::optional<BoxCm> box_of_rings(const Words& feature) {
  BoxCm box{{INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN}};
  std::size_t at = kFeatureHeaderBytes;
  for (std::uint32_t ring = feature.u16(2); ring > 0; --ring) {
    const std::uint32_t vertices = feature.u32(at);
    std::int64_t x = feature.point(at + 4).x;
    std::int64_t y = feature.point(at + 4).y;
    at += kRingHeaderBytes;
    for (std::uint32_t i = 0; i < vertices; ++i) {
      if (i > 0) {
        x += feature.i16(at);
        y += feature.i16(at + 2);
        at += 4;
      }
      if (!is_within(x, kMaxCoordinateCm) || !is_within(y, kMaxCoordinateCm)) {
        return std::nullopt;
      }
      const PointCm point{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
      box.low = {std::min(box.low.x, point.x), std::min(box.low.y, point.y)};
      box.high = {std::max(box.high.x, point.x), std::max(box.high.y, point.y)};
    }
  }
  return box;
}

Refusal check_feature(const Words& feature, const BoxCm& extent) {
  if (feature.u8(0) != 1 && feature.u8(0) != 2) {
    return Refusal::kWrongKind;
  }
  if (feature.u8(1) != 0) {
    return Refusal::kNotZero;
  }
  if (feature.u32(4) > kMaxFeatureVertices) {
    return Refusal::kTooManyVertices;
  }
  if (const Refusal refusal = check_rings(feature); refusal != Refusal::kNone) {
    return refusal;
  }
  const std::optional<BoxCm> box = box_of_rings(feature);
  if (!box || !extent.holds(box->low) || !extent.holds(box->high)) {
    return Refusal::kOutside;
  }
  return *box == feature.box(8) ? Refusal::kNone : Refusal::kWrongBox;
}

// Checks the feature with this number. `at` must be the end of the previous feature, and is set to
// the end of this one.
Refusal check_next_feature(const Words& block, const Tables& tables, std::uint32_t number,
                           std::size_t& at) {
  const std::size_t size = block.bytes().size();
  const bool is_last = number + 1 == tables.features;
  const std::size_t end =
      is_last ? size : block.u32(tables.offsets_at + 4 * std::size_t{number + 1});
  if (block.u32(tables.offsets_at + 4 * std::size_t{number}) != at || end > size || end < at ||
      end - at < kFeatureHeaderBytes) {
    return Refusal::kWrongOffsets;
  }
  const Words feature(block.bytes().subspan(at, end - at));
  at = end;
  return check_feature(feature, tables.extent);
}

// Whether a bucket lists only features that overlap it, each once, in the order of their numbers.
bool is_bucket(const Words& block, const Tables& tables, std::uint32_t bucket) {
  const std::size_t at = tables.starts_at + 4 * std::size_t{bucket};
  const std::uint32_t row = bucket / tables.buckets.columns();
  const std::uint32_t column = bucket - row * tables.buckets.columns();
  std::uint32_t least = 0;
  for (std::uint32_t entry = block.u32(at); entry < block.u32(at + 4); ++entry) {
    const std::uint32_t number = block.u32(tables.entries_at + 4 * std::size_t{entry});
    if (number < least || number >= tables.features) {
      return false;
    }
    const std::uint32_t offset = block.u32(tables.offsets_at + 4 * std::size_t{number});
    if (!Buckets::of(block.box(offset + 8), tables.extent).holds(column, row)) {
      return false;
    }
    least = number + 1;
  }
  return true;
}

// The number of entries of a bucket; empty if they are outside the table.
std::optional<std::uint32_t> entries_of_bucket(const Words& block, const Tables& tables,
                                               std::uint32_t bucket) {
  const std::size_t at = tables.starts_at + 4 * std::size_t{bucket};
  const std::uint32_t begin = block.u32(at);
  const std::uint32_t end = block.u32(at + 4);
  const bool is_first = bucket == 0;
  if (begin > end || end > block.u32(tables.entries_at - 4) || (is_first && begin != 0)) {
    return std::nullopt;
  }
  return end - begin;
}

// The number of buckets that a feature overlaps.
std::uint32_t buckets_met(const Words& block, const Tables& tables, std::uint32_t number) {
  const std::uint32_t offset = block.u32(tables.offsets_at + 4 * std::size_t{number});
  return Buckets::of(block.box(offset + 8), tables.extent).count();
}

}  // namespace

Refusal check(std::span<const std::uint8_t> bytes) {
  Check check(bytes);
  while (!check.advance(kMaxBlockBytes)) {
  }
  return check.verdict();
}

Check::Check(std::span<const std::uint8_t> bytes) : bytes_{bytes} {
  end_stage(check_envelope(Words(std::as_bytes(bytes))), Stage::kCrc);
}

void Check::end_stage(Refusal refusal, Stage next) {
  verdict_ = refusal;
  stage_ = refusal == Refusal::kNone ? next : Stage::kEnded;
  number_ = 0;
}

bool Check::advance(std::size_t budget) {
  while (budget > 0 && stage_ != Stage::kEnded) {
    budget -= std::min(budget, step(budget));
  }
  return stage_ == Stage::kEnded;
}

// Returns the cost of the step, at least 1.
std::size_t Check::step(std::size_t budget) {
  switch (stage_) {
    case Stage::kCrc:
      return check_crc(budget);
    case Stage::kFeatures:
      return check_next_of_features();
    case Stage::kIndex:
      return check_next_of_buckets();
    case Stage::kMeetings:
      return count_next_meetings();
    case Stage::kEnded:
      break;
  }
  return budget;
}

std::size_t Check::check_crc(std::size_t budget) {
  const Words block(std::as_bytes(bytes_));
  if (at_ == 0) {
    crc_.update(block.bytes().first(kCrcAt));
    at_ = kCrcAt + 4;
  }
  const auto piece = block.bytes().subspan(at_, std::min(budget, bytes_.size() - at_));
  crc_.update(piece);
  at_ += piece.size();
  if (at_ == bytes_.size()) {
    Refusal refusal = crc_.value() == block.u32(kCrcAt) ? check_header(block) : Refusal::kDamaged;
    if (refusal == Refusal::kNone) {
      tables_ = tables_of(block);
      at_ = tables_.features_at;
      refusal = at_ > bytes_.size() ? Refusal::kWrongCounts : Refusal::kNone;
    }
    end_stage(refusal, Stage::kFeatures);
  }
  return piece.size() + 1;
}

std::size_t Check::check_next_of_features() {
  const Words block(std::as_bytes(bytes_));
  if (number_ == tables_.features) {
    end_stage(at_ == bytes_.size() ? Refusal::kNone : Refusal::kWrongOffsets, Stage::kIndex);
    return 1;
  }
  const std::size_t begin = at_;
  const Refusal refusal = check_next_feature(block, tables_, number_, at_);
  ++number_;
  if (refusal != Refusal::kNone) {
    end_stage(refusal, Stage::kEnded);
  }
  return at_ - begin + 1;
}

// Each bucket lists only features that overlap it, none twice. So no entry is missing if there are
// as many entries as overlaps of features and buckets. There are at most 2^20 entries. The sum over
// the features has no such bound, so it is counted in 64 bits.
std::size_t Check::check_next_of_buckets() {
  const Words block(std::as_bytes(bytes_));
  if (number_ == tables_.buckets.count()) {
    end_stage(Refusal::kNone, Stage::kMeetings);
    return 1;
  }
  const std::optional<std::uint32_t> entries = entries_of_bucket(block, tables_, number_);
  if (!entries || !is_bucket(block, tables_, number_)) {
    end_stage(Refusal::kWrongIndex, Stage::kEnded);
    return 1;
  }
  ++number_;
  return kEntryCost * (std::size_t{*entries} + 1);
}

std::size_t Check::count_next_meetings() {
  const Words block(std::as_bytes(bytes_));
  if (number_ == tables_.features) {
    const bool is_whole = meetings_ == block.u32(tables_.entries_at - 4);
    end_stage(is_whole ? Refusal::kNone : Refusal::kWrongIndex, Stage::kEnded);
    return 1;
  }
  meetings_ += buckets_met(block, tables_, number_);
  ++number_;
  return kEntryCost;
}

Block::Block(std::span<const std::uint8_t> checked)
    : words_(std::as_bytes(checked)), tables_(tables_of(words_)) {}

std::string_view Block::attribution() const {
  const auto text = words_.bytes().subspan(kHeaderBytes, attribution_bytes(words_));
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}

}  // namespace iog::map
