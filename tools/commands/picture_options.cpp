#include <CLI/CLI.hpp>

#include "tools/formats/picture/frame_writer.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/number_checks.hpp"

namespace iog::tools {

void add_scale_options(CLI::App& command, PictureScale& scale) {
  add_option(command, "--scale", "N  (1 to 8, default as many as 1024 pixels hold)",
             scale.pixels_per_cell, "Pixels per cell")
      ->check(CLI::Range(1, 8));
  add_option(command, "--radius", "METRES  (5 to 256, default the whole grid)", scale.radius_m,
             "Distance from the car that a picture shows")
      ->check(CLI::Range(5, 256));
}

void add_picture_options(CLI::App& command, PictureOptions& options) {
  add_option(command, "--out", "FOLDER", options.folder,
             "Write pictures and a ROS map into this folder: frame_NNNNNN.png, map.pgm, map.yaml");
  add_option(command, "--every", "N", options.every, "Draw every Nth frame, not only the last one")
      ->check(above_zero());
  add_scale_options(command, options.scale);
}

}  // namespace iog::tools
