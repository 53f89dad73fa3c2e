// Builds ibeo LUX 0x2202 messages byte by byte from the format's description (docs/spec.md),
// without any code of the decoder's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace iog::tests {

struct LuxPoint {
  int layer = 0;
  int echo = 0;
  int flags = 0;
  int angle_ticks = 0;  // + is left
  int range_cm = 0;
};

struct LuxMessage {
  int scan_number = 1;
  int start_ticks = 1600;
  int end_ticks = -1600;
  std::vector<LuxPoint> points{};
  std::uint64_t start_ntp = 1;  // of the scan
  std::uint64_t end_ntp = 2;
  int status = 0x030B;
  int flags = 2;

  [[nodiscard]] std::vector<std::byte> bytes() const {
    std::vector<std::byte> out;
    const auto big = [&](std::uint64_t value, int size) {
      for (int i = size - 1; i >= 0; --i) {
        out.push_back(static_cast<std::byte>(value >> (8 * i)));
      }
    };
    const auto little = [&](std::int64_t value, int size) {
      for (int i = 0; i < size; ++i) {
        out.push_back(static_cast<std::byte>(value >> (8 * i)));
      }
    };
    const std::uint64_t body = 44 + 10 * points.size();
    big(0xAFFEC0C2, 4);
    big(0, 4);  // size of the previous message
    big(body, 4);
    big(0, 1);  // reserved
    big(7, 1);  // device id
    big(0x2202, 2);
    big(0, 8);  // time
    little(scan_number, 2);
    little(status, 2);
    little(0, 2);  // synchronisation phase
    little(static_cast<std::int64_t>(start_ntp), 8);
    little(static_cast<std::int64_t>(end_ntp), 8);
    little(11520, 2);
    little(start_ticks, 2);
    little(end_ticks, 2);
    little(static_cast<std::int64_t>(points.size()), 2);
    for (int field = 0; field < 6; ++field) {
      little(0, 2);  // mounting: yaw, pitch, roll, x, y, z
    }
    little(flags, 2);
    for (const LuxPoint& point : points) {
      little(point.layer | point.echo << 4, 1);
      little(point.flags, 1);
      little(point.angle_ticks, 2);
      little(point.range_cm, 2);
      little(40, 2);  // echo pulse width
      little(0, 2);
    }
    return out;
  }
};

}  // namespace iog::tests
