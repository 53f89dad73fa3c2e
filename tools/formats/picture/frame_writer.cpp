#include "tools/formats/picture/frame_writer.hpp"

#include "tools/formats/picture/class_picture.hpp"
#include "tools/formats/picture/ros_map.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {

FrameWriter::FrameWriter(const PictureOptions& options, bool with_maps) : options_(options) {
  if (!options_.folder.empty()) {
    folder_.emplace(options_.folder, with_maps);
  }
}

void FrameWriter::draw(const GridFrame& frame) {
  if (!has_drawn_) {
    write_none();
  }
  const std::uint64_t number = frame.evidence_number;
  if (frame.header.has_indexes()) {
    picture_of(frame, options_.scale).write_png(numbered(options_.folder, "frame", number, ".png"));
  }
  if (frame.classes) {
    picture_of(*frame.classes, title_of(frame), options_.scale)
        .write_png(numbered(options_.folder, "classes", number, ".png"));
  }
  has_drawn_ = true;
  last_drawn_ = frame.evidence_number;
}

void FrameWriter::write_none() const {
  if (folder_) {
    folder_->clear();
  }
}

void FrameWriter::offer(const GridFrame& frame) {
  if (options_.folder.empty() || options_.every == 0 || !frame.header.has_evidence() ||
      frame.evidence_number < next_) {
    return;
  }
  next_ = (frame.evidence_number / options_.every + 1) * options_.every;
  draw(frame);
}

void FrameWriter::write_last(const GridFrame& frame) {
  if (options_.folder.empty()) {
    return;
  }
  if (!has_drawn_ || last_drawn_ != frame.evidence_number) {
    draw(frame);
  }
  if (!frame.header.has_indexes()) {
    return;
  }
  write_ros_map(options_.folder, "map", {.cells = cells_in_grid(frame), .grid = frame.shape});
}

}  // namespace iog::tools
