// A map as it comes to the target: buildings and roads as polygons, found by buckets. Byte by byte
// in docs/spec.md, section 6.
//
// Nothing of a block is believed before check() has passed it whole. What a Block reads afterwards
// needs no further test, as long as the bytes stay as they are.
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

// Why a block is not taken. The values are those of docs/spec.md, section 6.4.
enum class Refusal : std::uint8_t {
  kNone,             // the whole block is sound
  kTooShort,         // shorter than a header
  kTooLong,          // longer than kMaxBlockBytes
  kNotABlock,        // another magic number
  kWrongVersion,     // another version
  kWrongLength,      // not as long as it says
  kDamaged,          // wrong CRC
  kNotZero,          // something that has to be zero is not
  kWrongSource,      // no such source, or a belief of 0
  kWrongOrigin,      // no such latitude or longitude
  kWrongExtent,      // empty, or beyond kMaxCoordinateCm
  kWrongAccuracy,    // 0, or above kMaxAccuracyMm
  kWrongText,        // an attribution that is missing, too long, or controls a terminal
  kWrongCounts,      // tables that do not fit in the block
  kWrongOffsets,     // features that do not lie end to end, or not to the block's end
  kWrongKind,        // a feature that is no building and no road
  kTooManyVertices,  // a feature of more than kMaxFeatureVertices
  kWrongRing,        // a ring under three vertices, or rings that do not fill their feature
  kWrongBox,         // a box that is not that of the feature's vertices
  kOutside,          // a feature that reaches beyond the extent
  kWrongIndex,       // a feature that is not in exactly the buckets that its box meets
};
inline constexpr std::size_t kRefusalCount = 21;

[[nodiscard]] Refusal check(std::span<const std::uint8_t> bytes);

// Where a block's tables are, counted from its first byte.
struct Tables {
  BoxCm extent;                 // of the block
  Buckets buckets;              // of all of it
  std::uint32_t features = 0;   // their number
  std::size_t starts_at = 0;    // of each bucket's entries, one more for the end
  std::size_t entries_at = 0;   // numbers of features
  std::size_t offsets_at = 0;   // of the features
  std::size_t features_at = 0;  // the first one
};

// The same in pieces, where there is no time for all of it at once.
class Check {
 public:
  // The bytes outlive the check, and do not change meanwhile.
  explicit Check(std::span<const std::uint8_t> bytes);

  // Goes on for what about so many bytes cost. A feature and a bucket are not divided: one of
  // them may be more than the budget. Whether the check has ended.
  bool advance(std::size_t budget);

  // Once it has ended.
  [[nodiscard]] Refusal verdict() const { return verdict_; }

 private:
  enum class Stage : std::uint8_t { kCrc, kFeatures, kIndex, kMeetings, kEnded };
  static constexpr std::size_t kEntryCost = 16;  // in bytes of features

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
  std::size_t at_ = 0;          // the first byte that is not checked yet
  std::uint32_t number_ = 0;    // the first feature or bucket
  std::uint64_t meetings_ = 0;  // of features and buckets
  Tables tables_;               // once the header is sound
};

// Where in a block is what. Offsets are from its first byte.
inline constexpr std::size_t kHeaderBytes = 64;
inline constexpr std::uint32_t kMagic = 0x494F474D;  // "IOGM"
inline constexpr std::uint16_t kVersion = 1;

// A block that check() has passed.
class Block {
 public:
  explicit Block(std::span<const std::uint8_t> checked);

  [[nodiscard]] std::int64_t latitude() const { return words_.i64(16); }   // 1e-9 degrees
  [[nodiscard]] std::int64_t longitude() const { return words_.i64(24); }  // 1e-9 degrees
  [[nodiscard]] std::uint64_t origin() const { return origin_name(latitude(), longitude()); }
  [[nodiscard]] const BoxCm& extent() const { return tables_.extent; }
  [[nodiscard]] Source source() const { return static_cast<Source>(words_.u8(6)); }
  [[nodiscard]] std::uint8_t belief() const { return words_.u8(7); }  // of 256
  // Seconds since 1970, UTC; 0 if unknown.
  [[nodiscard]] std::uint32_t date_s() const { return words_.u32(48); }
  // 95 of 100 vertices are less than this from where they belong.
  [[nodiscard]] std::uint32_t accuracy_mm() const { return words_.u32(52); }
  [[nodiscard]] std::uint32_t crc() const { return words_.u32(12); }  // names the map
  [[nodiscard]] std::uint32_t size_bytes() const { return words_.u32(8); }
  [[nodiscard]] std::uint32_t feature_count() const { return tables_.features; }
  [[nodiscard]] std::string_view attribution() const;  // UTF-8

  // By number, below feature_count().
  [[nodiscard]] Feature feature(std::uint32_t number) const {
    return Feature(
        words_.bytes().subspan(words_.u32(tables_.offsets_at + 4 * std::size_t{number})));
  }

  // visit(const Feature&) for each feature whose box meets this one, once; bucket by bucket, row by
  // row, by their numbers.
  template <typename Visit>
  void for_each_feature_in(const BoxCm& box, Visit&& visit) const;

  // The index: which entries a bucket has, first and behind the last, and the feature of one.
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

  // Where its bytes are.
  [[nodiscard]] const std::byte* data() const { return words_.bytes().data(); }

 private:
  Words words_;
  Tables tables_;
};

// Looks for the features of a block whose box meets another one, entry by entry of the index, so
// that it can be left and gone on with. The block's bytes outlive it.
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

  // Looks at one entry, or leaves a bucket. A feature stands in all buckets that its box meets; it
  // is found in the first of them that is asked for. Not once it is over.
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
