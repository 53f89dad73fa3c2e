#include <CLI/CLI.hpp>

#include "tools/formats/picture/frame_writer.hpp"

namespace iog::tools {

void add_scale_options(CLI::App& command, PictureScale& scale) {
  command.add_option("--scale", scale.pixels_per_cell, "Pixels per cell")
      ->option_text("N  (1 to 8, default as many as 1024 pixels hold)")
      ->check(CLI::Range(1, 8));
  command.add_option("--radius", scale.radius_m, "Distance from the car that a picture shows")
      ->option_text("METRES  (5 to 256, default the whole grid)")
      ->check(CLI::Range(5, 256));
}

void add_picture_options(CLI::App& command, PictureOptions& options) {
  command
      .add_option(
          "--out", options.folder,
          "Write pictures and a ROS map into this folder: frame_NNNNNN.png, map.pgm, map.yaml")
      ->option_text("FOLDER");
  command.add_option("--every", options.every, "Draw every Nth frame, not only the last one")
      ->option_text("N")
      ->check(CLI::NonNegativeNumber);
  add_scale_options(command, options.scale);
}

}  // namespace iog::tools
