#include "tools/commands/osm_options.hpp"

#include "tools/poses/pose_encoder.hpp"
#include "tools/poses/pose_sample.hpp"
#include "tools/program/add_option.hpp"

namespace iog::tools {
namespace {

constexpr double kMaxPlaceM = 50'000;

void add_place_options(CLI::App& command, OsmOptions& options, CLI::Option* osm) {
  add_option(command, "--osm-origin", "LAT,LON  (default -48.876667,-123.393333: open sea)",
             options.origin,
             "Position of the map's origin on the earth; give the same to `iog map --origin`")
      ->needs(osm);
  add_option(command, "--osm-place", "EAST,NORTH,DEGREES  (default 312.5,-187.25,33)",
             options.place, "Position and heading of the drive's local frame on the map")
      ->expected(3)
      ->delimiter(',')
      ->check(CLI::Range(-kMaxPlaceM, kMaxPlaceM))
      ->needs(osm);
  add_option(command, "--map-sigma", "MM  (default 50)", options.sigma_mm,
             "Standard deviation that the poses state for this position, which is exact")
      ->check(CLI::Range(1.0, 65'535.0))
      ->needs(osm);
  add_option(command, "--map-heading-sigma", "MRAD  (default 0.5)", options.sigma_mrad,
             "Standard deviation that the poses state for this heading")
      ->check(CLI::Range(0.01, 655.35))
      ->needs(osm);
}

void add_error_options(CLI::App& command, OsmOptions& options, CLI::Option* osm) {
  add_option(command, "--osm-shift", "EAST,NORTH  (metres)", options.shift_m,
             "Error of the map: shift it")
      ->expected(2)
      ->delimiter(',')
      ->check(CLI::Range(-1'000.0, 1'000.0))
      ->needs(osm);
  add_option(command, "--osm-noise", "METRES", options.errors.noise_m,
             "Error of the map: move each house, with this standard deviation on each axis")
      ->check(CLI::Range(0.0, 100.0))
      ->needs(osm);
  const auto share = [&](const std::string& name, double& value, const std::string& what) {
    add_option(command, name, "SHARE  (0 to 1)", value, what)
        ->check(CLI::Range(0.0, 1.0))
        ->needs(osm);
  };
  share("--osm-missing", options.errors.missing, "Error of the map: omit this share of the houses");
  share("--osm-outdated", options.errors.outdated,
        "Error of the map: change the outline of this share of the other houses");
  share("--osm-no-width", options.errors.no_width,
        "Error of the map: omit the width of this share of the roads");
  add_option(command, "--osm-ghosts", "N", options.errors.ghosts,
             "Error of the map: add this number of houses that do not exist, beside and on "
             "roads in turn")
      ->check(CLI::Range(0U, 1'000U))
      ->needs(osm);
  add_option(command, "--osm-seed", "N  (default: that of --seed)", options.seed,
             "Seed of the errors")
      ->needs(osm);
}

}  // namespace

void add_osm_options(CLI::App& command, OsmOptions& options, CLI::Option* moving) {
  CLI::Option* const osm = add_option(command, "--osm", "FILE  (needs --moving)", options.out,
                                      "Write the scene as an OpenStreetMap file, and let the "
                                      "poses state the position on it")
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
