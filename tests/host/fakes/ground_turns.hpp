// Turns of a sensor for tests of the ground: returns by sector, distance and height.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fakes/random.hpp"

namespace iog::tests {

struct Return {
  std::int32_t sector = 0;
  std::int32_t along_mm = 0;
  std::int32_t z_mm = 0;
};
using Turn = std::vector<Return>;

inline constexpr std::int32_t kTestSectors = 256;
inline constexpr std::int32_t kTestBins = 64;

// Ground that rises and falls, with noise; things on it, some of which hide it; holes and mirror
// images; sectors and bins without returns.
inline Turn rough_turn(Random& random, std::int32_t bin_mm) {
  Turn turn;
  const std::int32_t slope = random.between(-170, 170) * bin_mm / 1024;
  const std::int32_t across = random.between(-40, 40);
  const std::int32_t noise = random.between(1, 120);
  const int one_empty_in = random.between(2, 30);
  const int one_thing_in = random.between(4, 60);
  std::vector<std::int32_t> height(kTestSectors, 0);
  for (std::int32_t bin = 0; bin < kTestBins; ++bin) {
    const std::int32_t kerb = random.one_in(12) ? random.between(-300, 300) : 0;
    for (std::int32_t sector = 0; sector < kTestSectors; ++sector) {
      std::int32_t& its = height[static_cast<std::size_t>(sector)];
      const std::int32_t half = sector < 128 ? sector : 256 - sector;
      its += slope + across * (half - 64) / 64 + (half < 90 ? kerb : 0);
      if (random.one_in(one_empty_in)) {
        continue;
      }
      std::int32_t z = its + random.between(-noise, noise);
      if (random.one_in(one_thing_in)) {
        z += random.one_in(5) ? -random.between(100, 3000) : random.between(50, 3000);
      }
      const std::int32_t along = bin * bin_mm + random.between(0, bin_mm - 1);
      for (int echo = random.between(1, 3); echo > 0; --echo) {
        turn.push_back({sector, along, z + (echo - 1) * random.between(0, 2000)});
      }
    }
  }
  return turn;
}

// Whatever a packet can say: any distance, any height.
inline Turn any_turn(Random& random, int returns) {
  Turn turn;
  for (int i = 0; i < returns; ++i) {
    const std::int32_t most = random.one_in(2) ? 70'000 : (1 << 20) - 1;
    const std::int32_t high = random.one_in(2) ? 500 : (1 << 20);
    turn.push_back({random.between(0, 255), random.between(0, most), random.between(-high, high)});
  }
  return turn;
}

// Flat sectors far from one another, whose ground goes on after some bins just as high as it can,
// or a millimetre higher, or just as low as anybody believes. `bin_mm` decides how high that is.
inline Turn turn_at_limits(Random& random, std::int32_t bin_mm) {
  Turn turn;
  const auto of_bin = [&](std::int32_t rise) { return rise * bin_mm / 1024; };
  for (std::int32_t sector = 0; sector < kTestSectors; sector += 19) {
    const std::int32_t first = random.between(0, 63);
    const std::int32_t over = random.between(0, 1);
    if (random.one_in(3)) {
      turn.push_back({sector, first * bin_mm, 150 + of_bin(20) * (first + 1) + over});
      continue;
    }
    if (random.one_in(2)) {
      const std::int32_t believed = std::min<std::int32_t>(300 + of_bin(225) * (first + 1), 14'000);
      turn.push_back({sector, first * bin_mm, -believed - over});
      continue;
    }
    const std::int32_t gap = random.between(1, 5);
    for (std::int32_t bin = 0; bin <= first; ++bin) {
      turn.push_back({sector, bin * bin_mm, 0});
    }
    turn.push_back({sector, (first + gap) * bin_mm,
                    std::min<std::int32_t>(100 + of_bin(100) * gap, 300) + over});
  }
  return turn;
}

// A stair of a few sectors, whose steps are just as high as they can be; beside it, up to ten
// sectors away, one that is too high for itself, or has nothing.
inline Turn turn_beside(Random& random, std::int32_t bin_mm) {
  Turn turn;
  const std::int32_t side = random.between(1, 10) * (random.one_in(2) ? 1 : -1);
  const std::int32_t bins = random.between(2, 12);
  const std::int32_t rise = random.between(20, 200);
  const std::int32_t off = random.between(0, 1);
  for (std::int32_t bin = 0; bin <= bins; ++bin) {
    for (const std::int32_t sector : {64, 65, 66}) {
      turn.push_back({sector, bin * bin_mm, rise * bin});
    }
    if (bin < bins - 1) {
      turn.push_back({65 + side, bin * bin_mm, 0});
    }
  }
  const std::int32_t end = bins * bin_mm;
  if (random.one_in(2)) {
    turn.push_back({65 + side, end, rise * bins + 60 + off});
  } else if (random.one_in(2)) {
    turn.push_back({64, end, 0});  // the surface is kept low over it
  }
  return turn;
}

// First ground in bin 3 that is just doubtful or just not, and then the highest step that is
// allowed after a doubtful one, or a millimetre less or more.
inline Turn doubtful_ground(std::int32_t bin_mm) {
  Turn returns;
  for (std::int32_t i = 0; i < 16; ++i) {
    const std::int32_t first = 59 + i / 4;
    const std::int32_t expected = first + 4 * (first / 16);
    for (const std::int32_t beside : {-1, 0, 1}) {
      const std::int32_t sector = 8 + 16 * i + beside;
      returns.push_back({sector, 3 * bin_mm, first});
      returns.push_back({sector, 7 * bin_mm, expected + 199 + i % 4});
    }
  }
  return returns;
}

// Level sectors with mirror images just as deep below one side or both as they must be to be none,
// or a millimetre less deep, and as wide as they can be, or wider.
inline Turn mirror_images(std::int32_t bin_mm) {
  Turn returns;
  for (std::int32_t i = 0; i < 16; ++i) {
    const std::int32_t bin = 10 + i;
    const std::int32_t first = 8 + 16 * i;
    for (std::int32_t sector = first - 4; sector < first + 8; ++sector) {
      const bool is_image = sector >= first && sector < first + 1 + i / 4;
      returns.push_back({sector, bin * bin_mm,
                         is_image         ? -1'000 - i % 2
                         : sector < first ? i % 4 / 2
                                          : 0});
      returns.push_back({sector, (bin - 1) * bin_mm, 0});
    }
  }
  return returns;
}

// Two turns. In the first, the ground rises to one side by a millimetre a sector. In the second,
// some sectors have a first ground as high over it as it may be, or a millimetre higher.
inline Turn ground_apart(std::int32_t bin_mm, int turn) {
  Turn returns;
  for (std::int32_t sector = 0; sector < kTestSectors; ++sector) {
    const std::int32_t height = std::min(sector, 256 - sector) - 20;
    for (std::int32_t bin = turn == 0 ? 8 : 12; bin < 14; ++bin) {
      returns.push_back({sector, bin * bin_mm, height + (turn == 0 ? 0 : 145 + sector / 8 % 12)});
    }
  }
  return returns;
}

// Two turns. In the first, sectors far from one another have ground as high as a first ground can
// be, or higher. In the second, they have it just as much higher as it may be from turn to turn, or
// a millimetre more, or just as high as it can ever be.
inline Turn first_ground(std::int32_t bin_mm, int turn) {
  Turn returns;
  const auto most = [&](std::int32_t bin, std::int32_t rise) {
    return 150 + rise * bin_mm / 1024 * (bin + 1);
  };
  for (std::int32_t i = 0; i < 12; ++i) {
    const std::int32_t bin = 5 + i;
    const std::int32_t begin = most(bin, 20);
    // Alone, the ground of a bin rises evenly from 0 before the first bin; sectors beside it are 0.
    for (const std::int32_t beside : {-1, 0, 1}) {
      const std::int32_t sector = 10 + 20 * i + beside;
      const std::int32_t end = std::min(begin - begin / (bin + 1) / 4 + 58 + i % 6, most(bin, 80));
      returns.push_back({sector, bin * bin_mm, turn == 0 ? begin : end});
      returns.push_back({sector, (bin + 1) * bin_mm, turn == 0 ? begin : end});
    }
  }
  // Where all bins showed a ramp, only one does, as high as the first ground can ever be.
  for (std::int32_t i = 0; i < 6; ++i) {
    const std::int32_t end = 6 + i / 2;
    for (std::int32_t bin = turn == 0 ? 0 : end; bin <= end + 1 - turn; ++bin) {
      for (const std::int32_t beside : {-1, 0, 1}) {
        const std::int32_t ramp = 110 * bin_mm / 1024 * (bin + 1);
        returns.push_back(
            {20 * i + 20 + beside, bin * bin_mm, turn == 0 ? ramp : most(end, 80) + i % 2});
      }
    }
  }
  return returns;
}

// Every bin as much higher, or lower, than the one before, which is more than a slope can be.
inline Turn steep_turn(Random& random, std::int32_t bin_mm) {
  const std::int32_t rise = random.between(181, 195) * (random.one_in(2) ? 1 : -1) * bin_mm / 1024;
  Turn turn;
  for (std::int32_t sector = 0; sector < kTestSectors; ++sector) {
    for (std::int32_t bin = 0; bin < 40; ++bin) {
      turn.push_back({sector, bin * bin_mm, rise * bin});
    }
  }
  return turn;
}

}  // namespace iog::tests
