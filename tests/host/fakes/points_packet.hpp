// Builds datagrams of points byte by byte from the format's description (docs/spec.md, section
// 1.2.6), without any code of the decoder's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace iog::tests {

struct SentPoint {
  std::int64_t first = 0;  // azimuth in 3,200ths of a degree, or x in millimetres
  std::int64_t second = 0;
  std::int64_t third = 0;
  int after = 0;  // 10 us
  int flags = 0;
  int what = 0;
};

struct PointsPacket {
  std::uint32_t magic = 0x54504749;
  int version = 1;
  int flags = 0;
  std::uint32_t scan_number = 1;
  int number = 0;
  int datagrams = 1;
  std::uint64_t time_us = 1'700'000'000'000'000;
  std::uint32_t sector_begin = 0;
  std::uint32_t sector_width = 1'152'000;
  std::vector<SentPoint> points{};

  [[nodiscard]] std::vector<std::byte> bytes() const {
    std::vector<std::byte> out;
    const auto little = [&](std::uint64_t value, int size) {
      for (int i = 0; i < size; ++i) {
        out.push_back(static_cast<std::byte>(value >> (8 * i)));
      }
    };
    little(magic, 4);
    little(static_cast<std::uint64_t>(version), 1);
    little(static_cast<std::uint64_t>(flags), 1);
    little(points.size(), 2);
    little(scan_number, 4);
    little(static_cast<std::uint64_t>(number), 2);
    little(static_cast<std::uint64_t>(datagrams), 2);
    little(time_us, 8);
    little(sector_begin, 4);
    little(sector_width, 4);
    for (const SentPoint& point : points) {
      little(static_cast<std::uint64_t>(point.first), 4);
      little(static_cast<std::uint64_t>(point.second), 4);
      little(static_cast<std::uint64_t>(point.third), 4);
      little(static_cast<std::uint64_t>(point.after), 2);
      little(static_cast<std::uint64_t>(point.flags), 1);
      little(static_cast<std::uint64_t>(point.what), 1);
    }
    return out;
  }
};

}  // namespace iog::tests
