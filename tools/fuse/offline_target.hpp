// The target without the target: the same pipeline, fed by a capture and its clock.
//
// A capture stands for what its replayer sends: the sensors' real addresses are not compared, only
// their ports. Time is that of CaptureClock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "app/pipeline.hpp"
#include "stream/message.hpp"
#include "tools/formats/capture/capture_clock.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tools {

using MessageHandler = std::function<void(std::span<const std::byte>)>;

// Whether the times in the messages are measured here, or all 0: the same capture gives the same
// messages then.
enum class Stopwatch : std::uint8_t { kRuns, kStands };

// What the pipeline meets on a PC instead of a network and a stopwatch (app::Platform).
class OfflinePlatform {
 public:
  OfflinePlatform(MessageHandler on_message, Stopwatch stopwatch)
      : on_message_(std::move(on_message)), stopwatch_(stopwatch) {}

  [[nodiscard]] bool send_message(std::span<const std::byte> message);
  [[nodiscard]] std::uint32_t ticks() const;
  [[nodiscard]] std::uint32_t ticks_hz() const { return 1'000'000; }
  [[nodiscard]] app::Vitals vitals() const { return {}; }

  // Frames with evidence that have left since the last call.
  [[nodiscard]] unsigned take_evidence_frames() { return std::exchange(evidence_frames_, 0U); }

 private:
  MessageHandler on_message_;
  Stopwatch stopwatch_;
  unsigned evidence_frames_ = 0;
};

class OfflineTarget {
 public:
  // Frames with evidence that one datagram has closed.
  struct Closed {
    unsigned before = 0;  // they hold the datagrams before this one
    unsigned after = 0;   // they hold this one, too
  };

  // vehicle outlives the target. on_message is called for each message that it would send.
  OfflineTarget(const vehicle::Vehicle& vehicle, MessageHandler on_message,
                Stopwatch stopwatch = Stopwatch::kRuns);
  OfflineTarget(const OfflineTarget&) = delete;
  OfflineTarget& operator=(const OfflineTarget&) = delete;

  // The next datagram of the capture. Lets the frames that are over by its time close first.
  Closed take(const CapturedDatagram& datagram);

  // The capture is over: lets its last frame time out, if one is open or has drops to report.
  void finish();

 private:
  static constexpr std::uint32_t kReplayer = 0x0A000202;

  const vehicle::Vehicle* vehicle_;
  OfflinePlatform platform_;
  CaptureClock clock_;
  bool is_open_ = false;
  app::Pipeline<OfflinePlatform> pipeline_;
};

}  // namespace iog::tools
