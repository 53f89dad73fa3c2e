#include "tools/map/reference_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <proj.h>
#include <proj_experimental.h>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

struct ProjCloser {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
  void operator()(PJ* object) const { proj_destroy(object); }
  void operator()(PJ_OBJ_LIST* list) const { proj_list_destroy(list); }
  void operator()(PJ_OPERATION_FACTORY_CONTEXT* search) const {
    proj_operation_factory_context_destroy(search);
  }
};
using Context = std::unique_ptr<PJ_CONTEXT, ProjCloser>;
using Object = std::unique_ptr<PJ, ProjCloser>;
using List = std::unique_ptr<PJ_OBJ_LIST, ProjCloser>;

constexpr double kNoArea = -1000;  // PROJ's value for an operation without a stated area
constexpr const char* kHeights = "heights are ignored\n";
constexpr std::size_t kShownLetters = 100;  // of a system that is not known

std::string quoted_name(const PJ* object) {
  return std::string("\"") + proj_get_name(object) + "\"";
}

std::string text_of(double metres) {
  std::ostringstream text;
  text << metres << " m";
  return text.str();
}

Context quiet_context() {
  Context context(proj_context_create());
  proj_log_level(context.get(), PJ_LOG_NONE);
  proj_context_set_enable_network(context.get(), 0);
  return context;
}

// The horizontal system inside: without heights, and without the file's own shifts (TOWGS84), whose
// accuracy is not stated.
Object ground_part(PJ_CONTEXT* context, Object system, std::string& remark) {
  for (int within = 0; within < 4 && system; ++within) {
    switch (proj_get_type(system.get())) {
      case PJ_TYPE_GEOGRAPHIC_2D_CRS:
      case PJ_TYPE_PROJECTED_CRS:
        return system;
      case PJ_TYPE_GEOGRAPHIC_3D_CRS:
        remark = kHeights;
        return system;
      case PJ_TYPE_COMPOUND_CRS:
        remark = kHeights;
        system.reset(proj_crs_get_sub_crs(context, system.get(), 0));
        break;
      case PJ_TYPE_BOUND_CRS:
        system.reset(proj_get_source_crs(context, system.get()));
        break;
      default:
        return {};
    }
  }
  return {};
}

List operations(PJ_CONTEXT* context, const PJ* from, const PJ* to, bool need_grids) {
  const std::unique_ptr<PJ_OPERATION_FACTORY_CONTEXT, ProjCloser> search(
      proj_create_operation_factory_context(context, nullptr));
  proj_operation_factory_context_set_allow_ballpark_transformations(context, search.get(), 0);
  proj_operation_factory_context_set_spatial_criterion(context, search.get(),
                                                       PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
  proj_operation_factory_context_set_grid_availability_use(
      context, search.get(),
      need_grids ? PROJ_GRID_AVAILABILITY_DISCARD_OPERATION_IF_MISSING_GRID
                 : PROJ_GRID_AVAILABILITY_IGNORED);
  return List(proj_create_operations(context, from, to, search.get()));
}

// An operation to WGS 84.
struct Way {
  Object operation;
  double error_m = std::numeric_limits<double>::infinity();
};

std::vector<Way> ways_of(PJ_CONTEXT* context, const PJ_OBJ_LIST* list) {
  std::vector<Way> ways;
  for (int i = 0; list != nullptr && i < proj_list_get_count(list); ++i) {
    Object operation(proj_list_get(context, list, i));
    const double error_m = proj_coordoperation_get_accuracy(context, operation.get());
    if (error_m >= 0) {
      ways.push_back({std::move(operation), error_m});
    }
  }
  std::ranges::stable_sort(ways, {}, &Way::error_m);
  return ways;
}

bool is_on_earth(const GeoPoint& point) {
  return std::abs(point.latitude) <= 90 && std::abs(point.longitude) <= 180;
}

// Infinite where the operation fails.
GeoPoint place_by(PJ* way, const GeoPoint& point) {
  const PJ_COORD to =
      proj_trans(way, PJ_FWD, proj_coord(point.longitude, point.latitude, 0, HUGE_VAL));
  return {to.xy.y, to.xy.x};
}

template <typename Do>
void for_each_ring(GeoMap& map, Do what) {
  for (GeoArea& area : map.areas) {
    for (auto& ring : area.rings) {
      what(area, ring);
    }
  }
}

// Degrees with x first, in and out.
Object usual_order(PJ_CONTEXT* context, const PJ* way) {
  return Object(proj_normalize_for_visualization(context, way));
}

// Whether the operation's area holds all of the map.
bool is_meant_for(PJ_CONTEXT* context, const Way& way, GeoMap& map) {
  GeoBox area;
  const PJ* const operation = way.operation.get();
  if (proj_get_area_of_use(context, operation, &area.west, &area.south, &area.east, &area.north,
                           nullptr) == 0 ||
      area.west == kNoArea) {
    return false;
  }
  const Object usual = usual_order(context, operation);
  GeoExtent data;
  for_each_ring(map, [&](const GeoArea&, const std::vector<GeoPoint>& ring) {
    for (const GeoPoint& from : ring) {
      if (const GeoPoint place = place_by(usual.get(), from); is_on_earth(place)) {
        data.extend(place);
      }
    }
  });
  const bool crosses_180 = area.west > area.east;
  area.east += crosses_180 ? 360 : 0;
  const GeoBox& box = data.box(crosses_180);
  return !data.is_empty() && box.south >= area.south && box.north <= area.north &&
         box.west >= area.west && box.east <= area.east;
}

std::string missing_grids(PJ_CONTEXT* context, const Way& way) {
  std::string names;
  for (int i = 0; i < proj_coordoperation_get_grid_used_count(context, way.operation.get()); ++i) {
    const char* name = nullptr;
    int is_there = 0;
    proj_coordoperation_get_grid_used(context, way.operation.get(), i, &name, nullptr, nullptr,
                                      nullptr, nullptr, nullptr, &is_there);
    if (is_there == 0) {
      names += (names.empty() ? "" : ", ") + std::string(name);
    }
  }
  return names;
}

// How far a global frame is from the WGS 84 of receivers; empty for other frames. The realisations
// since 1994 (G730 ...) and those of the ITRS agree to a decimetre, that of the Transit satellites
// to a metre. PROJ states 2 m for all of them.
std::optional<double> error_of_global(std::string_view datum) {
  if (datum == "World Geodetic System 1984") {
    return 0;
  }
  if (datum == "World Geodetic System 1984 (Transit)") {
    return 1;
  }
  const bool is_global = datum.starts_with("World Geodetic System 1984 (G") ||
                         datum.starts_with("International Terrestrial Reference Frame");
  return is_global ? std::optional(0.1) : std::nullopt;
}

// Such a frame is taken as WGS 84: only its projection and units are undone.
std::optional<Way> global_way(PJ_CONTEXT* context, const PJ* system) {
  const Object geodetic(proj_crs_get_geodetic_crs(context, system));
  const Object datum(geodetic ? proj_crs_get_datum_forced(context, geodetic.get()) : nullptr);
  const Object meridian(geodetic ? proj_get_prime_meridian(context, geodetic.get()) : nullptr);
  if (!datum || !meridian || std::string_view(proj_get_name(meridian.get())) != "Greenwich") {
    return std::nullopt;
  }
  const auto error_m = error_of_global(proj_get_name(datum.get()));
  if (!error_m) {
    return std::nullopt;
  }
  const Object degrees(
      proj_create_ellipsoidal_2D_cs(context, PJ_ELLPS2D_LONGITUDE_LATITUDE, nullptr, 0));
  const Object to(
      proj_create_geographic_crs_from_datum(context, "degrees", datum.get(), degrees.get()));
  const List ways = operations(context, system, to.get(), true);
  if (!ways || proj_list_get_count(ways.get()) == 0) {
    return std::nullopt;
  }
  return Way{Object(proj_list_get(context, ways.get(), 0)), *error_m};
}

// The best operation. Operations are valid in boxes, which do not tell land from sea or one country
// from the next, so all that are valid for the map have to be accurate enough. UsageError if not.
Way best_way(PJ_CONTEXT* context, const PJ* system, GeoMap& map) {
  if (auto way = global_way(context, system)) {
    return std::move(*way);
  }
  const Object wgs84(proj_create(context, "EPSG:4326"));
  const auto ways_to = [&](bool need_grids) {
    return ways_of(context, operations(context, system, wgs84.get(), need_grids).get());
  };
  std::vector<Way> ways = ways_to(true);
  std::erase_if(ways, [&](const Way& way) { return !is_meant_for(context, way, map); });
  if (!ways.empty() && ways.back().error_m <= kMostDatumErrorM) {
    return {std::move(ways.front().operation), ways.back().error_m};
  }
  std::string why = "PROJ knows no way from there to WGS 84 where the map is";
  if (!ways.empty()) {
    const bool is_none_good = ways.front().error_m > kMostDatumErrorM;
    why = "the way from there to WGS 84 is good to " +
          text_of((is_none_good ? ways.front() : ways.back()).error_m) +
          (is_none_good ? "" : " in parts of where the map is") + ", worse than " +
          text_of(kMostDatumErrorM);
  }
  for (const Way& better : ways_to(false)) {
    const std::string grids = missing_grids(context, better);
    if (!grids.empty() && better.error_m <= kMostDatumErrorM) {
      why += "; a better one needs a grid that is not installed, " + grids;
      break;
    }
  }
  throw UsageError("is in " + quoted_name(system) + ", and " + why +
                   "; convert it to WGS 84 first");
}

Object ground_system(PJ_CONTEXT* context, const std::string& text, std::string& remark) {
  Object system(proj_create(context, text.c_str()));
  if (!system) {
    throw UsageError("PROJ does not know the coordinate reference system \"" +
                     text.substr(0, kShownLetters) + "\"; convert it to WGS 84 first");
  }
  const std::string name = quoted_name(system.get());
  system = ground_part(context, std::move(system), remark);
  if (!system) {
    throw UsageError("is in " + name +
                     ", which is no system of latitude and longitude or of a projection; convert "
                     "it to WGS 84 first");
  }
  return system;
}

// Areas that are not on earth are refused, with all others of their id.
void keep_what_is_on_earth(GeoMap& map) {
  std::set<std::string> elsewhere;
  for_each_ring(map, [&](const GeoArea& area, const std::vector<GeoPoint>& ring) {
    if (!std::ranges::all_of(ring, is_on_earth) && elsewhere.insert(area.id).second) {
      map.census.refuse("place that is not on earth", area.id);
    }
  });
  std::erase_if(map.areas, [&](const GeoArea& area) { return elsewhere.contains(area.id); });
  map.box = {};
  for_each_ring(map, [&](const GeoArea&, const std::vector<GeoPoint>& ring) {
    std::ranges::for_each(ring, [&](const GeoPoint& point) { map.box.extend(point); });
  });
}

}  // namespace

void to_wgs84(const std::string& system, GeoMap& map) {
  if (!system.empty()) {
    const Context context = quiet_context();
    const Object from = ground_system(context.get(), system, map.remark);
    const Way way = best_way(context.get(), from.get(), map);
    map.datum_error_mm = static_cast<std::uint32_t>(std::lround(way.error_m * 1000));
    if (map.datum_error_mm > 0) {
      map.remark += "from " + quoted_name(from.get()) + " by \"" +
                    proj_get_name(way.operation.get()) + "\", good to " + text_of(way.error_m) +
                    ", which is added to the accuracy\n";
    }
    const Object usual = usual_order(context.get(), way.operation.get());
    for_each_ring(map, [&](const GeoArea&, std::vector<GeoPoint>& ring) {
      std::ranges::transform(ring, ring.begin(),
                             [&](const GeoPoint& point) { return place_by(usual.get(), point); });
    });
  }
  keep_what_is_on_earth(map);
}

}  // namespace iog::tools
