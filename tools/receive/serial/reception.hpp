// iog receive --serial: the grid as far as a serial link carries it, counted and drawn.
#pragma once

#include <cstdint>
#include <string>

#include "tools/formats/picture/frame_writer.hpp"

namespace iog::tools {

struct SerialOptions {
  std::string path;
  unsigned baud = 115'200;
  double max_age_s = 5;
  std::string tiles;  // file

  // Those of iog receive.
  PictureOptions pictures;
  std::uint64_t frames = 0;
  double idle_timeout_s = 0;
  std::string summary;
};

// Until frames of such numbers have passed, or none with evidence for too long, or the other end
// closes, or somebody interrupts. UsageError as SerialInput; CheckFailed if nothing came.
void receive_serial(const SerialOptions& options);

}  // namespace iog::tools
