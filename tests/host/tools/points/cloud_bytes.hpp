// Clouds byte by byte, and what is told of wrong ones.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "tools/clouds/cloud_fields.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {

using Bytes = std::vector<std::byte>;

inline void add(Bytes& bytes, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) {
    bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
  }
}
inline void add(Bytes& bytes, float value) { add(bytes, std::bit_cast<std::uint32_t>(value), 4); }
inline void add(Bytes& bytes, double value) { add(bytes, std::bit_cast<std::uint64_t>(value), 8); }

inline std::string told_by(const std::function<void()>& act) {
  try {
    act();
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

// Two points: 10 m to the left and 1 m ahead, 45 degrees up.
inline void expect_two(const SeenCloud& cloud) {
  ASSERT_EQ(cloud.points.size(), 2U);
  EXPECT_EQ(cloud.points[0].first, 288'000);
  EXPECT_EQ(cloud.points[0].second, 0);
  EXPECT_EQ(cloud.points[0].third, 10'000);
  EXPECT_EQ(cloud.points[1].first, 0);
  EXPECT_EQ(cloud.points[1].second, 45 * 3'200);
  EXPECT_EQ(cloud.points[1].third, 1'414);
}

}  // namespace iog::tools
