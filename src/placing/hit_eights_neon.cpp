// The NEON version of hit_eights.cpp. It computes the greatest bytes of all groups of eight in
// parallel.
#include <arm_neon.h>

#include "placing/hit_eights.hpp"

namespace iog::placing {

std::uint32_t hit_eights(const std::int8_t* band) {
  // For four groups of eight, in halves.
  const auto four = [](const std::int8_t* eights) {
    const int8x16_t left = vld1q_s8(eights);
    const int8x16_t right = vld1q_s8(eights + 16);
    return vpmax_s8(vpmax_s8(vget_low_s8(left), vget_high_s8(left)),
                    vpmax_s8(vget_low_s8(right), vget_high_s8(right)));
  };
  // The bits of eight groups, one byte each.
  const auto eight = [&four](const std::int8_t* eights) {
    const int8x8_t greatest = vpmax_s8(four(eights), four(eights + 32));
    return vand_u8(vcgt_s8(greatest, vdup_n_s8(0)), vcreate_u8(0x8040'2010'0804'0201U));
  };
  const auto sixteen = [&eight](const std::int8_t* eights) {
    return vpadd_u8(eight(eights), eight(eights + 64));
  };
  const uint8x8_t bits = vpadd_u8(sixteen(band), sixteen(band + 128));
  return vget_lane_u32(vreinterpret_u32_u8(vpadd_u8(bits, bits)), 0);
}

}  // namespace iog::placing
