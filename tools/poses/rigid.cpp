#include "tools/poses/rigid.hpp"

#include <cmath>
#include <cstddef>

namespace iog::tools {

Rigid product(const Rigid& a, const Rigid& b) {
  Rigid c{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = column == 3 ? a[row * 4 + 3] : 0;
      for (std::size_t i = 0; i < 3; ++i) {
        sum += a[row * 4 + i] * b[i * 4 + column];
      }
      c[row * 4 + column] = sum;
    }
  }
  return c;
}

Rigid inverse(const Rigid& a) {
  Rigid b{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t i = 0; i < 3; ++i) {
      b[row * 4 + i] = a[i * 4 + row];
      b[row * 4 + 3] -= a[i * 4 + row] * a[i * 4 + 3];
    }
  }
  return b;
}

// Rodrigues' formula: a rotation about the unit vector u by an angle is
// cos I + (1 - cos) u u' + sin [u]; its antisymmetric part has sin u.
Rigid between(const Rigid& from, const Rigid& to, double part) {
  const Rigid whole = product(inverse(from), to);
  std::array<double, 3> u = {(whole[9] - whole[6]) / 2, (whole[2] - whole[8]) / 2,
                             (whole[4] - whole[1]) / 2};
  const double sine = std::hypot(u[0], u[1], u[2]);
  const double angle = part * std::atan2(sine, (whole[0] + whole[5] + whole[10] - 1) / 2);
  for (double& side : u) {
    side = sine > 0 ? side / sine : 0;
  }
  const double cos = std::cos(angle);
  const double sin = std::sin(angle);
  Rigid step{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t i = 0; i < 3; ++i) {
      step[row * 4 + i] = (row == i ? cos : 0) + (1 - cos) * u[row] * u[i];
    }
    const std::size_t next = (row + 1) % 3;
    const std::size_t last = (row + 2) % 3;
    step[row * 4 + last] += sin * u[next];
    step[row * 4 + next] -= sin * u[last];
    step[row * 4 + 3] = part * whole[row * 4 + 3];
  }
  return product(from, step);
}

}  // namespace iog::tools
