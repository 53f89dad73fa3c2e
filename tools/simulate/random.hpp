// Random numbers that are the same on every machine: xoshiro256** (Blackman and Vigna, 2018),
// seeded by splitmix64, with distributions of our own, because those of the standard library are
// not fixed.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace iog::tools {

class Random {
 public:
  // Streams of one seed are independent of one another.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) {
    std::uint64_t mix = seed ^ (stream * 0xD1342543DE82EF95U);
    for (std::uint64_t& word : state_) {
      mix += 0x9E3779B97F4A7C15U;
      std::uint64_t z = mix;
      z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
      z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
      word = z ^ (z >> 31);
    }
  }

  std::uint64_t next() {
    const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  // 0 <= value < 1, a multiple of 2^-53.
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  double between(double low, double high) { return low + (high - low) * unit(); }

  bool chance(double probability) { return unit() < probability; }

  // 0 ... count - 1.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(unit() * static_cast<double>(count));
  }

  // Mean 0, variance 1, never beyond +-3.5: the sum of four uniform numbers.
  double bell() {
    constexpr double kScale = 1.7320508075688772;  // sqrt(3): four uniforms have variance 4 / 12
    const double a = unit() + unit();
    const double b = unit() + unit();
    return (a + b - 2.0) * kScale;
  }

 private:
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace iog::tools
