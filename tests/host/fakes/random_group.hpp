// Groups of cells, valid ones and at the edges of what is valid.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "evidence/assignment.hpp"
#include "fakes/group.hpp"
#include "fakes/random.hpp"

namespace iog::tests {

// 0 ... 32767, with every third value near an end.
inline std::int16_t random_mass(Random& random) {
  const std::uint64_t bits = random.next();
  const auto mass = static_cast<std::int16_t>(bits & 0x7FFF);
  const auto near_end = static_cast<std::int16_t>(bits >> 16 & 3);
  switch (bits >> 32 & 7) {
    case 0:
      return near_end;
    case 1:
      return static_cast<std::int16_t>(evidence::kCertain - near_end);
    default:
      return mass;
  }
}

// Four masses and ignorance are what lies between four cuts of 0 ... 32767.
inline void make_random_cell(Random& random, evidence::Group& group, std::size_t i) {
  std::array<std::int16_t, 4> cuts{};
  for (std::int16_t& cut : cuts) {
    cut = random_mass(random);
  }
  std::sort(cuts.begin(), cuts.end());
  const std::size_t first = random.below(4);
  const std::array<evidence::Masses*, 4> planes{&group.free, &group.occupied, &group.moving,
                                                &group.standing};
  for (std::size_t j = 0; j < 4; ++j) {
    const auto below = static_cast<std::int16_t>(j == 0 ? 0 : cuts[j - 1]);
    (*planes[(first + j) % 4])[i] = static_cast<std::int16_t>(cuts[j] - below);
  }
  group.persistence[i] = random_mass(random);
}

// What a map rules out in the cells of a group.
inline std::array<std::uint8_t, evidence::kGroupCells> random_masks(Random& random) {
  std::array<std::uint8_t, evidence::kGroupCells> masks{};
  for (std::uint8_t& mask : masks) {
    mask = static_cast<std::uint8_t>(random.next() & 7);
  }
  return masks;
}

inline evidence::Group random_group(Random& random) {
  evidence::Group group;
  for (std::size_t i = 0; i < evidence::kGroupCells; ++i) {
    make_random_cell(random, group, i);
  }
  return group;
}

// -127 ... 127, every third 0.
inline evidence::Indexes random_indexes(Random& random) {
  evidence::Indexes indexes{};
  for (auto& index : indexes) {
    const std::uint64_t bits = random.next();
    const auto value = static_cast<std::int8_t>(bits & 0xFF);
    index = bits >> 32 & 3 && value != -128 ? value : std::int8_t{0};
  }
  return indexes;
}

}  // namespace iog::tests
