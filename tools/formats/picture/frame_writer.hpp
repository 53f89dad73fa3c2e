// Pictures of a run, frame_NNNNNN.png of occupancy indexes and classes_NNNNNN.png of classes: every
// so many frames, and a map of the last one.
#pragma once

#include <cstdint>
#include <string>

#include "tools/formats/picture/grid_picture.hpp"
#include "tools/frames/grid_frame.hpp"

namespace CLI {
class App;
}

namespace iog::tools {

struct PictureOptions {
  std::string folder;       // empty: no pictures
  std::uint64_t every = 0;  // 0: only the last
  PictureScale scale;
};

class FrameWriter {
 public:
  // Makes the folder, if there is to be one, and takes out of it the frames of an earlier run.
  explicit FrameWriter(const PictureOptions& options);

  // A frame with evidence is drawn if its turn has come.
  void offer(const GridFrame& frame);

  // Draws the frame, if it has not been, and writes it as map.pgm and map.yaml.
  void write_last(const GridFrame& frame);

 private:
  void draw(const GridFrame& frame);

  PictureOptions options_;
  std::uint64_t next_ = 0;
  bool has_drawn_ = false;
  std::uint64_t last_drawn_ = 0;
};

// --out, --every, --scale and --radius; what stands below them in --help.
void add_picture_options(CLI::App& command, PictureOptions& options);
inline constexpr const char* kPictureFooter =
    "Pictures show the vehicle from above: x (forward) points up, y to the left, rings every 10 "
    "m;\n"
    "pale blue is free, orange to red is occupied, dark is unknown; the stronger the index, the\n"
    "stronger the colour. An occupied cell is drawn 3 pixels wide at least. map.pgm and map.yaml "
    "are the last frame of whole scans for ROS map_server: x to the\n"
    "right, y up. classes_NNNNNN.png shows the classes of a target that sends them, in the world: "
    "x to "
    "the\n"
    "right, y up, with the car's outline and a bar for scale; what is occupied is 3 pixels wide at "
    "least.\n";

}  // namespace iog::tools
