#include "tools/record/sources.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "tools/formats/capture/made_capture.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/fuse/scan_points.hpp"
#include "tools/map/block_file.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/progress.hpp"
#include "tools/program/time_of_day.hpp"
#include "tools/receive/frame_notes.hpp"
#include "tools/receive/udp_receiver.hpp"
#include "tools/record/stream_file.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLongestWait{100};

Endpoint endpoint_of(const LiveSource& source) {
  in_addr address{};
  inet_pton(AF_INET, source.bind.c_str(), &address);
  return {.ipv4 = ntohl(address.s_addr), .port = source.port};
}

class LiveRecording {
 public:
  LiveRecording(const LiveSource& source, Recorder& recorder)
      : source_(&source),
        recorder_(&recorder),
        receiver_(source.bind, source.port),
        destination_(endpoint_of(source)),
        notes_(source.notify),
        progress_("frames", source.frames) {}

  void run() {
    notes_.say_listening();
    while (!is_done() && !is_idle() && !receiver_.has_ended()) {
      UdpReceiver::Messages messages = receiver_.take(kLongestWait);
      const bool has_arrived = !messages.empty();
      for (UdpReceiver::Message& message : messages) {
        if (!is_done()) {
          recorder_->take({.time_us = message.time_us,
                           .source = kStreamSource,
                           .destination = destination_,
                           .payload = std::move(message.bytes)});
          if (recorder_->has_messages()) {
            recorder_->keep_beginning();
          }
          note_frames();
        }
      }
      note_arrival(has_arrived);
    }
    if (recorder_->datagrams() > 0 && !recorder_->has_messages()) {
      throw CheckFailed(std::to_string(recorder_->datagrams()) +
                        " datagrams came, but no message of a target, and nothing is written");
    }
    if (recorder_->datagrams() == 0) {
      throw CheckFailed(words_of_silence(source_->bind, source_->port, Clock::now() - begin_,
                                         ", and nothing is written"));
    }
  }

  [[nodiscard]] std::uint64_t overflow() const { return receiver_.overflow(); }

 private:
  [[nodiscard]] bool is_done() const { return source_->frames > 0 && frames_ >= source_->frames; }

  [[nodiscard]] bool is_idle() const {
    const std::chrono::duration<double> silent = Clock::now() - last_frame_;
    return source_->idle_timeout_s > 0 && silent.count() > source_->idle_timeout_s;
  }

  void note_frames() {
    const RunStatistics& statistics = recorder_->census().statistics();
    notes_.say_frames(statistics);
    if (statistics.records().size() > frames_) {
      frames_ = statistics.records().size();
      last_frame_ = Clock::now();
    }
    progress_.show(frames_);
  }

  void note_arrival(bool has_arrived) {
    const auto now = Clock::now();
    if (has_arrived) {
      last_arrival_ = now;
    } else if (now - last_arrival_ > FrameAssembler::kLongestSilence) {
      recorder_->note_silence(time_of_day_us());
      note_frames();
      last_arrival_ = now;
    }
  }

  const LiveSource* source_;
  Recorder* recorder_;
  UdpReceiver receiver_;
  Endpoint destination_;
  FrameNotes notes_;
  Progress progress_;
  std::size_t frames_ = 0;  // with evidence
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_frame_ = begin_;
  Clock::time_point last_arrival_ = Clock::now();
};

// The target in this process, whose messages are recorded with the scan points that they are of.
class CapturedTarget {
 public:
  CapturedTarget(const CatalogueEntry& car, Recorder& recorder)
      : recorder_(&recorder),
        target_(
            *car.vehicle,
            [this](auto message) { messages_.emplace_back(message.begin(), message.end()); },
            Stopwatch::kStands) {
    if (recorder.wants_points()) {
      points_.emplace(car, target_);
    }
  }

  void begin_with_map(const std::string& path) { target_.begin_with_map(read_block(path)); }

  // Frames that the packet has closed without being in them hold the points before it.
  void take(const CapturedDatagram& packet) {
    time_us_ = packet.time_us;
    const std::uint64_t first = recorder_->evidence_frames();
    std::vector<SeenPoint> points;
    const OfflineTarget::Closed closed =
        points_ ? points_->take(packet, points) : target_.take(packet);
    for (const std::vector<std::byte>& message : std::exchange(messages_, {})) {
      if (recorder_->evidence_frames() == first + closed.before) {
        recorder_->add_points(std::exchange(points, {}));
      }
      record(message);
    }
    recorder_->add_points(points);
  }

  void finish() {
    target_.finish();
    for (const std::vector<std::byte>& message : std::exchange(messages_, {})) {
      record(message);
    }
  }

 private:
  void record(const std::vector<std::byte>& message) {
    recorder_->take(datagram_of_stream(time_us_, message));
  }

  Recorder* recorder_;
  std::uint64_t time_us_ = 0;
  std::vector<std::vector<std::byte>> messages_;
  OfflineTarget target_;
  std::optional<ScanPoints> points_;
};

}  // namespace

std::uint64_t record_live(const LiveSource& source, Recorder& recorder) {
  LiveRecording recording(source, recorder);
  recording.run();
  return recording.overflow();
}

void record_capture(const DriveFiles& drive, const std::string& vehicle, const std::string& map,
                    Recorder& recorder) {
  const CatalogueEntry& car = find_vehicle(vehicle);
  CarCapture capture(drive, car);
  const auto target = std::make_unique<CapturedTarget>(car, recorder);  // too large for the stack
  if (!map.empty()) {
    target->begin_with_map(map);
  }
  Progress progress("packets");
  std::optional<CapturedDatagram> datagram;
  while (!was_interrupted() && (datagram = capture.next())) {
    if (takes_port(car, datagram->destination.port)) {
      target->take(*datagram);
    }
    progress.show(capture.files().datagrams(), capture.files().part_read());
  }
  target->finish();
  warn_of(drive, capture);
  if (recorder.census().statistics().records().empty() && !was_interrupted()) {
    throw UsageError(drive.name() + ": no frame has evidence: what came to the ports of " +
                     vehicle + " holds no scan of its sensors");
  }
}

void record_stream(const std::string& path, Recorder& recorder) {
  StreamFile file(path);
  Progress progress("messages");
  std::optional<CapturedDatagram> datagram;
  std::uint64_t last_us = 0;  // before the first one no silence can be
  while (!was_interrupted() && (datagram = file.next())) {
    if (last_us != 0 && datagram->time_us > last_us + FrameAssembler::kLongestSilenceUs) {
      recorder.note_gap();
    }
    last_us = std::max(last_us, datagram->time_us);
    recorder.take(*datagram);
    progress.show(recorder.datagrams(), file.part_read());
  }
  if (recorder.datagrams() == 0 && !was_interrupted()) {
    throw UsageError(path + ": no message of a target in it");
  }
  if (!was_interrupted()) {
    file.warn(path);
  }
}

}  // namespace iog::tools
