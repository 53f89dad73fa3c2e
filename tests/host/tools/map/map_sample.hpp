// Small maps for tests: OpenStreetMap as text around a place, and what a block covers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fakes/temporary_folder.hpp"
#include "map/block.hpp"
#include "tools/map/map_maker.hpp"
#include "tools/map/map_readers.hpp"
#include "tools/program/file.hpp"

namespace iog::tests {

// Of the meridian there, in degrees a metre, on the equator of WGS 84: a / (1 - e^2) and a are its
// radii of curvature at 0, 0.
inline constexpr double kDegreesAMetreNorth = 1 / 110'574.2758;
inline constexpr double kDegreesAMetreEast = 1 / 111'319.4908;

inline std::string write_text(const std::string& path, const std::string& text) {
  tools::OutputFile file(path);
  file.write(text);
  file.finish();
  return path;
}

// Objects of OpenStreetMap, placed in metres east and north of 0, 0.
class OsmText {
 public:
  std::int64_t node(double east_m, double north_m) {
    text_ += "<node id='" + std::to_string(++last_id_) + "' version='1' lat='" +
             std::to_string(north_m * kDegreesAMetreNorth) + "' lon='" +
             std::to_string(east_m * kDegreesAMetreEast) + "'/>\n";
    return last_id_;
  }
  // tags: "building=yes highway=service".
  std::int64_t way(const std::vector<std::int64_t>& nodes, const std::string& tags) {
    ways_ += "<way id='" + std::to_string(++last_id_) + "' version='1'>";
    for (const std::int64_t id : nodes) {
      ways_ += "<nd ref='" + std::to_string(id) + "'/>";
    }
    ways_ += tags_of(tags) + "</way>\n";
    return last_id_;
  }
  void multipolygon(const std::vector<std::int64_t>& ways, const std::string& tags) {
    relations_ += "<relation id='" + std::to_string(++last_id_) + "' version='1'>";
    for (const std::int64_t id : ways) {
      relations_ += "<member type='way' ref='" + std::to_string(id) + "' role=''/>";
    }
    relations_ += "<tag k='type' v='multipolygon'/>" + tags_of(tags) + "</relation>\n";
  }
  // A ring of four nodes, closed.
  std::vector<std::int64_t> square(double east_m, double north_m, double side_m) {
    const std::int64_t first = node(east_m, north_m);
    return {first, node(east_m + side_m, north_m), node(east_m + side_m, north_m + side_m),
            node(east_m, north_m + side_m), first};
  }

  [[nodiscard]] std::string text() const {
    return "<osm version='0.6'>\n<bounds minlat='-0.002' minlon='-0.002' maxlat='0.002' "
           "maxlon='0.002'/>\n" +
           text_ + ways_ + relations_ + "</osm>\n";
  }

  [[nodiscard]] tools::GeoMap read() const {
    const TemporaryFolder folder;
    return tools::read_osm(write_text(folder / "map.osm", text()));
  }

 private:
  static std::string escaped(const std::string& value) {
    std::string text;
    for (const char letter : value) {
      text += letter == '"' ? "&quot;" : std::string(1, letter);
    }
    return text;
  }

  static std::string tags_of(const std::string& tags) {
    std::string text;
    std::size_t at = 0;
    while (at < tags.size()) {
      const std::size_t end = std::min(tags.find(';', at), tags.size());
      const std::string tag = tags.substr(at, end - at);
      const std::size_t equals = tag.find('=');
      text +=
          "<tag k='" + tag.substr(0, equals) + "' v=\"" + escaped(tag.substr(equals + 1)) + "\"/>";
      at = end + 1;
    }
    return text;
  }

  std::int64_t last_id_ = 0;
  std::string text_;
  std::string ways_;
  std::string relations_;
};

// A block around 0, 0 and what it covers.
class Covered {
 public:
  explicit Covered(tools::GeoMap&& map) : Covered(map, {.origin = tools::MapOrigin{}}) {}
  Covered(tools::GeoMap& map, const tools::MapOptions& options)
      : bytes_(make_block(map, options).block), census_(map.census) {}

  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  [[nodiscard]] map::Block block() const { return map::Block(bytes_); }
  [[nodiscard]] const tools::Census& census() const { return census_; }

  // The bits of the classes of a place: even-odd in a feature, features united.
  [[nodiscard]] int at(double east_m, double north_m) const {
    const double x = east_m * 100;
    const double y = north_m * 100;
    int bits = 0;
    for (std::uint32_t i = 0; i < block().feature_count(); ++i) {
      const map::Feature feature = block().feature(i);
      bool is_inside = false;
      feature.for_each_edge([&](map::PointCm from, map::PointCm to) {
        if ((from.y <= y) != (to.y <= y) &&
            x < from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x)) {
          is_inside = !is_inside;
        }
      });
      bits |= is_inside ? static_cast<int>(feature.kind()) : 0;
    }
    return bits;
  }

 private:
  std::vector<std::uint8_t> bytes_;
  tools::Census census_;
};

}  // namespace iog::tests
