// Weighted least squares of a few unknowns.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace iog::tools {

template <std::size_t kUnknowns>
class NormalEquations {
 public:
  using Row = std::array<double, kUnknowns>;

  // One observation: value = sum of row[i] * unknown i, but for its error.
  void add(const Row& row, double value, double weight) {
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      for (std::size_t j = 0; j < kUnknowns; ++j) {
        matrix_[i][j] += weight * row[i] * row[j];
      }
      matrix_[i][kUnknowns] += weight * row[i] * value;
    }
  }

  // By Gauss's elimination with the largest pivot; none if the observations leave one open.
  [[nodiscard]] std::optional<Row> solution() const {
    auto rest = matrix_;
    for (std::size_t column = 0; column < kUnknowns; ++column) {
      std::size_t pivot = column;
      for (std::size_t row = column + 1; row < kUnknowns; ++row) {
        pivot = std::abs(rest[row][column]) > std::abs(rest[pivot][column]) ? row : pivot;
      }
      std::swap(rest[column], rest[pivot]);
      if (!(std::abs(rest[column][column]) > 1e-9 * std::abs(matrix_[column][column]))) {
        return std::nullopt;
      }
      for (std::size_t row = 0; row < kUnknowns; ++row) {
        const double share = row == column ? 0 : rest[row][column] / rest[column][column];
        for (std::size_t i = column; i <= kUnknowns; ++i) {
          rest[row][i] -= share * rest[column][i];
        }
      }
    }
    Row unknowns{};
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      unknowns[i] = rest[i][kUnknowns] / rest[i][i];
    }
    return unknowns;
  }

 private:
  std::array<std::array<double, kUnknowns + 1>, kUnknowns> matrix_{};
};

}  // namespace iog::tools
