#include "tools/formats/picture/picture_folder.hpp"

#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "tools/formats/picture/png_mark.hpp"
#include "tools/formats/picture/ros_map.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

using Path = std::filesystem::path;

void demand_own(bool is_own, const Path& path) {
  if (!is_own) {
    throw UsageError(path.string() + ": not written by iog, or edited since; give another --out");
  }
}

// A map is known by its .yaml, which is written first and removed last.
void demand_own_map(const Path& path) {
  const Path yaml = Path(path).replace_extension(".yaml");
  std::error_code error;
  demand_own(is_own_ros_map(yaml.string()), std::filesystem::exists(yaml, error) ? yaml : path);
}

// The numbered files of an earlier run.
std::vector<Path> own_files(const std::string& folder, bool with_maps) {
  std::vector<Path> files;
  for (const char* const stem : {"frame", "classes"}) {
    for (Path& path : numbered_files(folder, stem, ".png")) {
      demand_own(is_own_picture(path.string()), path);
      files.push_back(std::move(path));
    }
  }
  if (with_maps) {
    for (const char* const suffix : {".pgm", ".yaml"}) {
      for (Path& path : numbered_files(folder, "map", suffix)) {
        demand_own_map(path);
        files.push_back(std::move(path));
      }
    }
  }
  return files;
}

}  // namespace

PictureFolder::PictureFolder(std::string path, bool with_maps)
    : path_(std::move(path)), with_maps_(with_maps) {
  make_folder(path_);
  static_cast<void>(own_files(path_, with_maps_));
  for (const char* const name : {"map.pgm", "map.yaml"}) {
    std::error_code error;
    if (const Path map = Path(path_) / name; std::filesystem::exists(map, error)) {
      demand_own_map(map);
    }
  }
}

void PictureFolder::clear() const {
  for (const Path& path : own_files(path_, with_maps_)) {
    std::error_code error;
    if (!std::filesystem::remove(path, error)) {
      throw UsageError(path.string() + ": cannot be removed: " + error.message());
    }
  }
}

}  // namespace iog::tools
