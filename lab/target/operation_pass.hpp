// The second pass over a capture: what fusing and publishing consist of. They are taken apart where
// the interfaces of the core allow it, and the cells that beams carve are counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "app/frame.hpp"
#include "fusion/frame_fusion.hpp"
#include "instruction_counter.hpp"
#include "lidar/scan_point.hpp"
#include "playback.hpp"
#include "stream/grid_hash.hpp"

namespace iog::lab {

// Instructions and counts of a whole run, without those of the counter.
struct OperationCost {
  std::uint64_t inspect = 0;  // decode and check a packet, find its place in the frame
  std::uint64_t decode = 0;   // the part of it that src/lidar does
  std::uint64_t fuse = 0;     // what comes after: its points into the grid
  std::uint64_t aim = 0;      // the part of it that finds the line of a beam
  std::uint64_t judge = 0;    // the part of it that decides what a point is good for
  std::uint64_t points = 0;
  std::uint64_t cells = 0;  // changed by carving, a cell counted once for each beam
  std::uint64_t find = 0;   // of publishing: find the tiles in which something is known
  std::uint64_t hash = 0;   // of publishing: copy those and add them to the grid's CRC
  std::uint64_t clear = 0;  // of publishing: set them back to unknown
};

class OperationPass {
 public:
  OperationPass(const vehicle::Vehicle& vehicle, InstructionCounter& counter)
      : counter_(counter), frame_(vehicle, kReplayer), single_(vehicle) {}

  void take(const vehicle::Sensor& sensor, const intake::Datagram& datagram, std::uint32_t received,
            std::uint64_t now_us);
  void tick(std::uint64_t now_us);
  [[nodiscard]] std::uint64_t deadline_us() const { return frame_.deadline_us(); }

  [[nodiscard]] const OperationCost& cost() const { return cost_; }

 private:
  // Adds to `sum` the instructions of `work`, and returns what it returns.
  template <typename Work>
  auto measured(std::uint64_t& sum, Work&& work);

  void close_frame(std::uint64_t now_us);
  void take_tile_apart(std::size_t tile, stream::GridHash& hash);
  void take_apart(const vehicle::Sensor& sensor, std::span<const std::byte> payload);
  void take_apart(const vehicle::Sensor& sensor, const lidar::ScanPoint& point);
  [[nodiscard]] std::uint32_t carved_cells(const vehicle::Sensor& sensor, const vehicle::Beam& beam,
                                           const lidar::ScanPoint& point);

  InstructionCounter& counter_;
  OperationCost cost_;
  app::Frame frame_;
  fusion::FrameFusion single_;  // of one point at a time
};

}  // namespace iog::lab
