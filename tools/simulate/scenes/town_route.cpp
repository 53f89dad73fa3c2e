#include "tools/simulate/scenes/town_route.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

using Point = Road::Point;

constexpr double kFarthestStart = 500;  // metres from the origin
constexpr double kSharpestTurn = -0.2;  // its cosine: 102 degrees
constexpr int kRounding = 20;           // points to either side, twice

double distance(const Point& a, const Point& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

// The point a share of the way from a to b.
Point between(const Point& a, const Point& b, double share) {
  return {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
}

// Cosine of the turn at b.
double straightness(const Point& a, const Point& b, const Point& c) {
  const double product = (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y);
  return product / (distance(a, b) * distance(b, c));
}

// The roads of a map as places and the pieces between them. Roads meet where they have a place in
// common.
class RoadNet {
 public:
  struct Piece {
    std::size_t from;
    std::size_t to;
    double width_m;
  };

  RoadNet(const GeoMap& map, const MapOrigin& origin) : plane_(origin.plane()) {
    for (const GeoRoad& road : map.roads) {
      for (std::size_t i = 0; i + 1 < road.line.size(); ++i) {
        add({index_of(road.line[i]), index_of(road.line[i + 1]), road.width_m});
      }
    }
  }

  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] const Point& at(std::size_t place) const { return places_[place]; }
  [[nodiscard]] std::size_t places() const { return places_.size(); }

  // The piece that goes on from `piece` with the least turn, if any turns little enough.
  [[nodiscard]] std::optional<Piece> next(const Piece& piece) const {
    std::optional<Piece> best;
    double best_straightness = kSharpestTurn;
    for (const Piece& other : leaving_[piece.to]) {
      const double straight = straightness(at(piece.from), at(piece.to), at(other.to));
      if (other.to != piece.from && straight > best_straightness) {
        best = other;
        best_straightness = straight;
      }
    }
    return best;
  }

 private:
  std::size_t index_of(const GeoPoint& point) {
    const auto [found, is_new] =
        numbers_.try_emplace({point.latitude, point.longitude}, places_.size());
    if (is_new) {
      const LocalPlane::Place place = plane_.place_of(point.latitude, point.longitude);
      places_.push_back({place.east_m, place.north_m});
      leaving_.emplace_back();
    }
    return found->second;
  }

  void add(const Piece& piece) {
    if (distance(at(piece.from), at(piece.to)) > 0) {
      pieces_.push_back(piece);
      leaving_[piece.from].push_back(piece);
      leaving_[piece.to].push_back({piece.to, piece.from, piece.width_m});
    }
  }

  LocalPlane plane_;
  std::map<std::pair<double, double>, std::size_t> numbers_;
  std::vector<Point> places_;
  std::vector<Piece> pieces_;
  std::vector<std::vector<Piece>> leaving_;  // by place
};

// Where on a piece a drive could begin.
struct Start {
  RoadNet::Piece piece;
  Point point;
  double away_m;  // from the origin
};

Start start_on(const RoadNet& net, const RoadNet::Piece& piece) {
  const Point a = net.at(piece.from);
  const Point b = net.at(piece.to);
  const double length = distance(a, b);
  const double along = -(a.x * (b.x - a.x) + a.y * (b.y - a.y)) / (length * length);
  const Point nearest = between(a, b, std::clamp(along, 0.0, 1.0));
  return {piece, nearest, distance(nearest, {0, 0})};
}

// Those within reach, the nearest first, each in both directions.
std::vector<Start> starts_of(const RoadNet& net) {
  std::vector<Start> starts;
  for (const RoadNet::Piece& piece : net.pieces()) {
    const Start start = start_on(net, piece);
    if (start.away_m < kFarthestStart) {
      starts.push_back(start);
      starts.push_back({{piece.to, piece.from, piece.width_m}, start.point, start.away_m});
    }
  }
  std::ranges::stable_sort(starts, {}, &Start::away_m);
  return starts;
}

struct Line {
  std::vector<Point> points;  // the first is where it begins
  double length_m = 0;
  double width_m = std::numeric_limits<double>::max();  // the least
};

// From a point of a piece towards its end, and on. Ends at enough_m, where no road goes on, and
// where it would come to a place again.
Line line_from(const RoadNet& net, const Start& start, double enough_m) {
  Line line{.points = {start.point}};
  std::vector<bool> was_seen(net.places(), false);
  std::optional<RoadNet::Piece> piece = start.piece;
  was_seen[piece->from] = true;
  while (piece && line.length_m < enough_m && !was_seen[piece->to]) {
    was_seen[piece->to] = true;
    line.width_m = std::min(line.width_m, piece->width_m);
    const double step = distance(line.points.back(), net.at(piece->to));
    if (step > 0) {
      line.points.push_back(net.at(piece->to));
      line.length_m += step;
    }
    piece = net.next(*piece);
  }
  return line;
}

// Goes straight on beyond the last point, in the direction from the one before it.
void lengthen(std::vector<Point>& points, double metres) {
  const Point& before = points[points.size() - 2];
  const Point& last = points.back();
  points.push_back(between(before, last, 1 + metres / distance(before, last)));
}

// The line at even steps.
std::vector<Point> even(const std::vector<Point>& line) {
  std::vector<Point> points;
  double before = 0;  // the way to the piece's begin
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double length = distance(line[i], line[i + 1]);
    while (static_cast<double>(points.size()) * Road::kStep < before + length) {
      const double along = static_cast<double>(points.size()) * Road::kStep - before;
      points.push_back(between(line[i], line[i + 1], along / length));
    }
    before += length;
  }
  return points;
}

// Each point is the mean of those around it, as many on either side.
std::vector<Point> rounded_off(const std::vector<Point>& points) {
  std::vector<Point> means;
  const auto count = static_cast<std::ptrdiff_t>(points.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const std::ptrdiff_t reach = std::min({std::ptrdiff_t{kRounding}, i, count - 1 - i});
    Point sum{0, 0};
    for (std::ptrdiff_t k = i - reach; k <= i + reach; ++k) {
      sum.x += points[static_cast<std::size_t>(k)].x;
      sum.y += points[static_cast<std::size_t>(k)].y;
    }
    const auto number = static_cast<double>(2 * reach + 1);
    means.push_back({sum.x / number, sum.y / number});
  }
  return means;
}

std::size_t nearest_to(const Point& point, const std::vector<Point>& points) {
  const auto found = std::ranges::min_element(
      points, {}, [&](const Point& other) { return distance(point, other); });
  return static_cast<std::size_t>(found - points.begin());
}

TownRoute route_of(Line ahead, Line behind, const Point& start) {
  std::vector<Point> line = std::move(behind.points);
  if (line.size() > 1) {
    lengthen(line, kSight);
    std::ranges::reverse(line);
    line.pop_back();  // the start is the first point ahead
  } else {
    line = {between(ahead.points[0], ahead.points[1],
                    -kSight / distance(ahead.points[0], ahead.points[1]))};
  }
  lengthen(ahead.points, kSight);
  line.insert(line.end(), ahead.points.begin(), ahead.points.end());
  TownRoute route{.points = even(rounded_off(rounded_off(even(line)))), .width_m = ahead.width_m};
  route.start = nearest_to(start, route.points);
  return route;
}

}  // namespace

TownRoute town_route(const GeoMap& map, const MapOrigin& origin, double ahead_m, double behind_m) {
  const RoadNet net(map, origin);
  double longest_m = 0;
  for (const Start& start : starts_of(net)) {
    Line ahead = line_from(net, start, ahead_m);
    if (ahead.length_m >= ahead_m) {
      const RoadNet::Piece back{start.piece.to, start.piece.from, start.piece.width_m};
      return route_of(std::move(ahead), line_from(net, {back, start.point, start.away_m}, behind_m),
                      start.point);
    }
    longest_m = std::max(longest_m, ahead.length_m);
  }
  if (longest_m == 0) {
    throw UsageError("no road for cars within 500 m of the origin " + text_of(origin));
  }
  throw UsageError("from within 500 m of the origin " + text_of(origin) + " roads lead " +
                   std::to_string(static_cast<int>(longest_m)) + " m far, and the drive needs " +
                   std::to_string(static_cast<int>(ahead_m) + 1) +
                   "; give fewer seconds or another origin");
}

}  // namespace iog::tools
