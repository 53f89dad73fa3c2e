// Whether memory that must not change is what it was: read again and again in small slices, each
// round of which compares the CRC-32 of every region.
//
// A slice is 1,408 bytes, a block of checksum/crc32.hpp. Slices are spread evenly over a round, so
// that the share of a core is that of the bytes, whatever the loop does; a loop that comes late
// makes up for it, a bounded number of slices at a time.
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
  // A round of a loop that keeps up; longer if a slice would be due more than once a millisecond.
  // At 4 cycles a byte, every one from DDR, that is 0.7 % of a core of 792 MHz.
  static constexpr std::uint64_t kRoundUs = 2'000'000;
  static constexpr std::uint64_t kLeastIntervalUs = 1000;
  // Of one step: 45 KB, a quarter of a millisecond at 4 cycles a byte and 792 MHz.
  static constexpr std::size_t kMostSlices = 32;

  // The regions and their bytes outlive the check; there may be none.
  explicit MemoryCheck(std::span<const Region> regions);

  // All of it at once: the number of the first region that is not what it was.
  [[nodiscard]] std::optional<std::size_t> look_at_all() const;

  // In the background: what is due by now. The same of the region that a slice has completed, if
  // its CRC is another. The first call only begins.
  [[nodiscard]] std::optional<std::size_t> step(std::uint64_t now_us);

  // Modulo 2^32: how often every region has been read to its end.
  [[nodiscard]] std::uint32_t rounds() const { return rounds_; }

  [[nodiscard]] std::span<const Region> regions() const { return regions_; }
  [[nodiscard]] std::size_t slices() const { return slices_; }

 private:
  // Whether the region that it ends is what it was; a slice that ends none says so, too.
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
