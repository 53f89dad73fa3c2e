// frame_cost: what a frame costs the Cortex-A9, in instructions, by stage. Runs in QEMU with
// instruction counting (lab/target/run_image); prints one line of key=value pairs.
//
//   frame_cost <capture> [<coding> [<sensors> [stages | <frames> <paths> <frames before>]]]
//
// The coding is how tiles are sent: "shortest", as the firmware does and as without it, or "raw".
// Sensors are the number of them, the first ones of the description. With "stages" these are not
// taken apart into operations, which takes many times longer, as each point is fused by itself.
// With a number of frames only the firmware's own pipeline runs, over the frames before to warm up
// and then over so many: what the cost model of the Cortex-A9, which takes its time, is to see.
// Paths are what the core keeps of a line from frame to frame: "kept", or "forgotten" after every
// frame.
//
// The core is the firmware's own, object by object, and so is the memcpy() beneath it. What is not
// here are the driver of the Ethernet controller, the loop around the pipeline, and caches, which
// QEMU does not have.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "capture.hpp"
#include "ethernet/enet.hpp"
#include "instruction_counter.hpp"
#include "lab/a9_model/marker.hpp"
#include "number_in.hpp"
#include "operation_pass.hpp"
#include "playback.hpp"
#include "stack_paint.hpp"
#include "stage_pass.hpp"
#include "vehicles/cars.hpp"

namespace iog::lab {
namespace {

void print(const char* key, std::uint64_t value, const char* suffix = "") {
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
  std::printf(" %s%s=%llu", key, suffix, value);
}

void print_stage(const char* name, const Spread& spread, std::uint64_t frames) {
  print(name, spread.sum, "_sum");
  print(name, (spread.sum + frames / 2) / frames, "_mean");
  print(name, spread.smallest, "_min");
  print(name, spread.largest, "_max");
}

void print_stages(const StagePass& pass) {
  print("frame_period_us", vehicles::cars()[0].vehicle.frame_period_us);
  print("frames", pass.frames());
  print("packets", pass.packets());
  print("points", pass.points());
  print("points_used", pass.points_used());
  print("tiles", pass.tiles());
  print("messages", pass.platform().messages());
  print("sent_bytes", pass.platform().sent_bytes());
  print_stage("receive", pass.receive(), pass.frames());
  print_stage("fuse", pass.fuse(), pass.frames());
  print_stage("mark", pass.mark(), pass.frames());
  print_stage("publish", pass.publish(), pass.frames());
  print_stage("frame", pass.whole(), pass.frames());
}

void print_operations(const OperationCost& cost) {
  print("inspect_sum", cost.inspect);
  print("decode_sum", cost.decode);
  print("points_sum", cost.fuse);
  print("aim_sum", cost.aim);
  print("judge_sum", cost.judge);
  print("cells", cost.cells);
  print("find_sum", cost.find);
  print("hash_sum", cost.hash);
  print("clear_sum", cost.clear);
}

void print_sizes() {
  print("tiles_per_grid", geometry::kTileCount);
  print("pipeline_bytes", sizeof(StagePass::Pipeline));
  print("grid_bytes", std::uint64_t{sizeof(grid::OccupancyIndex)} * geometry::kCellCount);
  print("marks_bytes", std::uint64_t{sizeof(grid::Mark)} * grid::kMaxMarks);
  print("receive_descriptor_bytes", sizeof(imx6::EnetMemory::receive_descriptors));
  print("receive_buffer_bytes", sizeof(imx6::EnetMemory::receive_buffers));
  print("transmit_descriptor_bytes", sizeof(imx6::EnetMemory::transmit_descriptors));
  print("transmit_buffer_bytes", sizeof(imx6::EnetMemory::transmit_buffers));
}

// The car with its first sensors only.
vehicle::Vehicle with_sensors(std::size_t count) {
  vehicle::Vehicle vehicle = vehicles::cars()[0].vehicle;
  vehicle.sensors = vehicle.sensors.first(count);
  return vehicle;
}

// What the command line asks for.
struct Request {
  const char* capture = nullptr;
  std::size_t sensors = 0;
  std::size_t frames = 0;  // 0: all, in both passes
  std::size_t before = 0;
  bool has_operations = true;
  bool forgets = false;
  app::Coding coding = app::Coding::kShortest;
};

// A target of play() that ends the capture once so many frames are complete. What the frames before
// cost is not reported.
class FirstFrames {
 public:
  FirstFrames(StagePass& stages, Capture& capture, const Request& request)
      : stages_(stages),
        capture_(capture),
        before_(request.before),
        frames_(request.before + request.frames),
        forgets_(request.forgets) {}

  void take(const vehicle::Sensor& sensor, const intake::Datagram& datagram, std::uint32_t received,
            std::uint64_t now_us) {
    stages_.take(sensor, datagram, received, now_us);
    look_for_end(now_us);
  }
  void tick(std::uint64_t now_us) {
    if (!is_over()) {
      stages_.tick(now_us);
      look_for_end(now_us);
    }
  }
  [[nodiscard]] std::uint64_t deadline_us() const { return stages_.deadline_us(); }
  [[nodiscard]] bool is_over() const { return stages_.frames() >= frames_; }

 private:
  void look_for_end(std::uint64_t now_us) {
    if (stages_.frames() == seen_) {
      return;
    }
    seen_ = stages_.frames();
    if (forgets_) {
      stages_.renew(now_us);
    }
    if (seen_ == before_) {
      a9_model::forget_so_far();
    }
    if (is_over()) {
      capture_.close();
    }
  }

  StagePass& stages_;
  Capture& capture_;
  std::size_t before_;
  std::size_t frames_;
  bool forgets_;
  std::uint64_t seen_ = 0;
};

// Only the first pass, and only of the first frames.
int run_first(Capture& capture, const vehicle::Vehicle& vehicle, InstructionCounter& counter,
              StagePass& stages, const Request& request) {
  FirstFrames first(stages, capture, request);
  play(capture, vehicle, counter, first);
  if (!first.is_over()) {
    std::puts("frame_cost: the capture has not so many frames");
    return 1;
  }
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
  std::printf("frame_cost frames=%u paths=%s\n", request.frames,
              request.forgets ? "forgotten" : "kept");
  return 0;
}

// Both passes are static: each holds a grid.
int run(const Request& request) {
  static const vehicle::Vehicle vehicle = with_sensors(request.sensors);
  static InstructionCounter counter;
  static Capture capture;
  static StagePass stages(vehicle, counter, request.coding);
  static OperationPass operations(vehicle, counter);
  counter.start();
  if (!counter.is_exact()) {
    std::puts("frame_cost: instructions are not counted; is this -icount shift=4,sleep=off?");
    return 1;
  }
  if (!capture.open(request.capture)) {
    std::printf("frame_cost: %s cannot be read as a pcap of Ethernet frames\n", request.capture);
    return 1;
  }
  if (request.frames > 0) {
    return run_first(capture, vehicle, counter, stages, request);
  }
  StackPaint stack;
  stack.apply();
  play(capture, vehicle, counter, stages);
  const std::uint32_t stack_bytes = stack.used_bytes();
  // An empty frame more: it says what publishing the last one cost.
  stages.tick(stages.deadline_us());
  if (stages.frames() == 0 || (request.has_operations && !capture.open(request.capture))) {
    std::printf("frame_cost: no frame has evidence; is %s the vehicle of the capture?\n",
                vehicle.name.data());
    return 1;
  }
  if (request.has_operations) {
    play(capture, vehicle, counter, operations);
  }

  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned int
  std::printf("frame_cost sensors=%u vehicle=%s run_hash=%08lx", request.sensors,
              vehicle.name.data(), stages.run_hash());
  print_stages(stages);
  if (request.has_operations) {
    print_operations(operations.cost());
  }
  print_sizes();
  print("stack_bytes", stack_bytes);
  print("counter_instructions", counter.of_nothing());
  std::puts("");
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  constexpr std::size_t kMostFrames = 100'000;
  const std::size_t all = iog::vehicles::cars()[0].vehicle.sensors.size();
  iog::lab::Request request{.capture = argv[1], .sensors = all};
  bool is_right = (argc >= 2 && argc <= 5) || argc == 7;
  if (is_right && argc >= 3) {
    const bool is_raw = std::strcmp(argv[2], "raw") == 0;
    request.coding = is_raw ? iog::app::Coding::kRaw : iog::app::Coding::kShortest;
    is_right = is_raw || std::strcmp(argv[2], "shortest") == 0;
  }
  if (is_right && argc >= 4) {
    request.sensors = iog::lab::number_in(argv[3], all);
    is_right = request.sensors > 0;
  }
  if (is_right && argc == 5) {
    request.has_operations = false;
    is_right = std::strcmp(argv[4], "stages") == 0;
  }
  if (is_right && argc == 7) {
    request.frames = iog::lab::number_in(argv[4], kMostFrames);
    request.forgets = std::strcmp(argv[5], "forgotten") == 0;
    request.before = iog::lab::number_in(argv[6], kMostFrames);
    is_right = request.frames > 0 && request.before > 0 &&
               (request.forgets || std::strcmp(argv[5], "kept") == 0);
  }
  if (!is_right) {
    // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
    std::printf(
        "frame_cost: expected a capture, raw or shortest, 1 to %u for the sensors, and stages or a "
        "number of frames with what becomes of paths and the frames before\n",
        all);
    return 2;
  }
  return iog::lab::run(request);
}
