// Builds Hesai data packets byte by byte from the formats' description (docs/spec.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lidar/formats.hpp"

namespace iog::tests {

inline constexpr std::array<lidar::Format, 7> kHesaiFormats{
    lidar::kFormat<lidar::HesaiPandar40p>, lidar::kFormat<lidar::HesaiPandar64>,
    lidar::kFormat<lidar::HesaiQt64>,      lidar::kFormat<lidar::HesaiQt128>,
    lidar::kFormat<lidar::HesaiXt16>,      lidar::kFormat<lidar::HesaiXt32>,
    lidar::kFormat<lidar::HesaiXt32m>};

struct HesaiPacket {
  lidar::Format format = lidar::kFormat<lidar::HesaiPandar64>;
  int first_azimuth = 0;  // 0.01 degrees, clockwise
  int step = 20;          // from block to block, in dual mode from pair to pair
  int mode = 0x37;
  bool is_dual = false;
  std::array<int, 6> utc{24, 2, 29, 23, 59, 59};  // the first as it is on the wire
  std::uint32_t time_us = 500'000;
  int rpm = 599;
  bool has_sequence = true;                       // of all but an XT; of a QT128 a signature
  std::array<std::array<int, 128>, 10> ranges{};  // 4 mm, of an XT-32M 5 mm

  // What the manuals say of a packet of the unit.
  struct Layout {
    enum class Tail { kOfPandar, kOfQt, kOfQt128, kOfXt } tail;
    int blocks;
    int lasers;
    std::vector<int> header;
    std::vector<int> flag;  // of each block
  };
  [[nodiscard]] Layout layout() const {
    if (format == lidar::kFormat<lidar::HesaiPandar40p>) {
      return {Layout::Tail::kOfPandar, 10, 40, {}, {0xFF, 0xEE}};
    }
    if (format == lidar::kFormat<lidar::HesaiPandar64>) {
      return {Layout::Tail::kOfPandar, 6, 64, {0xEE, 0xFF, 64, 6, 0, 4, 0, 0}, {}};
    }
    const int returns = is_dual ? 2 : 1;
    if (format == lidar::kFormat<lidar::HesaiQt64>) {
      const int flags = has_sequence ? 1 : 0;
      return {
          Layout::Tail::kOfQt, 4, 64, {0xEE, 0xFF, 3, 1, 0, 0, 64, 4, 1, 4, returns, flags}, {}};
    }
    if (format == lidar::kFormat<lidar::HesaiQt128>) {
      const int flags = has_sequence ? 0x1D : 0x15;
      return {Layout::Tail::kOfQt128,
              2,
              128,
              {0xEE, 0xFF, 3, 2, 3, 0, 128, 2, 1, 4, returns, flags},
              {}};
    }
    const bool is_xt32m = format == lidar::kFormat<lidar::HesaiXt32m>;
    const int lasers = format == lidar::kFormat<lidar::HesaiXt16> ? 16 : 32;
    const int blocks = is_xt32m ? 6 : 8;
    const int unit_mm = is_xt32m ? 5 : 4;
    return {Layout::Tail::kOfXt,
            blocks,
            lasers,
            {0xEE, 0xFF, 6, 1, 0, 0, lasers, blocks, 1, unit_mm, returns, 0},
            {}};
  }

  [[nodiscard]] std::vector<std::byte> bytes() const {
    std::vector<std::byte> out;
    const auto append = [&](const std::vector<int>& values) {
      for (const int value : values) {
        out.push_back(static_cast<std::byte>(value));
      }
    };
    const Layout unit = layout();
    append(unit.header);
    for (int block = 0; block < unit.blocks; ++block) {
      append(unit.flag);
      const int azimuth = (first_azimuth + (is_dual ? block / 2 : block) * step) % 36'000;
      append({azimuth & 0xFF, azimuth >> 8});
      for (int laser = 0; laser < unit.lasers; ++laser) {
        const int range = ranges[static_cast<std::size_t>(block)][static_cast<std::size_t>(laser)];
        append({range & 0xFF, range >> 8, 33});
        append(unit.tail == Layout::Tail::kOfPandar ? std::vector<int>{} : std::vector{255});
      }
    }
    const auto us = static_cast<int>(time_us);
    const std::vector<int> time{us & 0xFF, us >> 8 & 0xFF, us >> 16 & 0xFF, us >> 24 & 0xFF};
    const std::vector<int> date(utc.begin(), utc.end());
    const std::vector<int> speed{rpm & 0xFF, rpm >> 8};
    if (unit.tail == Layout::Tail::kOfQt128) {
      out.resize(out.size() + 4 + 17);  // checksum, functional safety
      append({0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, mode});
      append(speed);
      append(date);
      append(time);
      append({0x42, 1, 2, 3, 4, 5, 6, 7, 8});
      out.resize(out.size() + (has_sequence ? 32 : 0));
      return out;
    }
    out.resize(out.size() + (unit.tail == Layout::Tail::kOfPandar ? 8 : 10));
    if (unit.tail == Layout::Tail::kOfXt) {
      append({mode});
      append(speed);
      append(date);
      append(time);
      append({0x42, 1, 2, 3, 4});
    } else {
      append(speed);
      append(time);
      append({mode, 0x42});
      append(date);
      append(has_sequence ? std::vector{1, 2, 3, 4} : std::vector<int>{});
    }
    return out;
  }
};

}  // namespace iog::tests
