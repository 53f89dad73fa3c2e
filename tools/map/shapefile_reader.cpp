// Polygons of an ESRI Shapefile (ESRI white paper of July 1998), through shapelib.
#include <filesystem>
#include <memory>
#include <shapefil.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/map/map_readers.hpp"
#include "tools/map/reference_system.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

struct Closer {
  void operator()(SHPInfo* file) const { SHPClose(file); }
  void operator()(SHPObject* shape) const { SHPDestroyObject(shape); }
};

// What is wrong is said by us.
void ignore_error(const char* /*message*/) {}

// The coordinate reference system stands in a file of its own, as text; empty: there is none.
std::string system_of(const std::string& path) {
  for (const char* const end : {".prj", ".PRJ", ".Prj"}) {
    const std::string beside = std::filesystem::path(path).replace_extension(end).string();
    if (std::filesystem::exists(beside)) {
      std::string text;
      for (const std::string& line : read_lines(beside)) {
        text += line + '\n';
      }
      text.erase(0, text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
      return text.find_first_not_of(" \t\r\n") == std::string::npos ? "" : text;
    }
  }
  return {};
}

bool is_polygon(int type) {
  return type == SHPT_POLYGON || type == SHPT_POLYGONZ || type == SHPT_POLYGONM;
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
    }
    if (crosses_itself(ring)) {
      map.census.refuse(kCrossesItself, area.id);
      return;
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
  const std::string system = system_of(path);
  if (system.empty()) {
    map.remark = "no .prj names its coordinate system: taken as WGS 84, longitude first\n";
  }
  try {
    to_wgs84(system, map);
  } catch (const UsageError& error) {
    throw UsageError(path + ": " + error.what());
  }
  return map;
}

}  // namespace iog::tools
