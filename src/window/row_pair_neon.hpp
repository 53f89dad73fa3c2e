// Two rows of bits at once by NEON, for the target: what row_pair_plain.hpp says.
#pragma once

#include <arm_neon.h>
#include <cstdint>

namespace iog::window {

class NeonRowPair {
 public:
  static NeonRowPair load(const std::uint64_t* from) { return NeonRowPair(vld1q_u64(from)); }
  void store(std::uint64_t* to) const { vst1q_u64(to, rows_); }
  void store_middle(std::uint32_t* to) const { vst1_u32(to, vshrn_n_u64(rows_, 16)); }

  [[nodiscard]] NeonRowPair bit_and(NeonRowPair other) const {
    return NeonRowPair(vandq_u64(rows_, other.rows_));
  }
  [[nodiscard]] NeonRowPair bit_or(NeonRowPair other) const {
    return NeonRowPair(vorrq_u64(rows_, other.rows_));
  }
  [[nodiscard]] NeonRowPair and_not(NeonRowPair other) const {
    return NeonRowPair(vbicq_u64(rows_, other.rows_));
  }

  template <int kBits>
  [[nodiscard]] NeonRowPair up() const {
    return NeonRowPair(vshlq_n_u64(rows_, kBits));
  }
  template <int kBits>
  [[nodiscard]] NeonRowPair down() const {
    return NeonRowPair(vshrq_n_u64(rows_, kBits));
  }

 private:
  explicit NeonRowPair(uint64x2_t rows) : rows_(rows) {}

  uint64x2_t rows_;
};

}  // namespace iog::window
