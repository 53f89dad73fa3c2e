#include "tools/map/road_outline.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace iog::tools {
namespace {

constexpr double kSharpestTurn = std::numbers::pi / 3;  // of one joint that is not rounded
constexpr double kMostTurning = std::numbers::pi / 2;   // of a piece, both ways together
constexpr double kShortestCm = 1;

// What a half circle adds between its ends: three points, so the arc is cut by 8 % of the radius.
constexpr double kHalfRoot = 1 / std::numbers::sqrt2;
constexpr std::array<PlanePoint, 3> kHalfCircle{
    {{kHalfRoot, kHalfRoot}, {0, 1}, {-kHalfRoot, kHalfRoot}}};

PlanePoint operator+(const PlanePoint& a, const PlanePoint& b) { return {a.x + b.x, a.y + b.y}; }
PlanePoint operator-(const PlanePoint& a, const PlanePoint& b) { return {a.x - b.x, a.y - b.y}; }
PlanePoint operator*(const PlanePoint& a, double factor) { return {a.x * factor, a.y * factor}; }
PlanePoint left_of(const PlanePoint& direction) { return {-direction.y, direction.x}; }
double length_of(const PlanePoint& a) { return std::hypot(a.x, a.y); }

// A middle without points that repeat, and with one at least every kMaxPieceCm.
std::vector<PlanePoint> evened(const std::vector<PlanePoint>& middle) {
  std::vector<PlanePoint> points;
  for (const PlanePoint& point : middle) {
    if (points.empty()) {
      points.push_back(point);
      continue;
    }
    const PlanePoint from = points.back();
    const double length = length_of(point - from);
    if (length < kShortestCm) {
      continue;
    }
    const auto steps = static_cast<int>(std::ceil(length / kMaxPieceCm));
    for (int step = 1; step <= steps; ++step) {
      points.push_back(from + (point - from) * (static_cast<double>(step) / steps));
    }
  }
  return points;
}

class Outliner {
 public:
  Outliner(std::vector<PlanePoint> points, const RoadLine& road)
      : points_(std::move(points)), road_(road), half_cm_(road.width_cm / 2) {
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
      const PlanePoint along = points_[i + 1] - points_[i];
      lengths_.push_back(length_of(along));
      directions_.push_back(along * (1 / lengths_.back()));
    }
  }

  std::vector<Ring> pieces() const {
    std::vector<Ring> rings;
    for (std::size_t first = 0; first < directions_.size();) {
      const std::size_t last = end_of_piece(first);
      rings.push_back(piece(first, last));
      first = last;
    }
    return rings;
  }

 private:
  [[nodiscard]] bool is_inner(std::size_t point) const {
    return point > 0 && point + 1 < points_.size();
  }

  [[nodiscard]] double turn_at(std::size_t point) const {
    const PlanePoint& in = directions_[point - 1];
    const PlanePoint& out = directions_[point];
    return std::abs(std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y));
  }

  // How much of its segments a mitred joint takes on its inner side.
  [[nodiscard]] double room_at(std::size_t point) const {
    return half_cm_ * std::tan(turn_at(point) / 2);
  }

  // May the sides go on through this point, meeting on the line that halves its angle?
  [[nodiscard]] bool is_mitred(std::size_t point) const {
    return is_inner(point) && turn_at(point) <= kSharpestTurn &&
           2 * room_at(point) <= lengths_[point - 1] && 2 * room_at(point) <= lengths_[point];
  }

  [[nodiscard]] std::size_t end_of_piece(std::size_t first) const {
    double turned = 0;
    double length = lengths_[first];
    std::size_t last = first + 1;
    while (is_mitred(last) && turned + turn_at(last) <= kMostTurning &&
           length + lengths_[last] <= kMaxPieceCm) {
      turned += turn_at(last);
      length += lengths_[last];
      ++last;
    }
    return last;
  }

  // From the middle to the left side at a point of the piece, whose segment there is given.
  [[nodiscard]] PlanePoint to_left(std::size_t point, std::size_t segment) const {
    if (!is_mitred(point)) {
      return left_of(directions_[segment]) * half_cm_;
    }
    const PlanePoint sum = directions_[point - 1] + directions_[point];
    return left_of(sum) * (half_cm_ / (length_of(sum) * std::cos(turn_at(point) / 2)));
  }

  [[nodiscard]] bool is_round(std::size_t point) const {
    if (point == 0) {
      return road_.is_round_at_start;
    }
    return is_inner(point) ? !is_mitred(point) : road_.is_round_at_end;
  }

  // From the right of `ahead` over the point before it to the left.
  void add_half_circle(Ring& ring, const PlanePoint& middle, const PlanePoint& ahead) const {
    for (const PlanePoint& on : kHalfCircle) {
      const PlanePoint right = left_of(ahead) * -on.x;
      ring.push_back(middle + (right + ahead * on.y) * half_cm_);
    }
  }

  [[nodiscard]] Ring piece(std::size_t first, std::size_t last) const {
    Ring ring;
    for (std::size_t point = last; point > first; --point) {
      ring.push_back(points_[point] + to_left(point, point - 1));
    }
    ring.push_back(points_[first] + to_left(first, first));
    if (is_round(first)) {
      add_half_circle(ring, points_[first], directions_[first] * -1);
    }
    ring.push_back(points_[first] - to_left(first, first));
    for (std::size_t point = first + 1; point <= last; ++point) {
      ring.push_back(points_[point] - to_left(point, point - 1));
    }
    if (is_round(last)) {
      add_half_circle(ring, points_[last], directions_[last - 1]);
    }
    return ring;
  }

  std::vector<PlanePoint> points_;
  const RoadLine& road_;
  double half_cm_;
  std::vector<PlanePoint> directions_;  // of length 1
  std::vector<double> lengths_;
};

}  // namespace

std::vector<Ring> outlines_of(const RoadLine& road) {
  return Outliner(evened(road.middle), road).pieces();
}

}  // namespace iog::tools
