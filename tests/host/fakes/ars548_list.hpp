// Detection lists as a Continental ARS548 sends them, with what a test wants in them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wire/byte_writer.hpp"

namespace iog::tests {

struct Ars548Detection {
  float azimuth = 0;  // radians
  float elevation = 0;
  float elevation_std = 0;
  float range = 10;  // metres
  std::uint8_t invalid_flags = 0;
  std::uint8_t existence = 100;
  std::uint8_t classification = 4;
};

struct Ars548List {
  std::vector<Ars548Detection> detections{};
  std::uint32_t seconds = 1'708'578'203;
  std::uint32_t nanoseconds = 955'760'000;
  std::uint16_t method = 336;

  [[nodiscard]] std::vector<std::byte> bytes() const {
    std::vector<std::byte> list(35'336);
    wire::ByteWriter out(list);
    out.u16_be(0);
    out.u16_be(method);
    out.u32_be(35'328);
    out.zeros(28);
    out.u32_be(nanoseconds);
    out.u32_be(seconds);
    out.zeros(101 - 44);
    for (const Ars548Detection& detection : detections) {
      write(detection, out);
    }
    out.zeros((800 - detections.size()) * 44 + 8);
    out.u32_be(static_cast<std::uint32_t>(detections.size()));
    return list;
  }

 private:
  static void write(const Ars548Detection& its, wire::ByteWriter& out) {
    const auto real = [&](float value) { out.u32_be(std::bit_cast<std::uint32_t>(value)); };
    real(its.azimuth);
    real(0.00872663F);
    out.u8(its.invalid_flags);
    real(its.elevation);
    real(its.elevation_std);
    real(its.range);
    real(0.2F);
    out.zeros(4 + 4 + 1 + 2);
    out.u8(its.existence);
    out.u8(its.classification);
    out.zeros(6);
  }
};

}  // namespace iog::tests
