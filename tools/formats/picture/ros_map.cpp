#include "tools/formats/picture/ros_map.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string_view>
#include <system_error>

#include "tools/formats/picture/pgm.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

// What map_server's map_saver writes.
constexpr std::uint8_t kOccupiedPixel = 0;
constexpr std::uint8_t kFreePixel = 254;
constexpr std::uint8_t kUnknownPixel = 205;

// The words of the .yaml: as nobody else writes them, so that iog knows its own.
constexpr std::string_view kMode = "mode: trinary";
constexpr std::string_view kResolution = "resolution: ";
constexpr std::string_view kOrigin = "origin: [";
constexpr std::string_view kOriginEnd = ", 0.0]";
constexpr std::string_view kEnd = "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196";

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
       << kMode << '\n'
       << kResolution << map.grid.cell_mm / 1000.0 << '\n'
       << kOrigin << metres(-map.grid.origin_column) << ", " << metres(-map.grid.origin_row)
       << kOriginEnd << '\n'
       << kEnd << '\n';
  return yaml.str();
}

bool is_own_ros_map(const std::string& path) {
  const std::filesystem::path file(path);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    return false;
  }
  std::array<std::string, 8> lines;
  std::ifstream stream(file);
  for (std::string& line : lines) {
    std::getline(stream, line);
  }
  return lines[0] == "image: " + file.stem().string() + ".pgm" && lines[1] == kMode &&
         lines[2].starts_with(kResolution) && lines[3].starts_with(kOrigin) &&
         lines[3].ends_with(kOriginEnd) && lines[4] + '\n' + lines[5] + '\n' + lines[6] == kEnd &&
         lines[7].empty();
}

void write_ros_map(const std::string& folder, const std::string& base, const RosMap& map) {
  OutputFile yaml(folder + "/" + base + ".yaml");
  yaml.write(ros_map_yaml(base + ".pgm", map));
  yaml.finish();
  write_pgm(folder + "/" + base + ".pgm", map.grid.columns, map.grid.rows, ros_map_pixels(map));
}

}  // namespace iog::tools
