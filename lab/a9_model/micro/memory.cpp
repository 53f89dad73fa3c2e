// Lists that are walked in a random order, and sequential reading and writing, in L2 and in DDR.
#include <array>
#include <cstddef>
#include <utility>

#include "micro.hpp"

namespace iog::a9_model::micro {
namespace {

constexpr std::size_t kLineWords = 8;
constexpr std::size_t kL2Lines = std::size_t{256} * 1024 / 32;
constexpr std::size_t kDdrLines = std::size_t{16} * 1024 * 1024 / 32;

alignas(4096) std::array<std::uint32_t, kDdrLines * kLineWords> memory;
alignas(4096) std::array<std::uint32_t, kDdrLines * kLineWords> other;

// One cycle through all lines in random order (Sattolo), as addresses in their first words.
void make_list(std::size_t lines) {
  std::uint32_t random = 12345;
  for (std::size_t line = 0; line < lines; ++line) {
    memory[line * kLineWords] = static_cast<std::uint32_t>(line);
  }
  for (std::size_t left = lines - 1; left > 0; --left) {
    random = random * 1664525u + 1013904223u;
    const std::size_t partner = static_cast<std::size_t>((std::uint64_t{random} * left) >> 32);
    std::swap(memory[left * kLineWords], memory[partner * kLineWords]);
  }
  for (std::size_t line = 0; line < lines; ++line) {
    std::uint32_t& link = memory[line * kLineWords];
    link = static_cast<std::uint32_t>(
        reinterpret_cast<std::uintptr_t>(&memory[link * kLineWords]));  // NOLINT(*reinterpret-cast)
  }
}

std::uint32_t walk(std::uint32_t steps) {
  const std::uint32_t* at = memory.data();
  std::uint32_t left = steps / 8;
  __asm__ volatile(
      "1:\n\t.rept 8\n\tldr %0, [%0]\n\t.endr\n\t"
      "subs %1, %1, #1\n\tbne 1b"
      : "+r"(at), "+r"(left)
      :
      : "cc", "memory");
  return steps;
}

// Reads lines at random places that a linear congruential generator names, so that none waits for
// another; the upper kBits of it are an offset.
template <unsigned kBits>
std::uint32_t read_at_random(std::uint32_t reads) {
  std::uint32_t left = reads / 4;
  std::uint32_t random = 1;
  __asm__ volatile(
      "1:\n\t.rept 4\n\tmla %1, %1, %3, %4\n\tlsr r2, %1, %5\n\tldrb r2, [%2, r2]\n\t.endr\n\t"
      "subs %0, %0, #1\n\tbne 1b"
      : "+r"(left), "+r"(random)
      : "r"(memory.data()), "r"(1664525u), "r"(1013904223u), "i"(32 - kBits)
      : "r2", "cc", "memory");
  return reads;
}

// Reads a word of every line.
std::uint32_t read_lines(std::size_t lines) {
  const std::uint32_t* at = memory.data();
  std::uint32_t left = static_cast<std::uint32_t>(lines / 4);
  __asm__ volatile(
      "1:\n\t.rept 4\n\tldr r2, [%0], #32\n\t.endr\n\t"
      "subs %1, %1, #1\n\tbne 1b"
      : "+r"(at), "+r"(left)
      :
      : "r2", "cc", "memory");
  return static_cast<std::uint32_t>(lines);
}

// Writes a word of every line.
std::uint32_t touch_lines(std::size_t lines) {
  std::uint32_t* at = memory.data();
  std::uint32_t left = static_cast<std::uint32_t>(lines / 4);
  __asm__ volatile(
      "1:\n\t.rept 4\n\tstr %1, [%0], #32\n\t.endr\n\t"
      "subs %1, %1, #1\n\tbne 1b"
      : "+r"(at), "+r"(left)
      :
      : "cc", "memory");
  return static_cast<std::uint32_t>(lines);
}

// Writes every word.
std::uint32_t write_lines(std::size_t lines) {
  std::uint32_t* at = memory.data();
  std::uint32_t left = static_cast<std::uint32_t>(lines);
  __asm__ volatile(
      "1:\n\t.rept 8\n\tstr %1, [%0], #4\n\t.endr\n\t"
      "subs %1, %1, #1\n\tbne 1b"
      : "+r"(at), "+r"(left)
      :
      : "cc", "memory");
  return static_cast<std::uint32_t>(lines);
}

// The same from q registers, as memset() of the firmware does.
std::uint32_t clear_lines(std::size_t lines) {
  std::uint32_t* at = memory.data();
  std::uint32_t left = static_cast<std::uint32_t>(lines);
  __asm__ volatile(
      "vmov.i8 q0, #0\n\tvmov.i8 q1, #0\n"
      "1:\n\tvst1.8 {d0-d3}, [%0:128]!\n\t"
      "subs %1, %1, #1\n\tbne 1b"
      : "+r"(at), "+r"(left)
      :
      : "q0", "q1", "cc", "memory");
  return static_cast<std::uint32_t>(lines);
}

std::uint32_t copy_lines(std::size_t lines) {
  const std::uint32_t* from = memory.data();
  std::uint32_t* to = other.data();
  std::uint32_t left = static_cast<std::uint32_t>(lines);
  __asm__ volatile(
      "1:\n\tpld [%0, #128]\n\tvld1.8 {d0-d3}, [%0:128]!\n\tvst1.8 {d0-d3}, [%1:128]!\n\t"
      "subs %2, %2, #1\n\tbne 1b"
      : "+r"(from), "+r"(to), "+r"(left)
      :
      : "q0", "q1", "cc", "memory");
  return static_cast<std::uint32_t>(lines);
}

}  // namespace

void measure_memory() {
  make_list(kL2Lines);
  measure<40>("l2_chain", [] { return walk(kL2Lines * 4); });
  measure<50>("l2_random_lines", [] { return read_at_random<19>(kL2Lines * 8); });
  measure<41>("l2_read_lines", [] { return read_lines(kL2Lines); });
  measure<42>("l2_touch_lines", [] { return touch_lines(kL2Lines); });
  measure<43>("l2_write_lines", [] { return write_lines(kL2Lines); });
  make_list(kDdrLines);
  measure<44>("ddr_chain", [] { return walk(kDdrLines); });
  measure<51>("ddr_random_lines", [] { return read_at_random<24>(kDdrLines); });
  measure<45>("ddr_read_lines", [] { return read_lines(kDdrLines); });
  measure<46>("ddr_touch_lines", [] { return touch_lines(kDdrLines); });
  measure<47>("ddr_write_lines", [] { return write_lines(kDdrLines); });
  measure<48>("ddr_clear_lines", [] { return clear_lines(kDdrLines); });
  measure<49>("ddr_copy_lines", [] { return copy_lines(kDdrLines); });
}

}  // namespace iog::a9_model::micro
