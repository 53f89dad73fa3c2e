#include "tools/record/picture_recording.hpp"

#include <filesystem>

#include "tools/formats/picture/ros_map.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {

PictureRecording::PictureRecording(const PictureOptions& options, bool with_maps)
    : options_(options), with_maps_(with_maps), pictures_(options, true) {}

void PictureRecording::take_frame(const RecordedFrame& recorded) {
  const GridFrame& frame = *recorded.frame;
  if (!frame.header.has_evidence()) {
    return;
  }
  pictures_.offer(frame);
  if (with_maps_ && frame.header.has_indexes() && frame.evidence_number % options_.every == 0) {
    const std::string base =
        std::filesystem::path(numbered("", "map", frame.evidence_number, "")).filename();
    write_ros_map(options_.folder, base, {.cells = cells_in_grid(frame), .grid = frame.shape});
  }
  last_ = frame;
}

void PictureRecording::finish(const Facts& /*facts*/) {
  if (last_) {
    pictures_.write_last(*last_);
  } else {
    pictures_.write_none();
  }
}

}  // namespace iog::tools
