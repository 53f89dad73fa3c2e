#include <CLI/CLI.hpp>

#include "tools/formats/picture/frame_writer.hpp"
#include "tools/program/add_option.hpp"

namespace iog::tools {

void add_picture_options(CLI::App& command, PictureOptions& options) {
  add_option(command, "--out", "FOLDER", options.folder,
             "Write pictures and a ROS map into this folder: frame_NNNNNN.png, map.pgm, map.yaml");
  add_option(command, "--every", "N", options.every, "Draw every Nth frame, not only the last one")
      ->check(CLI::NonNegativeNumber);
  add_option(command, "--scale", "N  (1 to 8, default 1)", options.scale.pixels_per_cell,
             "Pixels per cell")
      ->check(CLI::Range(1, 8));
  add_option(command, "--radius", "METRES  (5 to 51, default 51)", options.scale.radius_m,
             "Distance from the car that a picture shows; 51: the whole grid")
      ->check(CLI::Range(5, 51));
}

}  // namespace iog::tools
