// The first pass over a capture: the firmware's own pipeline, instructions by stage and frame.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "app/pipeline.hpp"
#include "measured_platform.hpp"
#include "playback.hpp"
#include "stream/crc32.hpp"

namespace iog::lab {

// What a number of frames cost: all together, the cheapest, the dearest.
struct Spread {
  std::uint64_t sum = 0;
  std::uint32_t smallest = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t largest = 0;

  void add(std::uint32_t value);
};

class StagePass {
 public:
  StagePass(const vehicle::Vehicle& vehicle, InstructionCounter& counter, app::Coding coding)
      : vehicle_(vehicle), coding_{coding}, platform_(counter) {
    renew(0);
  }

  void take(const vehicle::Sensor& sensor, const intake::Datagram& datagram, std::uint32_t received,
            std::uint64_t now_us);
  void tick(std::uint64_t now_us);
  [[nodiscard]] std::uint64_t deadline_us() const { return pipeline_->deadline_us(); }

  // Frames with evidence, and what they had: scan points with any fate, those used, messages, tiles
  // in which something is known.
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  [[nodiscard]] std::uint64_t packets() const { return packets_; }
  [[nodiscard]] std::uint64_t points() const { return points_; }
  [[nodiscard]] std::uint64_t points_used() const { return points_used_; }
  [[nodiscard]] std::uint64_t tiles() const { return tiles_; }
  [[nodiscard]] const MeasuredPlatform& platform() const { return platform_; }

  // Their instructions. Receiving is charged to the frame that closes next.
  [[nodiscard]] const Spread& receive() const { return receive_; }
  [[nodiscard]] const Spread& fuse() const { return fuse_; }
  [[nodiscard]] const Spread& mark() const { return mark_; }
  [[nodiscard]] const Spread& publish() const { return publish_; }
  [[nodiscard]] const Spread& whole() const { return whole_; }

  // As `iog fuse` computes it: CRC-32 over the frames' grid CRCs.
  [[nodiscard]] std::uint32_t run_hash() const { return run_hash_.value(); }

  // The firmware's, of one core for good.
  struct OneCore : MeasuredPlatform {
    static constexpr std::size_t kMostCores = 1;
    using MeasuredPlatform::MeasuredPlatform;
  };
  using Pipeline = app::Pipeline<OneCore>;

  // Another pipeline in place of this one, which knows nothing of the frames before, such as the
  // lines that a core keeps. Between two frames; the model does not see it.
  void renew(std::uint64_t now_us);

 private:
  // What is known of a frame before its publishing is.
  struct OpenCost {
    bool has_evidence = false;
    std::uint32_t receive = 0;
    std::uint32_t fuse = 0;
    std::uint32_t mark = 0;
  };

  void collect();
  // Bookkeeping of the benchmark alone: a stage of its own for the model.
  [[gnu::noinline]] void add_end(std::span<const std::byte> message);

  const vehicle::Vehicle& vehicle_;
  app::Coding coding_;
  OneCore platform_;
  std::uint64_t frames_ = 0;
  std::uint64_t packets_ = 0;
  std::uint64_t points_ = 0;
  std::uint64_t points_used_ = 0;
  std::uint64_t tiles_ = 0;
  Spread receive_;
  Spread fuse_;
  Spread mark_;
  Spread publish_;
  Spread whole_;
  stream::Crc32 run_hash_;
  std::uint32_t received_ = 0;  // since the last frame closed
  OpenCost before_;             // the frame that closed last
  std::optional<Pipeline> pipeline_;
};

}  // namespace iog::lab
