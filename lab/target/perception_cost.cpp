// perception_cost: what a frame with classes costs the Cortex-A9, in instructions. Runs in QEMU
// with instruction counting (lab/target/run_image); prints one line of key=value pairs.
//
//   perception_cost <capture with poses> [<frames> <frames before> [<cores>]]
//
// With a number of frames the pipeline runs over the frames before to warm up and then over so
// many: what the cost model of the Cortex-A9 is to see, which is told where each of them ends.
//
// With cores the pipeline divides its work as for so many, and one core does all of it, item by
// item. The model is told where each item ends, and the last line says how many items there were:
// `rounds=20,32,64,0` are three rounds of the cores and the end of a frame.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>

#include "capture.hpp"
#include "hal/cores.hpp"
#include "instruction_counter.hpp"
#include "lab/a9_model/marker.hpp"
#include "number_in.hpp"
#include "perception_pass.hpp"
#include "playback.hpp"
#include "pose/message.hpp"
#include "vehicles/cars.hpp"

namespace iog::lab {
namespace {

struct Request {
  const char* capture = nullptr;
  std::size_t frames = 0;  // 0: all
  std::size_t before = 0;
  std::size_t cores = 1;
};

// A target of play_ports() that ends the capture once so many frames are complete, and says to the
// model where they end. What the frames before cost is not reported.
class Rounds {
 public:
  Rounds(PerceptionPass& pass, Capture& capture, const Request& request)
      : pass_(pass), capture_(capture), before_(request.before), frames_(request.frames) {
    if (before_ > kCacheFrames) {
      a9_model::pause();
    }
  }

  void take(const intake::Datagram& datagram, std::uint32_t received, std::uint64_t now_us) {
    if (!is_over()) {
      pass_.take(datagram, received, now_us);
      look_for_end();
    }
  }
  void tick(std::uint64_t now_us) {
    if (!is_over()) {
      pass_.tick(now_us);
      look_for_end();
    }
  }
  [[nodiscard]] std::uint64_t deadline_us() const { return pass_.deadline_us(); }
  [[nodiscard]] bool is_over() const {
    return frames_ > 0 && pass_.counts().frames >= before_ + frames_;
  }

  // What the frames before had.
  [[nodiscard]] const PerceptionCounts& of_those_before() const { return of_those_before_; }

 private:
  // The frames before fill the window. The caches are warm after the last of them: with two of
  // twelve the cycles are those of all twelve within 0.2 %. So the model, which takes its time,
  // sees four.
  static constexpr std::size_t kCacheFrames = 4;

  void look_for_end() {
    if (frames_ == 0 || pass_.counts().frames == seen_) {
      return;
    }
    seen_ = pass_.counts().frames;
    if (seen_ + kCacheFrames == before_) {
      a9_model::resume();
    }
    if (seen_ == before_) {
      of_those_before_ = pass_.counts();
      pass_.shared().forget();
    } else if (seen_ > before_) {
      pass_.shared().end_frame();
    }
    if (is_over()) {
      capture_.close();
    }
  }

  PerceptionPass& pass_;
  Capture& capture_;
  std::size_t before_;
  std::size_t frames_;
  std::uint64_t seen_ = 0;
  PerceptionCounts of_those_before_;
};

void print(const char* key, std::uint64_t value) {
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
  std::printf(" %s=%llu", key, value);
}

void print_run(const PerceptionPass& pass, const Rounds& rounds) {
  const PerceptionCounts& counts = pass.counts();
  const PerceptionCounts& before = rounds.of_those_before();
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned int
  std::printf("perception_cost class_run_hash=%08lx", pass.run_hash());
  print("frames", counts.frames);
  print("points", counts.points);
  print("points_after", counts.points - before.points);
  print("slices", counts.slices);
  print("groups_fused", counts.groups_fused);
  print("groups_fused_after", counts.groups_fused - before.groups_fused);
  print("groups_left", counts.groups_left);
  print("groups_refreshed", counts.groups_refreshed);
  print("most_groups", counts.most_groups);
  print("class_tiles", counts.tiles);
  print("sent_bytes", pass.sent_bytes());
  print("group_budget", perception::kGroupBudget);
  print("budgeted_cycles", perception::kGroupCycles);
  print("pipeline_bytes", sizeof(PerceptionPass::Pipeline));
  print("window_bytes", perception::kWindowBytes);
  print("frame_sum", pass.whole().sum);
  print("frame_mean", (pass.whole().sum + counts.frames / 2) / counts.frames);
  print("frame_min", pass.whole().smallest);
  print("frame_max", pass.whole().largest);
  std::puts("");
}

void print_rounds(std::span<const std::uint16_t> rounds) {
  std::printf("perception_cost rounds=");
  const char* separator = "";
  for (const std::uint16_t items : rounds) {
    std::printf("%s%u", separator, unsigned{items});
    separator = ",";
  }
  std::puts("");
}

int run(const Request& request) {
  static InstructionCounter counter;
  static Capture capture;
  static PerceptionPass pass(vehicles::cars()[0].vehicle, counter, request.cores);
  counter.start();
  if (!counter.is_exact()) {
    std::puts("perception_cost: instructions are not counted; is this -icount shift=4,sleep=off?");
    return 1;
  }
  if (!capture.open(request.capture)) {
    std::printf("perception_cost: %s cannot be read as a pcap of Ethernet frames\n",
                request.capture);
    return 1;
  }
  Rounds rounds(pass, capture, request);
  const auto are_played = [](std::uint16_t port) {
    return port == pose::kPosePort || sensor_of_port(vehicles::cars()[0].vehicle, port) != nullptr;
  };
  play_ports(capture, are_played, counter, rounds);
  if (pass.counts().frames < request.before + request.frames || pass.counts().frames == 0) {
    std::puts("perception_cost: the capture has not so many frames with poses");
    return 1;
  }
  print_run(pass, rounds);
  if (request.cores > 1) {
    print_rounds(pass.shared().rounds());
  }
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  constexpr std::size_t kMostFrames = 10'000;
  iog::lab::Request request{.capture = argv[1]};
  bool is_right = argc == 2 || argc == 4 || argc == 5;
  if (argc >= 4) {
    request.frames = iog::lab::number_in(argv[2], kMostFrames);
    request.before = iog::lab::number_in(argv[3], kMostFrames);
    is_right = request.frames > 0 && request.before > 0;
  }
  if (argc == 5) {
    request.cores = iog::lab::number_in(argv[4], iog::hal::kMaxCores);
    is_right = is_right && request.cores > 0;
  }
  if (!is_right) {
    std::puts(
        "perception_cost: expected a capture with poses, a number of frames with the frames "
        "before, and cores");
    return 2;
  }
  return iog::lab::run(request);
}
