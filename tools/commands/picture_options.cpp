#include <CLI/CLI.hpp>

#include "tools/formats/picture/frame_writer.hpp"

namespace iog::tools {

void add_picture_options(CLI::App& command, PictureOptions& options) {
  command
      .add_option(
          "--out", options.folder,
          "Write pictures and a ROS map into this folder: frame_NNNNNN.png, map.pgm, map.yaml")
      ->option_text("FOLDER");
  command.add_option("--every", options.every, "Draw every Nth frame, not only the last one")
      ->option_text("N")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--scale", options.scale.pixels_per_cell, "Pixels per cell")
      ->option_text("N  (1 to 8, default 1)")
      ->check(CLI::Range(1, 8));
  command
      .add_option("--radius", options.scale.radius_m,
                  "Distance from the car that a picture shows; 51: the whole grid")
      ->option_text("METRES  (5 to 51, default 51)")
      ->check(CLI::Range(5, 51));
}

}  // namespace iog::tools
