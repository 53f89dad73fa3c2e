// OpenStreetMap as XML (.osm, .osc), as downloads, editors and Overpass write it.
#pragma once

#include <optional>
#include <osmium/io/file.hpp>
#include <osmium/memory/buffer.hpp>

#include "tools/map/geo_map.hpp"

namespace iog::tools::osm {

struct Objects {
  static constexpr std::size_t kBytesAtFirst = 1 << 20;
  osmium::memory::Buffer objects{kBytesAtFirst, osmium::memory::Buffer::auto_grow::yes};
  std::optional<GeoExtent> bounds{};  // within which it is complete, if it says so
};

// All objects of the file, in its order. Deleted ones (JOSM's action="delete", visible="false", an
// osmChange's <delete>) are not visible. Nodes and ways that Overpass gives only as coordinates
// (`out geom`) become nodes and ways. Throws std::exception if the file is no such XML or its
// server reports it as incomplete.
[[nodiscard]] Objects read_xml(const osmium::io::File& file);

}  // namespace iog::tools::osm
