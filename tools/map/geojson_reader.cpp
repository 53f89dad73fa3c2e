// Polygons of GeoJSON (RFC 7946, and of 2008 with its "crs"): longitude or east comes first.
#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "tools/map/map_readers.hpp"
#include "tools/map/reference_system.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

using Json = nlohmann::json;

// Why a single feature is not taken.
class Fault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

GeoPoint point_of(const Json& position) {
  if (!position.is_array() || position.size() < 2 || !position[0].is_number() ||
      !position[1].is_number()) {
    throw Fault("place that is not two numbers");
  }
  return {position[1].get<double>(), position[0].get<double>()};
}

// Of GeoJSON of 2008: {"type": "name", "properties": {"name": "EPSG:2154"}}; empty: WGS 84.
std::string system_of(const Json& root) {
  const auto crs = root.find("crs");
  if (crs == root.end()) {
    return {};
  }
  if (!crs->is_object() || crs->value("type", "") != "name") {
    throw UsageError("does not name its coordinate reference system (crs); convert it to WGS 84");
  }
  return crs->at("properties").at("name").get<std::string>();
}

std::vector<GeoPoint> ring_of(const Json& positions) {
  if (!positions.is_array() || positions.size() < 4) {
    throw Fault("area of fewer than three nodes");
  }
  if (positions.front() != positions.back()) {
    throw Fault("area whose outline is open");
  }
  std::vector<GeoPoint> ring;
  for (std::size_t i = 0; i + 1 < positions.size(); ++i) {
    ring.push_back(point_of(positions[i]));
  }
  if (crosses_itself(ring)) {
    throw Fault(kCrossesItself);
  }
  return ring;
}

class Reader {
 public:
  Reader(GeoMap& map, std::optional<map::Kind> kind) : map_(map), kind_(kind) {}

  void read(const Json& root) {
    const std::string system = system_of(root);
    const std::string type = root.value("type", "");
    if (type == "FeatureCollection" && root.contains("features") && root["features"].is_array()) {
      for (const Json& feature : root["features"]) {
        take_feature(feature);
      }
    } else if (type == "Feature") {
      take_feature(root);
    } else {
      throw UsageError("is not a FeatureCollection or a Feature of GeoJSON");
    }
    to_wgs84(system, map_);
  }

 private:
  void take_feature(const Json& feature) {
    ++number_;
    const std::string id = "feature " + std::to_string(number_);
    try {
      take_geometry(feature, id);
    } catch (const Fault& fault) {
      map_.census.refuse(fault.what(), id);
    } catch (const Json::exception&) {
      map_.census.refuse("feature that is not as it should be", id);
    }
  }

  void take_geometry(const Json& feature, const std::string& id) {
    const Json& geometry = feature.at("geometry");
    if (!geometry.is_object()) {
      throw Fault("feature without a place");
    }
    const std::string type = geometry.value("type", "");
    if (type != "Polygon" && type != "MultiPolygon") {
      throw Fault("no polygon");
    }
    const map::Kind kind = kind_of(feature);
    const Json& coordinates = geometry.at("coordinates");
    std::vector<GeoArea> areas;
    for (const Json& polygon : type == "Polygon" ? Json::array({coordinates}) : coordinates) {
      GeoArea area{.kind = kind, .id = id, .as = census_name(kind)};
      for (const Json& ring : polygon) {
        area.rings.push_back(ring_of(ring));
      }
      areas.push_back(std::move(area));
    }
    std::ranges::move(areas, std::back_inserter(map_.areas));
  }

  map::Kind kind_of(const Json& feature) const {
    const auto properties = feature.find("properties");
    if (properties != feature.end() && properties->is_object() && properties->contains("kind")) {
      const auto kind = kind_of_word(properties->value("kind", ""));
      if (!kind) {
        throw Fault("kind that is neither building nor road");
      }
      return *kind;
    }
    if (!kind_) {
      throw UsageError("has features without a property \"kind\": say with --kind what they are");
    }
    return *kind_;
  }

  GeoMap& map_;
  std::optional<map::Kind> kind_;
  std::uint64_t number_ = 0;
};

}  // namespace

GeoMap read_geojson(const std::string& path, std::optional<map::Kind> kind) {
  const std::vector<std::byte> bytes = read_file(path);
  GeoMap map;
  try {
    const auto* const text = reinterpret_cast<const char*>(bytes.data());
    Reader(map, kind).read(Json::parse(text, text + bytes.size()));
  } catch (const Json::exception& error) {
    throw UsageError(path + ": not readable as GeoJSON: " + error.what());
  } catch (const UsageError& error) {
    throw UsageError(path + ": " + error.what());
  }
  return map;
}

}  // namespace iog::tools
