// A pass over a drive with poses: the pipeline of the perception grid, instructions by frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "app/pipeline.hpp"
#include "measured_platform.hpp"
#include "playback.hpp"
#include "stage_pass.hpp"
#include "stream/crc32.hpp"
#include "window/window_view.hpp"

namespace iog::lab {

// What the frames did. Frames without a placed slice do not count.
struct PerceptionCounts {
  std::uint64_t frames = 0;
  std::uint64_t points = 0;  // whatever their fate
  std::uint64_t slices = 0;
  std::uint64_t groups_fused = 0;
  std::uint64_t groups_left = 0;
  std::uint64_t groups_refreshed = 0;
  std::uint32_t most_groups = 0;  // fused in a frame
  std::uint64_t tiles = 0;        // in which a cell has a class
};

// The last sink of the pipeline. What it does is the benchmark's own.
class ClassLog {
 public:
  explicit ClassLog(InstructionCounter& counter) : counter_(counter) {}

  void begin_frame(const stream::Header& header) {
    has_evidence_ = header.packets_fused > 0;
    points_ = header.points_used + header.points_other;
  }
  void take_tile(std::size_t /*tile*/, tile_coding::TileCells /*cells*/) {}
  void end_frame() {}
  [[gnu::noinline]] void take_classes(const stream::ClassEnd& end,
                                      const window::WindowView& classes);

  [[nodiscard]] const PerceptionCounts& counts() const { return counts_; }
  // As `iog fuse` computes it: CRC-32 over the CRCs of the classes of frames with evidence.
  [[nodiscard]] std::uint32_t run_hash() const { return run_hash_.value(); }

  // Frames that have closed since the last call, and the instructions of the log itself.
  [[nodiscard]] unsigned take_closed() { return std::exchange(closed_, 0U); }
  [[nodiscard]] std::uint32_t take_instructions() { return std::exchange(instructions_, 0U); }

 private:
  InstructionCounter& counter_;
  PerceptionCounts counts_;
  stream::Crc32 run_hash_;
  bool has_evidence_ = false;  // the frame at hand
  std::uint32_t points_ = 0;   // its points
  unsigned closed_ = 0;
  std::uint32_t instructions_ = 0;
};

class PerceptionPass {
 public:
  PerceptionPass(const vehicle::Vehicle& vehicle, InstructionCounter& counter, std::size_t cores)
      : counter_(counter),
        platform_(counter, cores),
        log_(counter),
        pipeline_(vehicle, kReplayer, platform_, log_) {}
  PerceptionPass(const PerceptionPass&) = delete;
  PerceptionPass& operator=(const PerceptionPass&) = delete;

  // Target of play_ports().
  void take(const intake::Datagram& datagram, std::uint32_t received, std::uint64_t now_us);
  void tick(std::uint64_t now_us);
  [[nodiscard]] std::uint64_t deadline_us() const { return pipeline_.deadline_us(); }

  [[nodiscard]] const PerceptionCounts& counts() const { return log_.counts(); }
  // Instructions of a frame. Receiving is charged to the frame that closes next.
  [[nodiscard]] const Spread& whole() const { return whole_; }
  [[nodiscard]] std::uint32_t run_hash() const { return log_.run_hash(); }
  [[nodiscard]] std::uint64_t sent_bytes() const { return platform_.sent_bytes(); }
  [[nodiscard]] SharedRounds& shared() { return platform_.shared(); }

  using Pipeline = app::PerceptionPipeline<MeasuredPlatform, ClassLog>;

 private:
  void end_call(std::uint32_t instructions);

  InstructionCounter& counter_;
  MeasuredPlatform platform_;
  ClassLog log_;
  Spread whole_;
  std::uint32_t spent_ = 0;  // on the frame that closes next
  Pipeline pipeline_;
};

}  // namespace iog::lab
