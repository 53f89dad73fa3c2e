// A map block contains buildings and roads as polygons, and a spatial index that consists of
// buckets. `docs/spec.md`, section 6, describes each byte.
//
// A block is untrusted until check() has accepted the entire block. A Block then reads its bytes
// without further checks. The bytes must not change after check().
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "checksum/crc32.hpp"
#include "map/buckets.hpp"
#include "map/feature.hpp"
#include "map/origin.hpp"
#include "map/plane.hpp"
#include "map/words.hpp"

namespace iog::map {

inline constexpr std::size_t kMaxBlockBytes = std::size_t{4} << 20;
inline constexpr std::uint32_t kMaxAttributionBytes = 1'024;
inline constexpr std::uint32_t kMaxAccuracyMm = 65'535;

enum class Source : std::uint8_t { kOpenStreetMap = 1, kSurveyed = 2 };

// The reason why a block is rejected. The values are defined in docs/spec.md, section 6.4.
enum class Refusal : std::uint8_t {
  kNone,             // the whole block is valid
  kTooShort,         // shorter than a header
  kTooLong,          // longer than kMaxBlockBytes
  kNotABlock,        // wrong magic number
  kWrongVersion,     // unsupported version
  kWrongLength,      // the stated length differs from the actual one
  kDamaged,          // wrong CRC
  kNotZero,          // a field that must be zero is not
  kWrongSource,      // unknown source, or a confidence of 0
  kWrongOrigin,      // impossible latitude or longitude
  kWrongExtent,      // empty, or beyond kMaxCoordinateCm
  kWrongAccuracy,    // 0, or above kMaxAccuracyMm
  kWrongText,        // attribution missing, too long, or with control characters
  kWrongCounts,      // tables that do not fit into the block
  kWrongOffsets,     // features that are not contiguous up to the end of the block
  kWrongKind,        // a feature that is neither a building nor a road
  kTooManyVertices,  // a feature with more than kMaxFeatureVertices
  kWrongRing,        // a ring of fewer than three vertices, or rings that do not fill their feature
  kWrongBox,         // a box that does not match the vertices
  kOutside,          // a feature that extends beyond the extent
  kWrongIndex,       // a feature that is not in exactly the buckets that its box overlaps
};
inline constexpr std::size_t kRefusalCount = 21;

[[nodiscard]] Refusal check(std::span<const std::uint8_t> bytes);

// The tables of a block. Offsets are relative to the block's first byte.
struct Tables {
  BoxCm extent;                 // of the block
  Buckets buckets;              // of the whole extent
  std::uint32_t features = 0;   // number of features
  std::size_t starts_at = 0;    // of the entries of each bucket, plus one for the end
  std::size_t entries_at = 0;   // of the feature numbers
  std::size_t offsets_at = 0;   // of the feature offsets
  std::size_t features_at = 0;  // of the first feature
};

// Runs check() in steps, for callers that cannot check an entire block at once.
class Check {
 public:
  // The bytes must outlive this object and must not change while the check runs.
  explicit Check(std::span<const std::uint8_t> bytes);

  // Continues the check until it has processed about `budget` bytes. Features and buckets are not
  // split, so a single feature or bucket may exceed the budget. Returns true when the check is
  // complete.
  bool advance(std::size_t budget);

  // The result is valid after the check is complete.
  [[nodiscard]] Refusal verdict() const { return verdict_; }

 private:
  enum class Stage : std::uint8_t { kCrc, kFeatures, kIndex, kMeetings, kEnded };
  static constexpr std::size_t kEntryCost = 16;  // equivalent number of feature bytes

  void end_stage(Refusal refusal, Stage next);
  std::size_t step(std::size_t budget);
  std::size_t check_crc(std::size_t budget);
  std::size_t check_next_of_features();
  std::size_t check_next_of_buckets();
  std::size_t count_next_meetings();

  std::span<const std::uint8_t> bytes_;
  Stage stage_ = Stage::kEnded;
  Refusal verdict_ = Refusal::kNone;
  checksum::Crc32 crc_;
  std::size_t at_ = 0;          // first unchecked byte
  std::uint32_t number_ = 0;    // first unchecked feature or bucket
  std::uint64_t meetings_ = 0;  // overlaps of features and buckets
  Tables tables_;               // valid after the header was checked
};

// The layout of a block. Offsets are relative to the block's first byte.
inline constexpr std::size_t kHeaderBytes = 64;
inline constexpr std::uint32_t kMagic = 0x494F474D;  // "IOGM"
inline constexpr std::uint16_t kVersion = 1;

// Reads a block that check() has accepted.
class Block {
 public:
  explicit Block(std::span<const std::uint8_t> checked);

  [[nodiscard]] std::int64_t latitude() const { return words_.i64(16); }   // 1e-9 degrees
  [[nodiscard]] std::int64_t longitude() const { return words_.i64(24); }  // 1e-9 degrees
  [[nodiscard]] std::uint64_t origin() const { return origin_name(latitude(), longitude()); }
  [[nodiscard]] const BoxCm& extent() const { return tables_.extent; }
  [[nodiscard]] Source source() const { return static_cast<Source>(words_.u8(6)); }
  [[nodiscard]] std::uint8_t belief() const { return words_.u8(7); }  // of 256
  // Returns the date in seconds since 1970 (UTC), or 0 if the date is unknown.
  [[nodiscard]] std::uint32_t date_s() const { return words_.u32(48); }
  // Returns the map's accuracy. On average, 95 of 100 vertices lie within this distance of their
  // true positions.
  [[nodiscard]] std::uint32_t accuracy_mm() const { return words_.u32(52); }
  [[nodiscard]] std::uint32_t crc() const { return words_.u32(12); }  // identifies the map
  [[nodiscard]] std::uint32_t size_bytes() const { return words_.u32(8); }
  [[nodiscard]] std::uint32_t feature_count() const { return tables_.features; }
  [[nodiscard]] std::string_view attribution() const;  // UTF-8

  // `number` must be below feature_count().
  [[nodiscard]] Feature feature(std::uint32_t number) const {
    return Feature(
        words_.bytes().subspan(words_.u32(tables_.offsets_at + 4 * std::size_t{number})));
  }

  // Calls visit(const Feature&) once for each feature whose box overlaps the given box. Visits the
  // buckets row by row, and the features of each bucket in ascending order of their numbers.
  template <typename Visit>
  void for_each_feature_in(const BoxCm& box, Visit&& visit) const;

  // These functions access the index. `entries_of()` returns the entries of a bucket, and
  // feature_of_entry() returns the feature that an entry refers to.
  struct Entries {
    std::uint32_t next = 0;
    std::uint32_t end = 0;
  };
  [[nodiscard]] Entries entries_of(std::uint32_t column, std::uint32_t row) const {
    const std::size_t at =
        tables_.starts_at + 4 * (std::size_t{row} * tables_.buckets.columns() + column);
    return {words_.u32(at), words_.u32(at + 4)};
  }
  [[nodiscard]] Feature feature_of_entry(std::uint32_t entry) const {
    return feature(words_.u32(tables_.entries_at + 4 * std::size_t{entry}));
  }

  // The bytes of the block.
  [[nodiscard]] const std::byte* data() const { return words_.bytes().data(); }

 private:
  Words words_;
  Tables tables_;
};

// Iterates over the features of a block whose boxes overlap a given box. The iteration visits one
// index entry at a time, so it can be suspended. The bytes of the block must outlive this object.
class FeatureWalk {
 public:
  FeatureWalk(const Block& block, const BoxCm& box) : block_(block), box_(box) {
    if (box.meets(block.extent())) {
      asked_ = Buckets::of(box, block.extent());
      column_ = asked_.first_column;
      row_ = asked_.first_row;
      entries_ = block.entries_of(column_, row_);
      is_over_ = false;
    }
  }

  [[nodiscard]] bool is_over() const { return is_over_; }

  // Examines one entry. If the current bucket has no more entries, moves on to the next bucket
  // instead. A feature is listed in every bucket that its box overlaps, but it is returned only
  // once, when the first of these buckets is visited. Do not call this function if is_over()
  // returns true.
  [[nodiscard]] std::optional<Feature> look() {
    if (entries_.next == entries_.end) {
      leave_bucket();
      return std::nullopt;
    }
    const Feature found = block_.feature_of_entry(entries_.next++);
    const BoxCm around = found.box();
    if (!around.meets(box_)) {
      return std::nullopt;
    }
    const Buckets own = Buckets::of(around, block_.extent());
    const bool is_first = column_ == std::max(own.first_column, asked_.first_column) &&
                          row_ == std::max(own.first_row, asked_.first_row);
    return is_first ? std::optional(found) : std::nullopt;
  }

 private:
  void leave_bucket() {
    const bool is_last_of_row = column_ == asked_.last_column;
    is_over_ = is_last_of_row && row_ == asked_.last_row;
    if (!is_over_) {
      column_ = is_last_of_row ? asked_.first_column : column_ + 1;
      row_ += is_last_of_row ? 1 : 0;
      entries_ = block_.entries_of(column_, row_);
    }
  }

  Block block_;
  BoxCm box_;
  Buckets asked_{};
  Block::Entries entries_{};
  std::uint32_t column_ = 0;
  std::uint32_t row_ = 0;
  bool is_over_ = true;
};

template <typename Visit>
void Block::for_each_feature_in(const BoxCm& box, Visit&& visit) const {
  for (FeatureWalk walk(*this, box); !walk.is_over();) {
    if (const std::optional<Feature> found = walk.look()) {
      visit(*found);
    }
  }
}

}  // namespace iog::map
