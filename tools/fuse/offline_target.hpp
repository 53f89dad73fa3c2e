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
#include <variant>
#include <vector>

#include "app/pipeline.hpp"
#include "stream/message.hpp"
#include "tools/formats/capture/capture_clock.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/program/large_pages.hpp"
#include "vehicle/vehicle.hpp"
#include "work/round.hpp"

namespace iog::tools {

using MessageHandler = std::function<void(std::span<const std::byte>)>;

// Whether the times in the messages are measured here, or all 0: the same capture gives the same
// messages then.
enum class Stopwatch : std::uint8_t { kRuns, kStands };

// What the pipeline meets on a PC instead of a network and a stopwatch (app::Platform).
class OfflinePlatform {
 public:
  OfflinePlatform(MessageHandler on_message, Stopwatch stopwatch, std::uint32_t run_number)
      : on_message_(std::move(on_message)), stopwatch_(stopwatch), run_number_(run_number) {}

  [[nodiscard]] bool send_message(std::span<const std::byte> message);
  [[nodiscard]] std::uint32_t ticks() const;
  [[nodiscard]] std::uint32_t ticks_hz() const { return 1'000'000; }
  [[nodiscard]] static app::Vitals vitals(const app::FrameTimes& /*times*/) { return {}; }
  [[nodiscard]] std::uint32_t run_number() const { return run_number_; }
  static constexpr std::size_t kMostCores = 1;
  [[nodiscard]] std::size_t cores() const { return kMostCores; }
  void share(std::size_t items, work::Work work, work::Beside beside = {}) {
    work::do_alone(items, work, beside);
  }

  // Since the start.
  [[nodiscard]] std::uint64_t frames_ended() const { return frames_ended_; }
  // Frames with evidence that have left since the last call.
  [[nodiscard]] unsigned take_evidence_frames() { return std::exchange(evidence_frames_, 0U); }

 private:
  MessageHandler on_message_;
  Stopwatch stopwatch_;
  std::uint32_t run_number_;
  unsigned evidence_frames_ = 0;
  std::uint64_t frames_ended_ = 0;
};

class OfflineTarget {
 public:
  // Frames with evidence that one datagram has closed.
  struct Closed {
    unsigned before = 0;  // they hold the datagrams before this one
    unsigned after = 0;   // they hold this one, too
  };

  // The same capture gives the same messages, so its run always has the same number, unless
  // somebody gives it another.
  static constexpr std::uint32_t kRunNumber = 1;

  // vehicle outlives the target. on_message is called for each message that it would send. With raw
  // coding, the messages are longer than those of a target, but contain the same frames, and cost
  // less. UsageError, with the reason, if the vehicle asks for classes and can have none.
  OfflineTarget(const vehicle::Vehicle& vehicle, MessageHandler on_message,
                Stopwatch stopwatch = Stopwatch::kRuns, std::uint32_t run_number = kRunNumber,
                app::Coding coding = app::Coding::kShortest);
  OfflineTarget(const OfflineTarget&) = delete;
  OfflineTarget& operator=(const OfflineTarget&) = delete;

  // Before the first datagram: the map that the target has from the start. UsageError if the
  // vehicle has no classes and so no use for one.
  void begin_with_map(std::vector<std::uint8_t> block);

  // The next datagram of the capture, of a sensor or of the poses. Lets the frames that are over by
  // its time close first.
  Closed take(const CapturedDatagram& datagram);

  [[nodiscard]] const vehicle::Vehicle& vehicle() const { return *vehicle_; }
  // By which it judges the packets of the open frame.
  [[nodiscard]] const ground::Grounds& grounds() const {
    return std::visit(
        [](const auto& pipeline) -> const ground::Grounds& { return pipeline->grounds(); },
        pipeline_);
  }

  // The same by a target's clock instead of the capture's: when it started; the next datagram,
  // taken then, or left for want of time; that time has passed, which ends a frame that is over.
  void start(std::uint64_t now_us);
  void take_at(const CapturedDatagram& datagram, std::uint64_t now_us, bool is_left);
  void pass(std::uint64_t now_us);
  // Whether they have evidence or not.
  [[nodiscard]] std::uint64_t frames_ended() const { return platform_.frames_ended(); }

  // The capture is over: lets its last frame time out, if one is open or has drops to report.
  void finish();

 private:
  static constexpr std::uint32_t kReplayer = 0x0A000202;

  using Indexes = app::Pipeline<OfflinePlatform>;
  using Classes = app::PerceptionPipeline<OfflinePlatform>;
  using AnyPipeline = std::variant<Large<Indexes>, Large<Classes>>;

  // As its replayer sends it. The capture's datagram outlives it.
  [[nodiscard]] static intake::Datagram datagram_of(const CapturedDatagram& captured);
  [[nodiscard]] AnyPipeline pipeline_of(const vehicle::Vehicle& vehicle, app::Coding coding);
  [[nodiscard]] std::uint64_t deadline_us() const;
  void close_overdue();

  const vehicle::Vehicle* vehicle_;
  OfflinePlatform platform_;
  CaptureClock clock_;
  bool is_open_ = false;
  std::vector<std::uint8_t> map_;
  AnyPipeline pipeline_;
};

}  // namespace iog::tools
