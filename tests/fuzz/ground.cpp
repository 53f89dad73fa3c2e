// The ground of a lidar, from any returns. The input is a series of turns, each of returns of six
// bytes: sector, distance in 16 mm, height in mm, what becomes of it. Laws: every height and every
// tilt is that of the second implementation; the surface is nowhere too far over what was seen; a
// turn read backwards is the same; what is forged lifts nothing over what is real.
#include <algorithm>
#include <memory>
#include <vector>

#include "fakes/reference_ground.hpp"
#include "fakes/reference_tilt.hpp"
#include "ground/bins.hpp"
#include "ground/lows.hpp"
#include "ground/surface.hpp"
#include "ground/surface_walk.hpp"
#include "ground/tilt.hpp"
#include "law.hpp"
#include "wire/byte_reader.hpp"

namespace iog::fuzz {
namespace {

using ground::Bins;
using ground::kSectors;
using ground::Lows;
using ground::Samples;
using ground::Surface;

struct Return {
  std::uint32_t sector;
  std::uint32_t along_mm;
  std::int32_t z_mm;
  bool is_forged;
};

std::vector<Return> returns_of(std::span<const std::byte> turn) {
  std::vector<Return> returns;
  for (wire::ByteReader in(turn); in.remaining() >= 6;) {
    const std::uint32_t sector = in.u8();
    const std::uint32_t along_mm = std::uint32_t{in.u16_be()} * 16;
    const auto z_mm = static_cast<std::int16_t>(in.u16_be());
    returns.push_back({sector, along_mm, z_mm, (in.u8() & 1U) != 0});
  }
  return returns;
}

// Keep: whether a return counts.
template <typename Keep>
Lows lows_of(Bins bins, const std::vector<Return>& turn, Keep&& keep) {
  Lows lows;
  for (const Return& its : turn) {
    if (keep(its)) {
      lows.add(bins, its.sector, its.along_mm, its.z_mm);
    }
  }
  return lows;
}

void check_low(Bins bins, const Lows& real, const Surface& surface) {
  for (std::size_t bin = 0; bin < ground::kBins; ++bin) {
    const std::int32_t most = bins.most_plausible_mm(static_cast<std::uint32_t>(bin));
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      const std::int32_t low = real.ring(bin)[sector];
      const Surface::Row& row = surface.row(sector);
      law(low > most || low < -ground::kMirroredMm ||
              std::max(row[bin], row[bin + 1]) <= low + ground::kMostOverLowestMm,
          "the ground is low over what is real");
    }
  }
}

class Ground {
 public:
  explicit Ground(Bins bins) : bins_(bins), reference_(bins.length_mm()) {}

  void turn(std::vector<Return> returns) {
    judge_packet(returns);
    const auto all = [](const Return& /*its*/) { return true; };
    const Lows lows = lows_of(bins_, returns, all);
    const Lows real = lows_of(bins_, returns, [](const Return& its) { return !its.is_forged; });
    for (const Return& its : returns) {
      reference_.see(its.sector, its.along_mm, its.z_mm);
    }
    std::ranges::reverse(returns);
    law(lows_of(bins_, returns, all) == lows, "no order shows");
    walk_.close_turn(bins_, lows, surface_);
    reference_.close_turn();
    check_low(bins_, real, surface_);
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      law(std::ranges::equal(surface_.row(sector), reference_.row(static_cast<int>(sector))),
          "a surface is the reference's");
      law(std::ranges::equal(surface_.lowest_near(sector),
                             reference_.lowest_near(static_cast<int>(sector))),
          "the lowest ground nearby is the reference's");
    }
  }

 private:
  // The returns of a turn as those of a packet.
  void judge_packet(const std::vector<Return>& returns) {
    Samples samples;
    std::vector<tests::ReferenceSample> expected_samples;
    for (const Return& its : returns) {
      const std::int32_t over = surface_.height_over(bins_, its.sector, its.along_mm, its.z_mm);
      law(over == reference_.height_over(its.sector, its.along_mm, its.z_mm),
          "a height is the reference's");
      law(surface_.height_over_near(bins_, its.sector, its.along_mm, its.z_mm) ==
              reference_.height_over_near(its.sector, its.along_mm, its.z_mm),
          "a height over the highest ground nearby is the reference's");
      if (expected_samples.size() < Samples::kMost && its.along_mm >= ground::kFirstSampleMm &&
          its.along_mm < ground::kEndOfSamplesMm) {
        samples.add(its.along_mm, over);
        expected_samples.push_back({its.along_mm, over});
      }
    }
    const ground::Tilt tilt = tilt_of(samples.all(), 12);
    const tests::ReferenceTilt expected = tests::ReferenceLine().of(expected_samples, 12);
    law(tilt.up_mm == expected.up_mm && tilt.slope == expected.slope, "a tilt is the reference's");
  }

  Bins bins_;
  ground::SurfaceWalk walk_;
  Surface surface_;
  tests::ReferenceGround reference_;
};

}  // namespace

void check(std::span<const std::byte> input) {
  wire::ByteReader in(input);
  const auto ground =
      std::make_unique<Ground>(ground::Bins((in.u8() & 1U) != 0 ? 120'000 : 50'000));
  for (int turns = 0; turns < 4 && in.remaining() > 0; ++turns) {
    ground->turn(returns_of(next_piece(in)));
  }
}

}  // namespace iog::fuzz
