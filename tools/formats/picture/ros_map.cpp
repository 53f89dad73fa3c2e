#include "tools/formats/picture/ros_map.hpp"

#include <iomanip>
#include <sstream>

#include "tools/formats/picture/pgm.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

// What map_server's map_saver writes.
constexpr std::uint8_t kOccupiedPixel = 0;
constexpr std::uint8_t kFreePixel = 254;
constexpr std::uint8_t kUnknownPixel = 205;

std::uint8_t pixel_of(index::OccupancyIndex index) {
  if (index == index::kUnknown) {
    return kUnknownPixel;
  }
  return index > 0 ? kOccupiedPixel : kFreePixel;
}

}  // namespace

std::vector<std::uint8_t> ros_map_pixels(const RosMap& map) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(map.cells.size());
  const std::size_t columns = map.grid.columns;
  for (std::size_t row = map.grid.rows; row-- > 0;) {
    for (std::size_t x = 0; x < columns; ++x) {
      pixels.push_back(pixel_of(map.cells[row * columns + x]));
    }
  }
  return pixels;
}

std::string ros_map_yaml(const std::string& image, const RosMap& map) {
  const auto metres = [&](int cells) { return cells * map.grid.cell_mm / 1000.0; };
  std::ostringstream yaml;
  yaml << std::fixed << std::setprecision(map.grid.cell_mm % 100 == 0 ? 1 : 2);
  yaml << "image: " << image << '\n'
       << "mode: trinary\n"
       << "resolution: " << map.grid.cell_mm / 1000.0 << '\n'
       << "origin: [" << metres(-map.grid.origin_column) << ", " << metres(-map.grid.origin_row)
       << ", 0.0]\n"
       << "negate: 0\n"
       << "occupied_thresh: 0.65\n"
       << "free_thresh: 0.196\n";
  return yaml.str();
}

void write_ros_map(const std::string& folder, const std::string& base, const RosMap& map) {
  write_pgm(folder + "/" + base + ".pgm", map.grid.columns, map.grid.rows, ros_map_pixels(map));
  OutputFile yaml(folder + "/" + base + ".yaml");
  yaml.write(ros_map_yaml(base + ".pgm", map));
  yaml.finish();
}

}  // namespace iog::tools
