// Pictures of a run, frame_NNNNNN.png of occupancy indexes and classes_NNNNNN.png of classes: every
// so many frames, and a map of the last one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tools/formats/picture/grid_picture.hpp"
#include "tools/formats/picture/picture_folder.hpp"
#include "tools/frames/grid_frame.hpp"

namespace CLI {
class App;
}

namespace iog::tools {

struct PictureOptions {
  std::string folder;       // empty: no pictures
  std::uint64_t every = 0;  // 0: only the last
  PictureScale scale{.pixels_per_cell = 0};
};

class FrameWriter {
 public:
  // Makes the folder, if there is to be one. The first picture takes out of it the frames, and
  // numbered maps, of an earlier run. UsageError as PictureFolder.
  explicit FrameWriter(const PictureOptions& options, bool with_maps = false);

  // A frame with evidence is drawn if its turn has come.
  void offer(const GridFrame& frame);

  // Draws the frame, if it has not been, and writes it as map.pgm and map.yaml.
  void write_last(const GridFrame& frame);

  // Removes the pictures of an earlier run, if this run has no frame.
  void write_none() const;

 private:
  void draw(const GridFrame& frame);

  PictureOptions options_;
  std::optional<PictureFolder> folder_;
  std::uint64_t next_ = 0;
  bool has_drawn_ = false;
  std::uint64_t last_drawn_ = 0;
};

// --scale and --radius; with --out and --every; what stands below them in --help.
void add_scale_options(CLI::App& command, PictureScale& scale);
void add_picture_options(CLI::App& command, PictureOptions& options);
inline constexpr const char* kPictureFooter =
    "Pictures show the car from above, with x (forward) up, y to the left and rings at "
    "the distances that they state. Pale blue is free, orange to red is occupied, and dark is "
    "unknown. A stronger colour is a "
    "stronger index.\n"
    "Occupied cells are drawn at least 3 pixels wide. map.pgm and map.yaml contain the last frame "
    "of whole scans for ROS map_server, with x to the right and y up. classes_NNNNNN.png shows the "
    "perception grid in the world, with x to the right, y up, the car's outline and a scale bar.\n";

}  // namespace iog::tools
