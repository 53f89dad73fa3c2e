// What look_up.cpp says, for the target. One instruction multiplies the upper half of a coordinate
// and adds, one load takes the upper half of the other; with two steps and its place in a word a
// cell is five instructions. The compiler knows them all, but makes shifts and additions of a
// stride that it knows, and multiples of the step for which it has no registers.
#include "window/look_up.hpp"

namespace iog::window {
namespace {

constexpr std::int32_t kStride = SliceCells::kStride;
static_assert(kStride < 1 << 15 && kFineBits == 16, "halves of a word");

// Four cells, the first in the lowest byte. The point takes four steps.
inline std::uint32_t look_up_four(const std::int8_t* cells, FinePoint& at, FinePoint step) {
  std::uint32_t word;
  std::uint32_t byte;
  const std::int8_t* row;
  asm("smlatb %[row], %[y], %[stride], %[cells]\n\t"
      "ldrb %[word], [%[row], %[x], asr #16]\n\t"
      "add %[y], %[y], %[step_y]\n\t"
      "add %[x], %[x], %[step_x]\n\t"
      "smlatb %[row], %[y], %[stride], %[cells]\n\t"
      "ldrb %[byte], [%[row], %[x], asr #16]\n\t"
      "add %[y], %[y], %[step_y]\n\t"
      "add %[x], %[x], %[step_x]\n\t"
      "orr %[word], %[word], %[byte], lsl #8\n\t"
      "smlatb %[row], %[y], %[stride], %[cells]\n\t"
      "ldrb %[byte], [%[row], %[x], asr #16]\n\t"
      "add %[y], %[y], %[step_y]\n\t"
      "add %[x], %[x], %[step_x]\n\t"
      "orr %[word], %[word], %[byte], lsl #16\n\t"
      "smlatb %[row], %[y], %[stride], %[cells]\n\t"
      "ldrb %[byte], [%[row], %[x], asr #16]\n\t"
      "add %[y], %[y], %[step_y]\n\t"
      "add %[x], %[x], %[step_x]\n\t"
      "orr %[word], %[word], %[byte], lsl #24"
      : [word] "=&r"(word), [byte] "=&r"(byte), [row] "=&r"(row), [x] "+&r"(at.x), [y] "+&r"(at.y)
      : [cells] "r"(cells), [stride] "r"(kStride), [step_x] "r"(step.x), [step_y] "r"(step.y)
      : "memory");
  return word;
}

}  // namespace

void look_up_block(const SliceCells& slice, FinePoint first, FinePoint step, std::size_t x,
                   Band& band) {
  constexpr std::int32_t kSide = SliceCells::kBlockSide;
  static_assert(kSide == 8);
  // From behind the last cell of a row to the first of the next.
  const FinePoint to_next{-kSide * step.x - step.y, -kSide * step.y + step.x};
  for (std::size_t row = x; row < band.size(); row += geometry::kTileSide) {
    const std::uint32_t left = look_up_four(slice.cells(), first, step);
    __builtin_memcpy(__builtin_assume_aligned(&band[row], 4), &left, 4);
    const std::uint32_t right = look_up_four(slice.cells(), first, step);
    __builtin_memcpy(__builtin_assume_aligned(&band[row + 4], 4), &right, 4);
    first = {first.x + to_next.x, first.y + to_next.y};
  }
}

}  // namespace iog::window
