// A stream as a folder of pictures, one a frame, and maps for ROS map_server.
#pragma once

#include <optional>

#include "tools/formats/picture/frame_writer.hpp"
#include "tools/record/recording.hpp"

namespace iog::tools {

class PictureRecording : public Recording {
 public:
  // with_maps: a map for each picture, not only for the last frame. Makes the folder.
  PictureRecording(const PictureOptions& options, bool with_maps);

  void take_datagram(const CapturedDatagram& /*datagram*/) override {}
  void take_frame(const RecordedFrame& recorded) override;
  void finish(const Facts& facts) override;

 private:
  PictureOptions options_;
  bool with_maps_;
  FrameWriter pictures_;
  std::optional<GridFrame> last_;
};

}  // namespace iog::tools
