// The serial link as a sink: as much of the newest frame as it can carry.
#pragma once

#include <cstddef>
#include <cstdint>

#include "app/platform.hpp"
#include "hal/serial_port.hpp"
#include "serial/grid_sender.hpp"
#include "stream/message.hpp"

namespace iog::app {

// Holds 64 KB: belongs into static memory.
class SerialSink {
 public:
  void begin_frame(const stream::Header& header) { sender_.begin_frame(header); }
  void take_tile(std::size_t tile, tile_coding::TileCells cells) { sender_.take_tile(tile, cells); }
  void end_frame() { sender_.end_frame(); }

  // Once per pass of the loop.
  template <hal::SerialPort Port>
  void pump(std::uint64_t now_us, Port& port) {
    sender_.pump(now_us, port);
  }

 private:
  serial::GridSender sender_;
};

}  // namespace iog::app
