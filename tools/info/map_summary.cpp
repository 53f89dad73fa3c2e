#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "tools/info/file_summary.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/printable.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

struct Pgm {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint8_t> pixels;
};

// Of eight bits, without comments, as `iog` and map_saver write them.
Pgm read_pgm(const std::string& path) {
  constexpr std::size_t kMaxSide = 65'536;
  const std::vector<std::byte> bytes = read_file(path);
  std::istringstream text(std::string(reinterpret_cast<const char*>(bytes.data()),
                                      std::min<std::size_t>(bytes.size(), 64)));
  std::string magic;
  Pgm pgm;
  std::size_t highest = 0;
  text >> magic >> pgm.width >> pgm.height >> highest;
  const bool is_readable = text && magic == "P5" && highest == 255 && pgm.width > 0 &&
                           pgm.height > 0 && pgm.width <= kMaxSide && pgm.height <= kMaxSide;
  const std::size_t start = is_readable ? static_cast<std::size_t>(text.tellg()) + 1 : 0;
  if (!is_readable || bytes.size() < start + pgm.width * pgm.height) {
    throw UsageError(path + ": not a whole binary PGM of 8 bits");
  }
  for (std::size_t i = start; i < start + pgm.width * pgm.height; ++i) {
    pgm.pixels.push_back(std::to_integer<std::uint8_t>(bytes[i]));
  }
  return pgm;
}

// "key: value" lines: all that map_server's files consist of.
std::map<std::string, std::string> read_yaml(const std::string& path) {
  std::map<std::string, std::string> entries;
  for (const std::string& line : read_lines(path)) {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) {
      entries.try_emplace(line.substr(0, colon), printable(line.substr(colon + 2)));
    }
  }
  for (const char* const key : {"image", "resolution", "origin"}) {
    if (!entries.contains(key)) {
      throw UsageError(path + ": no map of map_server: it has no line `" + key + ":`");
    }
  }
  return entries;
}

}  // namespace

std::string summary_of_pgm(const std::string& path) {
  const Pgm pgm = read_pgm(path);
  std::array<std::size_t, 256> counts{};
  for (const std::uint8_t pixel : pgm.pixels) {
    ++counts[pixel];
  }
  std::size_t others = pgm.pixels.size();
  for (const std::size_t pixel : {0U, 254U, 205U}) {
    others -= counts[pixel];
  }
  return row("kind",
             "picture (PGM), " + std::to_string(pgm.width) + " x " + std::to_string(pgm.height)) +
         row("as a map", std::to_string(counts[0]) + " occupied, " + std::to_string(counts[254]) +
                             " free, " + std::to_string(counts[205]) + " unknown, " +
                             std::to_string(others) + " other");
}

std::string summary_of_map(const std::string& path) {
  const std::map<std::string, std::string> yaml = read_yaml(path);
  const std::filesystem::path image = yaml.at("image");
  const std::filesystem::path place =
      image.is_absolute() ? image : std::filesystem::path(path).parent_path() / image;
  return row("kind", "map of ROS map_server") + row("resolution", yaml.at("resolution") + " m") +
         row("origin", yaml.at("origin") + " m") + row("image", image.string()) +
         summary_of_pgm(place.string());
}

std::string summary_of_folder(const std::string& path) {
  std::size_t pictures = 0;
  std::size_t classes = 0;
  std::size_t maps = 0;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(path, error)) {
    const std::string name = entry.path().filename();
    pictures += name.starts_with("frame_") && name.ends_with(".png") ? 1U : 0U;
    classes += name.starts_with("classes_") && name.ends_with(".png") ? 1U : 0U;
    maps += name.starts_with("map") && name.ends_with(".yaml") ? 1U : 0U;
  }
  if (pictures + classes + maps == 0) {
    throw UsageError(path +
                     ": a folder without frame_NNNNNN.png, classes_NNNNNN.png and map.yaml, so not "
                     "of `iog record --out FOLDER`. `iog points` reads folders of clouds");
  }
  std::string what;
  for (const auto& [count, words] : {std::pair(pictures, " pictures"), std::pair(maps, " maps"),
                                     std::pair(classes, " pictures of classes")}) {
    what += count == 0 ? "" : (what.empty() ? "" : ", ") + std::to_string(count) + words;
  }
  std::string text = row("kind", "folder: " + what);
  const std::string last = path + "/map.yaml";
  return std::filesystem::exists(last) ? text + row("last frame", "map.yaml") + summary_of_map(last)
                                       : text;
}

}  // namespace iog::tools
