#include "tools/simulate/world/script.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "require/require.hpp"

namespace iog::tools {

Timetable::Timetable(std::vector<Call> calls) : calls_(std::move(calls)) {
  require(!calls_.empty());
}

double Timetable::station_at(double time_s) const {
  const auto after = std::ranges::upper_bound(calls_, time_s, {}, &Call::time_s);
  if (after == calls_.begin() || after == calls_.end()) {
    const Call& only = after == calls_.begin() ? calls_.front() : calls_.back();
    return only.station + only.speed * (time_s - only.time_s);
  }
  const Call& a = *(after - 1);
  const Call& b = *after;
  const double span = b.time_s - a.time_s;
  const double t = (time_s - a.time_s) / span;
  const double way = b.station - a.station;
  // Hermite's cubic by powers of t; its speeds at the ends are those of the calls.
  const double first = a.speed * span;
  const double last = b.speed * span;
  return a.station + t * (first + t * (3 * way - 2 * first - last + t * (first + last - 2 * way)));
}

Placement ScriptedCar::at(const Road& road, double time_s) const {
  const double station = timetable.station_at(time_s);
  const auto after = std::ranges::upper_bound(path, station, {}, &Knot::station);
  double left = after == path.end() ? path.back().left : after->left;
  double slope = 0;  // of the path against the road
  if (after != path.begin() && after != path.end()) {
    const Knot& a = *(after - 1);
    const double length = after->station - a.station;
    const double t = (station - a.station) / length;
    const double step = after->left - a.left;
    left = a.left + step * t * t * (3 - 2 * t);
    slope = step * 6 * t * (1 - t) / length;
  }
  const double norm = direction * std::sqrt(1 + slope * slope);
  return turned_by(road.at(station, left), 1 / norm, slope / norm);
}

ScriptedWalker::Place ScriptedWalker::place_at(double time_s) const {
  const auto after = std::ranges::upper_bound(places, time_s, {}, &Place::time_s);
  if (after == places.begin() || after == places.end()) {
    return after == places.begin() ? places.front() : places.back();
  }
  const Place& a = *(after - 1);
  const double t = (time_s - a.time_s) / (after->time_s - a.time_s);
  return {time_s, a.station + t * (after->station - a.station),
          a.left + t * (after->left - a.left)};
}

Placement ScriptedWalker::at(const Road& road, double time_s) const {
  const Place place = place_at(time_s);
  return road.at(place.station, place.left);
}

}  // namespace iog::tools
