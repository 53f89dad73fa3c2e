#include <CLI/CLI.hpp>

#include "tools/picture/frame_writer.hpp"

namespace iog::tools {

void add_picture_options(CLI::App& command, PictureOptions& options) {
  command.add_option("--out", options.folder,
                     "Folder for pictures: frame_NNNNNN.png, and of the last frame map.pgm and "
                     "map.yaml for ROS map_server");
  command.add_option("--every", options.every, "Draw every Nth frame, not only the last");
  command
      .add_option("--scale", options.scale.pixels_per_cell, "Pixels of a picture per cell of 0.1 m")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  command
      .add_option("--radius", options.scale.radius_m,
                  "Metres that a picture shows around the car; 51: the whole grid")
      ->check(CLI::Range(5, 51))
      ->capture_default_str();
}

}  // namespace iog::tools
