#include "stream/class_window.hpp"

#include "pose/wire_format.hpp"

namespace iog::stream {

bool are_class_bytes(tile_coding::TileCells cells) {
  // Without a branch per cell, the compiler checks 16 cells at a time.
  unsigned others = 0;
  for (const std::byte cell : cells) {
    others |= is_class_byte(cell) ? 0U : 1U;
  }
  return others == 0;
}

void write_class_window(const ClassWindow& window, std::span<std::byte, kClassWindowBytes> buffer) {
  wire::ByteWriter out(buffer);
  out.u16_be(kClassWindowBytes);
  out.u16_be(window.causes);
  out.i32_be(window.corner_a);
  out.i32_be(window.corner_b);
  pose::write(window.pose, out);
  pose::write(window.sigma, out);
  out.u8(window.slices);
  out.u8(window.slice_ms);
  out.u16_be(0);
  out.u64_be(window.slices_begin_us);
  out.u64_be(window.slices_end_us);
}

bool read_class_window(wire::ByteReader& in, ClassWindow& window) {
  const std::uint16_t bytes = in.u16_be();
  window.causes = in.u16_be();
  window.corner_a = in.i32_be();
  window.corner_b = in.i32_be();
  window.pose = pose::read_pose(in);
  window.sigma = pose::read_sigma(in);
  window.slices = in.u8();
  window.slice_ms = in.u8();
  in.skip(2);
  window.slices_begin_us = in.u64_be();
  window.slices_end_us = in.u64_be();
  if (!in.ok() || bytes < kClassWindowBytes) {
    return false;
  }
  in.skip(bytes - kClassWindowBytes);
  return in.ok();
}

}  // namespace iog::stream
