// The options of `iog simulate` that make a map of the scene.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/simulate/maps/drawn_map.hpp"
#include "tools/simulate/world/map_place.hpp"

namespace iog::tools {

struct OsmOptions {
  std::string out;  // empty: no map
  std::string origin;
  std::vector<double> place;  // metres east, metres north, degrees; empty: the default
  double sigma_mm = MapPlace{}.sigma.position_mm;
  double sigma_mrad = MapPlace{}.sigma.heading_10urad / 100.0;
  std::vector<double> shift_m;
  MapErrors errors;  // but for the shift
  std::optional<std::uint64_t> seed;
};

void add_osm_options(CLI::App& command, OsmOptions& options, CLI::Option* moving);

// UsageError if an option makes no sense.
[[nodiscard]] MapPlace map_place_of(const OsmOptions& options);
[[nodiscard]] MapErrors map_errors_of(const OsmOptions& options);

}  // namespace iog::tools
