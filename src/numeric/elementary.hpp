// Computes exp, log, sin and cos for tables at compile time.
//
// On the target, only consteval functions call the functions in this file. A check at link time
// ensures that the image contains no floating-point instructions. On the PC, the reference
// implementations also call these functions at run time. The functions use only the operators +, -,
// * and / on IEEE doubles. Each operation is correctly rounded, so every compiler computes the same
// table. The relative error is below 1e-14 in the stated ranges.
#pragma once

namespace iog::numeric {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kLn2 = 0.69314718055994530942;

// Returns the exact value of 2^n for |n| <= 1022. Repeated squaring keeps compilation fast because
// the compiler evaluates the function for many tables.
constexpr double power_of_two(int n) {
  double square = n < 0 ? 0.5 : 2;
  double result = 1;
  for (int rest = n < 0 ? -n : n; rest != 0; rest /= 2) {
    if (rest % 2 == 1) {
      result *= square;
    }
    if (rest > 1) {  // 2^1024 would overflow
      square *= square;
    }
  }
  return result;
}

// Returns e^x for -700 < x < 700. The argument is written as `n * ln(2) + f`, where `|f|` is at
// most `ln(2) / 2`, and `e^f` is computed from its Taylor series.
constexpr double exp(double x) {
  const double scaled = x / kLn2;
  const int n = static_cast<int>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
  const double f = x - n * kLn2;
  double term = 1;
  double sum = 1;
  for (int i = 1; i <= 18; ++i) {
    term *= f / i;
    sum += term;
  }
  return sum * power_of_two(n);
}

// Returns the natural logarithm of x for 1e-300 < x < 1e300. The argument is written as `m * 2^n`
// with `m` near 1, and `log(m)` is computed from the series of `atanh((m - 1) / (m + 1))`.
constexpr double log(double x) {
  int n = 0;
  while (x > 1.5) {
    x /= 2;
    ++n;
  }
  while (x < 0.75) {
    x *= 2;
    --n;
  }
  const double y = (x - 1) / (x + 1);
  double power = y;
  double sum = 0;
  for (int i = 1; i < 48; i += 2) {
    sum += power / i;
    power *= y * y;
  }
  return 2 * sum + n * kLn2;
}

// Returns the sum of `(-1)^i * x^(2 * i + first) / (2 * i + first)!` over `i` for `|x| <= pi / 4`.
// This sum is the Taylor series of the cosine if `first` is 0, and of the sine if `first` is 1.
constexpr double alternating_series(double x, int first) {
  double term = first == 0 ? 1 : x;
  double sum = term;
  for (int i = first + 1; i < 24; i += 2) {
    term *= -x * x / (i * (i + 1));
    sum += term;
  }
  return sum;
}

// Returns the sine of an angle in the first quadrant, 0 <= x <= pi / 2.
constexpr double sin_first_quadrant(double x) {
  return x <= kPi / 4 ? alternating_series(x, 1) : alternating_series(kPi / 2 - x, 0);
}

// Returns the sine of x for |x| < 1000.
constexpr double sin(double x) {
  while (x < 0) {
    x += 2 * kPi;
  }
  while (x >= 2 * kPi) {
    x -= 2 * kPi;
  }
  const double folded = x > kPi ? x - kPi : x;
  const double value = sin_first_quadrant(folded > kPi / 2 ? kPi - folded : folded);
  return x > kPi ? -value : value;
}

constexpr double cos(double x) { return sin(x + kPi / 2); }

// Returns the nearest integer, with ties rounded away from zero. Requires |x| < 2^62.
constexpr long long round(double x) { return static_cast<long long>(x < 0 ? x - 0.5 : x + 0.5); }

}  // namespace iog::numeric
