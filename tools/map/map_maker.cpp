#include "tools/map/map_maker.hpp"

#include <algorithm>
#include <cmath>

#include "tools/map/block_writer.hpp"
#include "tools/map/road_outline.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/fixed.hpp"

namespace iog::tools {
namespace {

constexpr double kUnitsPerDegree = 1e9;
// Farther away nothing can belong to the extent, and the plane is of no use.
constexpr double kFarDegrees = 3;

std::int64_t units(double degrees) { return std::llround(degrees * kUnitsPerDegree); }

// The plane at an origin, in centimetres.
class MapPlane {
 public:
  explicit MapPlane(const MapOrigin& origin)
      : latitude_(static_cast<double>(origin.latitude) / kUnitsPerDegree),
        longitude_(static_cast<double>(origin.longitude) / kUnitsPerDegree),
        plane_(origin.plane()) {}

  [[nodiscard]] bool is_near(const GeoPoint& point) const {
    const double around = std::abs(std::remainder(point.longitude - longitude_, 360));
    return std::abs(point.latitude - latitude_) <= kFarDegrees &&
           around * std::cos(latitude_ * std::acos(-1.0) / 180) <= kFarDegrees;
  }

  // Of a box, how much is near; nothing if there is none. Longitudes come out near the origin's.
  [[nodiscard]] GeoBox near_part_of(const GeoBox& box) const {
    constexpr double kNear = 0.999 * kFarDegrees;
    const double aside = kNear / std::cos(latitude_ * std::acos(-1.0) / 180);
    GeoBox part;
    for (const double turn : {0.0, -360.0, 360.0}) {
      part = {.south = std::max(box.south, latitude_ - kNear),
              .west = std::max(box.west + turn, longitude_ - aside),
              .north = std::min(box.north, latitude_ + kNear),
              .east = std::min(box.east + turn, longitude_ + aside)};
      if (!part.is_empty()) {
        break;
      }
    }
    return part;
  }

  [[nodiscard]] PlanePoint operator()(const GeoPoint& point) const {
    const double turn = point.longitude > 180 ? -360 : point.longitude < -180 ? 360 : 0;
    const LocalPlane::Place place = plane_.place_of(point.latitude, point.longitude + turn);
    return {place.east_m * 100, place.north_m * 100};
  }

  [[nodiscard]] std::optional<std::vector<PlanePoint>> operator()(
      const std::vector<GeoPoint>& points) const {
    std::vector<PlanePoint> placed;
    placed.reserve(points.size());
    for (const GeoPoint& point : points) {
      if (!is_near(point)) {
        return std::nullopt;
      }
      placed.push_back((*this)(point));
    }
    return placed;
  }

 private:
  double latitude_;
  double longitude_;
  LocalPlane plane_;
};

struct PlaneBox {
  PlanePoint low{-1e10, -1e10};
  PlanePoint high{1e10, 1e10};
};

// What of the plane lies within a box of latitude and longitude, whose sides are not quite straight
// there: the largest upright rectangle between their innermost points.
PlaneBox inside_of(const GeoBox& box, const MapPlane& plane) {
  constexpr int kSteps = 64;
  PlaneBox inside;
  for (int step = 0; step <= kSteps; ++step) {
    const double share = static_cast<double>(step) / kSteps;
    const double latitude = box.south + (box.north - box.south) * share;
    const double longitude = box.west + (box.east - box.west) * share;
    for (const GeoPoint& point : {GeoPoint{latitude, box.west}, GeoPoint{latitude, box.east},
                                  GeoPoint{box.south, longitude}, GeoPoint{box.north, longitude}}) {
      if (!plane.is_near(point)) {
        throw UsageError(
            "what is asked for reaches more than 3 degrees from the origin; give a smaller "
            "--extent, or another --origin");
      }
    }
    inside.low.x = std::max(inside.low.x, plane({latitude, box.west}).x);
    inside.high.x = std::min(inside.high.x, plane({latitude, box.east}).x);
    inside.low.y = std::max(inside.low.y, plane({box.south, longitude}).y);
    inside.high.y = std::min(inside.high.y, plane({box.north, longitude}).y);
  }
  return inside;
}

PlaneBox both(const PlaneBox& a, const PlaneBox& b) {
  return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)},
          {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y)}};
}

GeoBox data_box(const GeoMap& map) {
  if (map.box.is_empty()) {
    throw UsageError("the file has no places in it");
  }
  return map.bounds.value_or(map.box).box(map.box.crosses_180());
}

MapOrigin middle_of(const GeoBox& box) {
  const double longitude = (box.west + box.east) / 2;
  const MapOrigin middle{units((box.south + box.north) / 2),
                         units(longitude > 180 ? longitude - 360 : longitude)};
  if (std::abs(middle.latitude) > kMostLatitude) {
    throw UsageError("the middle of what is asked for is at " + text_of(middle) +
                     ", and a plane can touch the earth within 80 degrees of latitude alone; give "
                     "another --origin");
  }
  return middle;
}

MapOrigin origin_of(const GeoMap& map, const MapOptions& options) {
  if (options.origin) {
    return *options.origin;
  }
  return options.box ? middle_of(*options.box) : tools::middle_of(map);
}

constexpr const char* kNothingInCommon =
    "the data and the extent that is asked for have nothing in common";

// Narrower than a centimetre, or turned inside out.
bool is_empty(const PlaneBox& box) {
  return box.low.x + 1 > box.high.x || box.low.y + 1 > box.high.y;
}

void demand_fit(const PlaneBox& box) {
  constexpr double kLimit = map::kMaxCoordinateCm;
  if (is_empty(box)) {
    throw UsageError(kNothingInCommon);
  }
  const double buckets = ((box.high.x - box.low.x) / map::kBucketCm + 1) *
                         ((box.high.y - box.low.y) / map::kBucketCm + 1);
  if (box.low.x < -kLimit || box.low.y < -kLimit || box.high.x > kLimit || box.high.y > kLimit ||
      buckets * 4 > static_cast<double>(map::kMaxBlockBytes)) {
    throw UsageError("an extent of " + fixed((box.high.x - box.low.x) / 1e5, 1) + " by " +
                     fixed((box.high.y - box.low.y) / 1e5, 1) +
                     " km does not fit in a block; give a smaller one with --extent METRES");
  }
}

map::BoxCm extent_of(const GeoMap& map, const MapOptions& options, const MapPlane& plane,
                     std::string& remark) {
  const bool is_all = !options.box && !options.radius_m;
  const GeoBox all = data_box(map);
  const GeoBox near = is_all ? all : plane.near_part_of(all);
  if (near.is_empty()) {
    throw UsageError(kNothingInCommon);
  }
  const PlaneBox data = inside_of(near, plane);
  if (is_empty(data)) {
    throw UsageError("the data lie on one line, and a map needs an area");
  }
  PlaneBox wanted = data;
  if (options.box) {
    wanted = inside_of(*options.box, plane);
  } else if (options.radius_m) {
    const double radius = *options.radius_m * 100;
    wanted = {{-radius, -radius}, {radius, radius}};
  }
  const PlaneBox box = both(wanted, data);
  demand_fit(box);
  if (box.low.x > wanted.low.x || box.low.y > wanted.low.y || box.high.x < wanted.high.x ||
      box.high.y < wanted.high.y) {
    remark += "the data do not reach as far as was asked for\n";
  }
  if (!map.bounds) {
    remark += "the file does not say where it is complete: the extent is that of its points\n";
  }
  return {{static_cast<std::int32_t>(std::ceil(box.low.x)),
           static_cast<std::int32_t>(std::ceil(box.low.y))},
          {static_cast<std::int32_t>(std::floor(box.high.x)),
           static_cast<std::int32_t>(std::floor(box.high.y))}};
}

const char* why(BlockWriter::Fate fate) {
  switch (fate) {
    case BlockWriter::Fate::kTaken:
      break;
    case BlockWriter::Fate::kOutside:
      return "outside the extent";
    case BlockWriter::Fate::kTooSmall:
      return "smaller than a centimetre";
    case BlockWriter::Fate::kTooManyVertices:
      return "more than 65,535 vertices";
  }
  return "";
}

class Assembly {
 public:
  Assembly(GeoMap& map, const MapPlane& plane, BlockInfo info)
      : map_(map), plane_(plane), writer_(std::move(info)) {}

  std::vector<std::uint8_t> block() {
    for (const GeoArea& area : map_.areas) {
      add(area);
    }
    for (const GeoRoad& road : map_.roads) {
      add(road);
    }
    return writer_.block();
  }

 private:
  void add(const GeoArea& area) {
    Polygon polygon{.kind = area.kind};
    for (const auto& ring : area.rings) {
      auto placed = plane_(ring);
      if (!placed) {
        map_.census.refuse(why(BlockWriter::Fate::kOutside), area.id);
        return;
      }
      polygon.rings.push_back(std::move(*placed));
    }
    count(writer_.add(polygon), area.as, area.id);
  }

  // A road is outside if all of its pieces are.
  void add(const GeoRoad& road) {
    auto placed = plane_(road.line);
    auto fate = BlockWriter::Fate::kOutside;
    if (placed) {
      const auto pieces = outlines_of({.middle = std::move(*placed),
                                       .width_cm = road.width_m * 100,
                                       .is_round_at_start = road.is_round_at_start,
                                       .is_round_at_end = road.is_round_at_end});
      fate = pieces.empty() ? BlockWriter::Fate::kTooSmall : fate;
      for (const Ring& piece : pieces) {
        const auto of_piece = writer_.add({map::Kind::kRoad, {piece}});
        fate = fate == BlockWriter::Fate::kOutside ? of_piece : fate;
      }
    }
    count(fate, road.as, road.id);
    if (fate == BlockWriter::Fate::kTaken && *road.assumed != 0) {
      map_.census.assume(road.assumed, road.id);
    }
  }

  void count(BlockWriter::Fate fate, const char* as, const std::string& id) {
    if (fate == BlockWriter::Fate::kTaken) {
      map_.census.take(as, id);
    } else {
      map_.census.refuse(why(fate), id);
    }
  }

  GeoMap& map_;
  const MapPlane& plane_;
  BlockWriter writer_;
};

}  // namespace

MapOrigin middle_of(const GeoMap& map) { return middle_of(data_box(map)); }

MadeMap make_block(GeoMap& map, const MapOptions& options) {
  const bool is_osm = map.source == map::Source::kOpenStreetMap;
  const MapOrigin origin = origin_of(map, options);
  const MapPlane plane(origin);
  MadeMap made{.block = {}, .remark = map.remark};
  const std::uint32_t accuracy_mm =
      options.accuracy_mm.value_or(is_osm ? kOsmAccuracyMm : kSurveyedAccuracyMm);
  BlockInfo info{
      .latitude = origin.latitude,
      .longitude = origin.longitude,
      .extent = extent_of(map, options, plane, made.remark),
      .source = map.source,
      .belief = is_osm ? kOsmBelief : kSurveyedBelief,
      .date_s = map.date_s,
      .accuracy_mm = std::min(accuracy_mm + map.datum_error_mm, map::kMaxAccuracyMm),
      .attribution = options.attribution.empty() ? map.attribution : options.attribution};
  made.block = Assembly(map, plane, std::move(info)).block();
  if (made.block.size() > map::kMaxBlockBytes) {
    throw UsageError("the block would have " + std::to_string(made.block.size()) +
                     " bytes, more than the " + std::to_string(map::kMaxBlockBytes) +
                     " that a target takes; give a smaller --extent");
  }
  return made;
}

void demand_features(const GeoMap& map, const MadeMap& made) {
  if (map::Block(made.block).feature_count() > 0) {
    return;
  }
  const std::uint64_t outside =
      map.census.of(Census::Column::kRefused, why(BlockWriter::Fate::kOutside));
  const std::uint64_t all = map.census.sum(Census::Column::kRefused);
  throw UsageError(
      "nothing of the file is a building or a road within the extent: " + std::to_string(outside) +
      " are outside of it, " + std::to_string(all - outside) + " are not taken for other reasons");
}

}  // namespace iog::tools
