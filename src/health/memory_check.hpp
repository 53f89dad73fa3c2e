// Checks that constant memory has not changed. The check reads the memory cyclically in small
// slices. Once per round, it compares each region's CRC-32 with the stored value.
//
// A slice is one CRC block of 1,408 bytes (checksum/crc32.hpp). Slices are spread evenly over a
// round. The load therefore depends on the number of bytes, not on the loop period. If the loop is
// late, a call checks several slices, up to kMostSlices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "checksum/crc32.hpp"

namespace iog::health {

struct Region {
  std::string_view name;
  std::span<const std::byte> bytes;
  std::uint32_t crc = 0;
};

[[nodiscard]] std::uint32_t crc_of(std::span<const std::byte> bytes);

class MemoryCheck {
 public:
  static constexpr std::size_t kSliceBytes = 1408;
  // The duration of a round if the loop runs on time. At most one slice is due per millisecond, so
  // a round with many slices takes longer. If all bytes are read from DDR and each byte takes 4
  // cycles, the load is 0.7 % of a 792 MHz core.
  static constexpr std::uint64_t kRoundUs = 2'000'000;
  static constexpr std::uint64_t kLeastIntervalUs = 1000;
  // The maximum number of slices per step. Checking the maximum number of slices (45 KB) takes a
  // quarter of a millisecond at 4 cycles per byte and 792 MHz.
  static constexpr std::size_t kMostSlices = 32;

  // The regions and their bytes must outlive the check. `regions` may be empty.
  explicit MemoryCheck(std::span<const Region> regions);

  // Checks all regions at once. Returns the index of the first changed region, if any.
  [[nodiscard]] std::optional<std::size_t> look_at_all() const;

  // Checks the slices that are due. Returns the index of a region if its last slice was checked and
  // the region has changed. The first call only sets the start time.
  [[nodiscard]] std::optional<std::size_t> step(std::uint64_t now_us);

  // Returns the number of complete rounds, modulo 2^32.
  [[nodiscard]] std::uint32_t rounds() const { return rounds_; }

  [[nodiscard]] std::span<const Region> regions() const { return regions_; }
  [[nodiscard]] std::size_t slices() const { return slices_; }

 private:
  // Returns false if the slice is the last one of a changed region.
  bool look_at_next_slice();

  std::span<const Region> regions_;
  std::size_t slices_ = 0;
  std::uint64_t interval_us_ = 0;
  std::optional<std::uint64_t> next_us_;
  std::size_t region_ = 0;
  std::size_t offset_ = 0;
  checksum::Crc32 crc_;
  std::uint32_t rounds_ = 0;
};

}  // namespace iog::health
