#include "tools/commands/osm_options.hpp"

#include "tools/poses/pose_encoder.hpp"
#include "tools/poses/pose_sample.hpp"

namespace iog::tools {
namespace {

constexpr double kMaxPlaceM = 50'000;

void add_place_options(CLI::App& command, OsmOptions& options, CLI::Option* osm) {
  command
      .add_option("--osm-origin", options.origin,
                  "Position of the map's origin on the earth; give the same to `iog map --origin`")
      ->option_text("LAT,LON  (default -48.876667,-123.393333: open sea)")
      ->needs(osm);
  command
      .add_option("--osm-place", options.place,
                  "Position and heading of the drive's local frame on the map")
      ->option_text("EAST,NORTH,DEGREES  (default 312.5,-187.25,33)")
      ->expected(3)
      ->delimiter(',')
      ->check(CLI::Range(-kMaxPlaceM, kMaxPlaceM))
      ->needs(osm);
  command
      .add_option("--map-sigma", options.sigma_mm,
                  "Standard deviation that the poses state for this position, which is exact")
      ->option_text("MM  (default 50)")
      ->check(CLI::Range(1.0, 65'535.0))
      ->needs(osm);
  command
      .add_option("--map-heading-sigma", options.sigma_mrad,
                  "Standard deviation that the poses state for this heading")
      ->option_text("MRAD  (default 0.5)")
      ->check(CLI::Range(0.01, 655.35))
      ->needs(osm);
}

void add_error_options(CLI::App& command, OsmOptions& options, CLI::Option* osm) {
  command.add_option("--osm-shift", options.shift_m, "Error of the map: shift it")
      ->option_text("EAST,NORTH  (metres)")
      ->expected(2)
      ->delimiter(',')
      ->check(CLI::Range(-1'000.0, 1'000.0))
      ->needs(osm);
  command
      .add_option("--osm-noise", options.errors.noise_m,
                  "Error of the map: move each house, with this standard deviation on each axis")
      ->option_text("METRES")
      ->check(CLI::Range(0.0, 100.0))
      ->needs(osm);
  const auto share = [&](const std::string& name, double& value, const std::string& what) {
    command.add_option(name, value, what)
        ->option_text("SHARE  (0 to 1)")
        ->check(CLI::Range(0.0, 1.0))
        ->needs(osm);
  };
  share("--osm-missing", options.errors.missing, "Error of the map: omit this share of the houses");
  share("--osm-outdated", options.errors.outdated,
        "Error of the map: change the outline of this share of the other houses");
  share("--osm-no-width", options.errors.no_width,
        "Error of the map: omit the width of this share of the roads");
  command
      .add_option("--osm-ghosts", options.errors.ghosts,
                  "Error of the map: add this number of houses that do not exist, beside and on "
                  "roads in turn")
      ->option_text("N")
      ->check(CLI::Range(0U, 1'000U))
      ->needs(osm);
  command.add_option("--osm-seed", options.seed, "Seed of the errors")
      ->option_text("N  (default: that of --seed)")
      ->needs(osm);
}

}  // namespace

void add_osm_options(CLI::App& command, OsmOptions& options, CLI::Option* moving) {
  CLI::Option* const osm = command
                               .add_option("--osm", options.out,
                                           "Write the scene as an OpenStreetMap file, and let the "
                                           "poses state the position on it")
                               ->option_text("FILE  (needs --moving)")
                               ->needs(moving);
  add_place_options(command, options, osm);
  add_error_options(command, options, osm);
}

MapPlace map_place_of(const OsmOptions& options) {
  MapPlace place;
  if (!options.origin.empty()) {
    place.origin = map_origin_in("--osm-origin", options.origin);
  }
  if (!options.place.empty()) {
    place.local_frame = wire_pose(options.place[0], options.place[1], options.place[2] * kRadians);
  }
  place.sigma = wire_sigma(options.sigma_mm / 1000, options.sigma_mrad / 1000);
  return place;
}

MapErrors map_errors_of(const OsmOptions& options) {
  MapErrors errors = options.errors;
  if (!options.shift_m.empty()) {
    errors.shift_east_m = options.shift_m[0];
    errors.shift_north_m = options.shift_m[1];
  }
  return errors;
}

}  // namespace iog::tools
