// A file that is played: from its beginning, and from wherever a page asks.
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "tools/formats/capture/capture_clock.hpp"
#include "tools/formats/capture/file_hint.hpp"
#include "tools/identity/capture_identity.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/progress.hpp"
#include "tools/record/stream_file.hpp"
#include "tools/replay/pace.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "tools/view/sensor_target.hpp"
#include "tools/view/sources.hpp"

namespace iog::tools::view {
namespace {

constexpr std::chrono::milliseconds kTendAfter{50};

// Before the place that a page asks for so much is taken without being waited for: a target decides
// each tile of a stream anew within eight frames, and of scans it has to find out what stands.
constexpr std::uint64_t kLeadOfStreamUs = 1'000'000;
constexpr std::uint64_t kLeadOfScansUs = 3'000'000;

// An hour has so 3,600 marks, and a jump reads a second that it does not show.
constexpr std::uint64_t kBetweenMarksUs = 1'000'000;

// The datagrams of a file that can be shown: of a vehicle's sensors, and of a target's stream.
class ShownFile {
 public:
  ShownFile(const RecordingOptions& options, const CatalogueEntry& car)
      : car_(&car), port_(options.port) {
    if (std::ranges::count(options.drive.captures, "-") > 0) {
      throw UsageError("-: the view plays a capture again and again: give a file");
    }
    if (is_mcap_file(options.drive.captures[0])) {
      if (options.drive.captures.size() > 1 || !options.drive.poses.empty()) {
        throw UsageError(
            options.drive.name() +
            ": an MCAP file of `iog record` is shown alone, without --poses. For a bag of ROS 2" +
            hint_of_ros());
      }
      stream_ = std::make_unique<StreamFile>(options.drive.captures[0]);
    } else {
      capture_ = std::make_unique<CarCapture>(options.drive, car);
    }
  }

  // others: who is told of those that cannot be shown; may be null.
  [[nodiscard]] std::optional<CapturedDatagram> next(CaptureIdentity* others = nullptr) {
    if (stream_) {
      return stream_->next();
    }
    while (std::optional<CapturedDatagram> datagram = capture_->next()) {
      if (is_of_car(*datagram) || datagram->destination.port == port_) {
        return datagram;
      }
      if (others != nullptr) {
        others->add(*datagram);
      }
    }
    return std::nullopt;
  }

  // An MCAP file of ours has a stream only.
  [[nodiscard]] bool is_of_car(const CapturedDatagram& datagram) const {
    return capture_ && takes_port(*car_, datagram.destination.port);
  }
  [[nodiscard]] bool is_mcap() const { return stream_ != nullptr; }

  // As of StreamFile.
  [[nodiscard]] std::optional<StreamFile::Place> place() const {
    return stream_ ? stream_->place() : capture_->place();
  }
  void go_to(const StreamFile::Place& place) {
    if (stream_) {
      stream_->go_to(place);
    } else {
      capture_->go_to(place);
    }
  }

  [[nodiscard]] std::optional<double> part_read() const {
    return stream_ ? stream_->part_read() : capture_->files().part_read();
  }

  // On stderr, when all has been read.
  void warn(const DriveFiles& drive) const {
    if (capture_) {
      warn_of(drive, *capture_);
    } else {
      stream_->warn(drive.name());
    }
  }

 private:
  const CatalogueEntry* car_;
  std::uint16_t port_;
  std::unique_ptr<CarCapture> capture_;
  std::unique_ptr<StreamFile> stream_;
};

class RecordingSource : public Source {
 public:
  explicit RecordingSource(const RecordingOptions& options)
      : options_(options),
        car_(&find_vehicle(options.vehicle)),
        file_(std::make_unique<ShownFile>(options_, *car_)) {
    CaptureIdentity others;
    const std::optional<CapturedDatagram> first = file_->next(&others);
    if (!first) {
      throw UsageError(options_.drive.name() +
                       (file_->is_mcap()
                            ? ": no stream of a target in it; `iog record` writes one, "
                              "with the topic /iogrid/messages. For a bag of ROS 2" +
                                  hint_of_ros()
                            : ": no grid to port " + std::to_string(options_.port) + ", and " +
                                  others.refusal(*car_)));
    }
    is_of_target_ = !file_->is_of_car(*first);
    if (!is_of_target_) {
      demand_fit(options_.drive.captures, *car_);
    }
    find_span(*first);
  }

  [[nodiscard]] std::string kind() const override {
    return is_of_target_ ? "recording" : "capture";
  }

  void run(Viewer& viewer) override {
    viewer.note_span(span_us_ / 1000);
    // A short recording would be over before anybody has opened the page.
    while (!viewer.is_watched() && !was_interrupted()) {
      rest(viewer);
    }
    play(viewer, 0);
    while (!was_interrupted()) {
      if (!jump_us_ && !options_.loops) {
        stay_at_end(viewer);
      }
      if (!was_interrupted()) {
        begin_again(viewer);
      }
    }
  }

 private:
  static void rest(Viewer& viewer) {
    viewer.tend();
    std::this_thread::sleep_for(kTendAfter);
  }

  // How long the file is, which nobody knows before all of it has been read, and its marks.
  void find_span(const CapturedDatagram& first) {
    Progress progress("datagrams");
    std::uint64_t count = 1;
    first_us_ = first.time_us;
    std::optional<CapturedDatagram> datagram;
    while (!was_interrupted() && (datagram = file_->next())) {
      span_us_ = std::max(span_us_, since_first(*datagram));
      progress.show(++count, file_->part_read());
      if (marks_.empty() || span_us_ >= marks_.back().longest_us + kBetweenMarksUs) {
        if (const auto place = file_->place()) {
          marks_.push_back({.longest_us = span_us_, .place = *place});
        }
      }
    }
    if (!was_interrupted()) {
      file_->warn(options_.drive);
    }
  }

  // The first datagram that was so long after the first one or longer, by reading on from the last
  // mark before it, or from the beginning.
  [[nodiscard]] std::optional<CapturedDatagram> find(std::uint64_t wanted_us) {
    const auto behind = std::ranges::partition_point(
        marks_, [&](const Mark& mark) { return mark.longest_us < wanted_us; });
    if (behind == marks_.begin()) {
      file_ = std::make_unique<ShownFile>(options_, *car_);
    } else {
      file_->go_to(std::prev(behind)->place);
    }
    std::optional<CapturedDatagram> datagram = file_->next();
    while (datagram && since_first(*datagram) < wanted_us) {
      datagram = file_->next();
    }
    return datagram;
  }

  // A capture may run backwards.
  [[nodiscard]] std::uint64_t since_first(const CapturedDatagram& datagram) const {
    return datagram.time_us - std::min(datagram.time_us, first_us_);
  }

  // Tends the viewer; true if it is time to do something else.
  [[nodiscard]] bool is_called_away(Viewer& viewer) {
    viewer.tend();
    if (const std::optional<std::uint64_t> place_ms = viewer.take_jump()) {
      jump_us_ = *place_ms * 1000;
    }
    return jump_us_ || was_interrupted();
  }

  // The last whole picture stays, and says that it is the last one.
  void stay_at_end(Viewer& viewer) {
    if (target_) {
      target_->finish();
    }
    viewer.note_end();
    while (!is_called_away(viewer)) {
      std::this_thread::sleep_for(kTendAfter);
    }
  }

  // Another round, which begins one frame after the last one's end, or from where a page has asked.
  void begin_again(Viewer& viewer) {
    const std::uint64_t from_us = jump_us_.value_or(0);
    if (jump_us_ || is_of_target_) {
      viewer.begin_again();
    }
    if (jump_us_) {
      target_.reset();
      jump_us_.reset();
    }
    round_start_us_ = now_us_ + car_->vehicle->frame_period_us;
    play(viewer, from_us);
  }

  void play(Viewer& viewer, std::uint64_t from_us) {
    const std::uint64_t lead_us = is_of_target_ ? kLeadOfStreamUs : kLeadOfScansUs;
    CaptureClock clock;
    Pace pace(options_.speed);
    std::optional<CapturedDatagram> datagram = find(from_us - std::min(from_us, lead_us));
    now_us_ = round_start_us_;
    while (datagram && !is_called_away(viewer)) {
      const std::uint64_t place_us = since_first(*datagram);
      const std::uint64_t time_us = round_start_us_ + clock.move_to(datagram->time_us);
      const bool is_lead = place_us < from_us;
      if (time_us > now_us_ + FrameAssembler::kLongestSilenceUs) {
        wait(is_lead ? nullptr : &pace, now_us_ + FrameAssembler::kLongestSilenceUs, viewer);
        viewer.note_gap();
      }
      wait(is_lead ? nullptr : &pace, time_us, viewer);
      if (jump_us_) {
        return;
      }
      viewer.note_place(place_us / 1000);
      datagram->time_us = time_us;
      show(*datagram, viewer);
      datagram = file_->next();
    }
  }

  // In steps, because pages ask for things in a silence, too. pace: null if nobody waits.
  void wait(Pace* pace, std::uint64_t time_us, Viewer& viewer) {
    const auto step_us = static_cast<std::uint64_t>(
        std::max(1.0, options_.speed * std::chrono::microseconds(kTendAfter).count()));
    while (pace != nullptr && now_us_ + step_us < time_us) {
      now_us_ += step_us;
      pace->wait_for(now_us_);
      if (is_called_away(viewer)) {
        return;
      }
    }
    now_us_ = time_us;
    if (pace != nullptr) {
      pace->wait_for(now_us_);
    }
  }

  void show(const CapturedDatagram& datagram, Viewer& viewer) {
    if (!file_->is_of_car(datagram)) {
      viewer.take(datagram.payload);
      return;
    }
    if (!target_) {
      target_ = std::make_unique<SensorTarget>(*car_, viewer);
    }
    target_->take(datagram, nullptr);
  }

  // A place in the file, before which no datagram was longer after the first one.
  struct Mark {
    std::uint64_t longest_us;
    StreamFile::Place place;
  };

  RecordingOptions options_;
  const CatalogueEntry* car_;
  std::unique_ptr<ShownFile> file_;
  std::vector<Mark> marks_;    // none of a file that is read from its beginning only
  bool is_of_target_ = false;  // a recorded stream
  std::uint64_t first_us_ = 0;
  std::uint64_t span_us_ = 0;
  std::unique_ptr<SensorTarget> target_;
  std::optional<std::uint64_t> jump_us_;  // to where a page has asked
  std::uint64_t round_start_us_ = 0;
  std::uint64_t now_us_ = 0;
};

}  // namespace

std::unique_ptr<Source> make_recording_source(const RecordingOptions& options) {
  return std::make_unique<RecordingSource>(options);
}

}  // namespace iog::tools::view
