// iog map: a city map to the block that the target takes.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/commands/subcommands.hpp"
#include "tools/info/file_summary.hpp"
#include "tools/map/block_picture.hpp"
#include "tools/map/map_maker.hpp"
#include "tools/map/map_readers.hpp"
#include "tools/map/refusal_text.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

struct MapCommandOptions {
  std::string from;
  std::string out;
  std::string png;
  std::string kind;
  std::string origin;
  std::vector<double> extent;
  std::optional<std::uint32_t> accuracy_mm;
  std::string attribution;
};

MapOptions options_of(const MapCommandOptions& command) {
  MapOptions options{.accuracy_mm = command.accuracy_mm, .attribution = command.attribution};
  if (!command.origin.empty()) {
    options.origin = map_origin_in("--origin", command.origin);
  }
  const std::vector<double>& extent = command.extent;
  if (extent.size() == 1 && extent[0] > 0) {
    options.radius_m = extent[0];
  } else if (extent.size() == 4 && extent[0] < extent[2] &&
             (extent[1] < extent[3] || (extent[1] > 0 && extent[3] < 0))) {
    // From the west of 180 degrees to its east.
    const double turn = extent[1] < extent[3] ? 0 : 360;
    options.box = {
        .south = extent[0], .west = extent[1], .north = extent[2], .east = extent[3] + turn};
  } else if (!extent.empty()) {
    throw UsageError(
        "--extent: give METRES around the origin, or SOUTH,WEST,NORTH,EAST in degrees");
  }
  if (options.attribution.size() > map::kMaxAttributionBytes) {
    throw UsageError("--attribution: " + std::to_string(map::kMaxAttributionBytes) +
                     " bytes at most");
  }
  return options;
}

void write_block(const std::string& path, std::span<const std::uint8_t> block) {
  OutputFile file(path);
  file.write(std::as_bytes(block));
  file.finish();
}

void make_map(const MapCommandOptions& command) {
  const MapOptions options = options_of(command);
  GeoMap source = read_map(command.from, kind_of_word(command.kind));
  if (source.attribution.empty() && command.attribution.empty()) {
    throw UsageError("--attribution: say whose data these are");
  }
  if (source.box.is_empty()) {
    const std::string refused = source.census.words_of_refused();
    throw UsageError(command.from +
                     ": it has no building or road with latitudes and longitudes in degrees" +
                     (refused.empty() ? "" : "; refused: " + refused));
  }
  const MadeMap made = make_block(source, options);
  demand_features(source, made);
  const map::Refusal refusal = map::check(made.block);
  if (refusal != map::Refusal::kNone) {
    throw CheckFailed(std::string("the block would be refused: ") + refusal_text(refusal));
  }
  write_block(command.out, made.block);
  if (!command.png.empty()) {
    picture_of(map::Block(made.block)).write_png(command.png);
  }
  std::cout << source.census.table() << '\n' << made.remark << summary_of_block(made.block);
}

}  // namespace

void add_map(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "map", "Make a target's city map from OpenStreetMap, GeoJSON or a Shapefile");
  const auto options = std::make_shared<MapCommandOptions>();
  add_option(*command, "FILE", " ", options->from,
             "Map to read (.osm, .osm.pbf, .osm.gz, .osm.bz2, .geojson, .shp)")
      ->required();
  add_option(*command, "--out", "FILE  (required)", options->out, "Map to write (.iogmap)")
      ->required();
  add_option(*command, "--origin", "LAT,LON  (default the middle)", options->origin,
             "Origin of the map's plane, in degrees within 80 and 180");
  add_option(*command, "--extent", "METRES or S,W,N,E  (default all)", options->extent,
             "Part of the map to use: a distance from the origin, or limits in degrees")
      ->delimiter(',')
      ->expected(1, 4);
  add_option(*command, "--accuracy", "MM  (default 500 of OpenStreetMap, else 100)",
             options->accuracy_mm, "95 of 100 corners are closer than this to their true position")
      ->check(CLI::Range(1U, map::kMaxAccuracyMm));
  add_option(*command, "--kind", "building | road", options->kind,
             "Kind of the polygons that do not state theirs")
      ->check(CLI::IsMember({"building", "road"}));
  add_option(*command, "--attribution", "TEXT  (required, except for OpenStreetMap)",
             options->attribution, "Owner of the map data");
  add_option(*command, "--png", "FILE", options->png, "Also draw the map (.png)");
  command->footer(
      "GeoJSON and Shapefiles may use any coordinate reference system that PROJ converts with an "
      "accuracy of 1 m. docs/map.md lists the parts of the data that are used.");
  command->callback([options] { make_map(*options); });
}

}  // namespace iog::tools
