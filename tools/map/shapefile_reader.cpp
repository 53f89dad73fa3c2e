// Polygons of an ESRI Shapefile (ESRI white paper of July 1998), through shapelib.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <shapefil.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/map/map_readers.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

struct Closer {
  void operator()(SHPInfo* file) const { SHPClose(file); }
  void operator()(SHPObject* shape) const { SHPDestroyObject(shape); }
};

// What is wrong is said by us.
void ignore_error(const char* /*message*/) {}

// The projection stands in a file of its own, as text.
void demand_degrees(const std::string& path) {
  std::ifstream file(std::filesystem::path(path).replace_extension(".prj"));
  std::string text;
  if (file && std::getline(file, text) && !text.starts_with("GEOGC")) {
    throw UsageError(path + ": is projected; convert it to latitude and longitude of WGS 84 first");
  }
}

bool is_polygon(int type) {
  return type == SHPT_POLYGON || type == SHPT_POLYGONZ || type == SHPT_POLYGONM;
}

bool is_on_earth(double latitude, double longitude) {
  return std::abs(latitude) <= 90 && std::abs(longitude) <= 180;
}

// Where the points of a part are.
struct Part {
  int first;
  int end;
};

Part part_of(const SHPObject& shape, int part) {
  return {shape.panPartStart[part],
          part + 1 < shape.nParts ? shape.panPartStart[part + 1] : shape.nVertices};
}

// Why a part is no ring; empty if it is one.
std::string_view fault_of(const SHPObject& shape, const Part& part) {
  if (part.first < 0 || part.end > shape.nVertices || part.end - part.first < 4) {
    return "area of fewer than three nodes";
  }
  for (int i = part.first; i < part.end; ++i) {
    if (!is_on_earth(shape.padfY[i], shape.padfX[i])) {
      return "place that is not on earth";
    }
  }
  const int last = part.end - 1;
  const bool is_closed =
      shape.padfX[part.first] == shape.padfX[last] && shape.padfY[part.first] == shape.padfY[last];
  return is_closed ? "" : "area whose outline is open";
}

void take(const SHPObject& shape, GeoArea area, GeoMap& map) {
  if (!is_polygon(shape.nSHPType) || shape.nParts < 1) {
    map.census.refuse("no polygon", area.id);
    return;
  }
  for (int number = 0; number < shape.nParts; ++number) {
    const Part part = part_of(shape, number);
    if (const std::string_view fault = fault_of(shape, part); !fault.empty()) {
      map.census.refuse(fault, area.id);
      return;
    }
    std::vector<GeoPoint> ring;
    for (int i = part.first; i + 1 < part.end; ++i) {
      ring.push_back({shape.padfY[i], shape.padfX[i]});
      map.box.extend(ring.back());
    }
    area.rings.push_back(std::move(ring));
  }
  map.areas.push_back(std::move(area));
}

}  // namespace

GeoMap read_shapefile(const std::string& path, std::optional<map::Kind> kind) {
  if (!kind) {
    throw UsageError(path + ": say with --kind what its polygons are");
  }
  demand_degrees(path);
  SAHooks hooks;
  SASetupDefaultHooks(&hooks);
  hooks.Error = ignore_error;
  const std::unique_ptr<SHPInfo, Closer> file(SHPOpenLL(path.c_str(), "rb", &hooks));
  if (!file) {
    throw UsageError(path + ": not readable as a Shapefile; its .shx has to stand beside it");
  }
  int shapes = 0;
  SHPGetInfo(file.get(), &shapes, nullptr, nullptr, nullptr);
  GeoMap map;
  for (int number = 0; number < shapes; ++number) {
    GeoArea area{.kind = *kind, .id = "shape " + std::to_string(number), .as = census_name(*kind)};
    const std::unique_ptr<SHPObject, Closer> shape(SHPReadObject(file.get(), number));
    if (shape) {
      take(*shape, std::move(area), map);
    } else {
      map.census.refuse("shape that cannot be read", area.id);
    }
  }
  return map;
}

}  // namespace iog::tools
