#include "lab/evaluation/gospa.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace iog::lab {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// The assignment of all rows to columns with the least sum, by shortest augmenting paths (Jonker,
// Volgenant 1987). There are not fewer columns than rows.
class Assignment {
 public:
  Assignment(std::span<const Vector2> rows, std::span<const Vector2> columns, double cut_m)
      : rows_(rows),
        columns_(columns),
        cut_m_(cut_m),
        of_row_(rows.size(), 0),
        of_column_(columns.size(), 0),
        row_of_(columns.size(), kNone) {
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      add(row);
    }
  }

  [[nodiscard]] double cost(std::size_t row, std::size_t column) const {
    return std::min(distance(rows_[row], columns_[column]), cut_m_);
  }
  // By column, its row or kNone.
  [[nodiscard]] const std::vector<std::size_t>& row_of() const { return row_of_; }

 private:
  // How far away the columns are from a new row, and by which column the shortest way comes to
  // them.
  struct Paths {
    std::vector<double> length;
    std::vector<std::size_t> before;
    std::vector<bool> is_done;
  };

  void add(std::size_t row) {
    Paths paths{.length = std::vector<double>(columns_.size(), std::numeric_limits<double>::max()),
                .before = std::vector<std::size_t>(columns_.size(), kNone),
                .is_done = std::vector<bool>(columns_.size(), false)};
    std::size_t at = row;      // the row that the paths have come to,
    std::size_t from = kNone;  // its column,
    double length = 0;         // and how far away it is
    std::size_t nearest = kNone;
    do {
      nearest = kNone;
      for (std::size_t column = 0; column < columns_.size(); ++column) {
        if (paths.is_done[column]) {
          continue;
        }
        const double its = length + cost(at, column) - of_row_[at] - of_column_[column];
        if (its < paths.length[column]) {
          paths.length[column] = its;
          paths.before[column] = from;
        }
        if (nearest == kNone || paths.length[column] < paths.length[nearest]) {
          nearest = column;
        }
      }
      paths.is_done[nearest] = true;
      length = paths.length[nearest];
      from = nearest;
      at = row_of_[nearest];
    } while (at != kNone);
    raise_prices(row, length, paths);
    turn_over(row, nearest, paths);
  }

  // So that no cost is below what its row and its column ask together.
  void raise_prices(std::size_t row, double length, const Paths& paths) {
    of_row_[row] += length;
    for (std::size_t column = 0; column < columns_.size(); ++column) {
      if (paths.is_done[column] && row_of_[column] != kNone) {
        of_row_[row_of_[column]] += length - paths.length[column];
      }
      if (paths.is_done[column]) {
        of_column_[column] -= length - paths.length[column];
      }
    }
  }

  // The columns of the path get the rows of those before.
  void turn_over(std::size_t row, std::size_t last, const Paths& paths) {
    for (std::size_t column = last; column != kNone; column = paths.before[column]) {
      const std::size_t before = paths.before[column];
      row_of_[column] = before == kNone ? row : row_of_[before];
    }
  }

  std::span<const Vector2> rows_;
  std::span<const Vector2> columns_;
  double cut_m_;
  std::vector<double> of_row_;  // prices
  std::vector<double> of_column_;
  std::vector<std::size_t> row_of_;
};

}  // namespace

double distance(const Vector2& a, const Vector2& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

Gospa gospa(std::span<const Vector2> truth, std::span<const Vector2> reported, double cut_m) {
  const bool are_more_true = truth.size() > reported.size();
  const Assignment found(are_more_true ? reported : truth, are_more_true ? truth : reported, cut_m);
  Gospa result{.missed = truth.size(), .wrong = reported.size()};
  for (std::size_t column = 0; column < found.row_of().size(); ++column) {
    const std::size_t row = found.row_of()[column];
    if (row == kNone || found.cost(row, column) >= cut_m) {
      continue;
    }
    result.place_m += found.cost(row, column);
    --result.missed;
    --result.wrong;
  }
  return result;
}

}  // namespace iog::lab
