#include "lab/experiments/map_quality/scene_maps.hpp"

#include <filesystem>
#include <string>
#include <unistd.h>

#include "map/block.hpp"
#include "require/require.hpp"
#include "tools/map/map_maker.hpp"
#include "tools/map/map_readers.hpp"
#include "tools/program/file.hpp"
#include "tools/simulate/maps/osm_file.hpp"

namespace iog::lab {
namespace {

// A file of this process's own, gone at the end.
class TemporaryOsm {
 public:
  explicit TemporaryOsm(std::string_view text)
      : path_(std::filesystem::temp_directory_path() /
              ("iog_scene_" + std::to_string(getpid()) + ".osm")) {
    tools::OutputFile file(path_);
    file.write(text);
    file.finish();
  }
  ~TemporaryOsm() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryOsm(const TemporaryOsm&) = delete;
  TemporaryOsm& operator=(const TemporaryOsm&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

std::vector<std::uint8_t> block_of(const tools::DrawnMap& map, const tools::MapPlace& place,
                                   std::uint32_t accuracy_mm) {
  const TemporaryOsm osm(tools::osm_text(map, place, "of an experiment"));
  tools::GeoMap read = tools::read_osm(osm.path());
  tools::MapOptions options;
  options.origin = {place.origin.latitude, place.origin.longitude};
  options.accuracy_mm = accuracy_mm;
  std::vector<std::uint8_t> block = tools::make_block(read, options).block;
  require(map::check(block) == map::Refusal::kNone);
  return block;
}

}  // namespace iog::lab
