// printed_cost: instructions for the thesis's fusion as it is printed (lab/baseline) on the
// Cortex-A9. Runs in QEMU with instruction counting (lab/target/run_image); prints a line of
// key=value pairs for each place where its loop may end, which the thesis does not say.
//
//   printed_cost <capture of the reference car>
//
// Counted are decoding the scans, fusing their points and setting the grid back to unknown: what
// frame_cost calls fuse, mark and clear.
#include <cstdint>
#include <cstdio>

#include "capture.hpp"
#include "instruction_counter.hpp"
#include "lab/baseline/printed_fusion.hpp"
#include "lidar/ibeo_lux.hpp"
#include "playback.hpp"
#include "vehicles/cars.hpp"

namespace iog::lab {
namespace {

const vehicle::Vehicle& car() { return vehicles::cars()[0].vehicle; }

// A target of play(). A frame ends with its period: which points share a grid changes no cost.
class PrintedPass {
 public:
  PrintedPass(InstructionCounter& counter, Extent extent)
      : counter_(counter), fusion_(car(), extent) {}

  void take(const vehicle::Sensor& sensor, const intake::Datagram& datagram,
            std::uint32_t /*received*/, std::uint64_t /*now_us*/) {
    const std::uint32_t start = counter_.now();
    if (lux_.decode(datagram.payload) == lidar::DecodeStatus::kOk) {
      lux_.for_each_point([&](const lidar::ScanPoint& point) {
        fusion_.add(sensor, point);
        ++points_;
      });
    }
    fuse_ += counter_.now() - start - counter_.of_nothing();
  }

  void tick(std::uint64_t now_us) {
    const std::uint32_t start = counter_.now();
    fusion_.clear();
    clear_ += counter_.now() - start - counter_.of_nothing();
    deadline_us_ = now_us + car().frame_period_us;
    ++frames_;
  }
  [[nodiscard]] std::uint64_t deadline_us() const { return deadline_us_; }

  void print(const char* extent) const {
    // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
    std::printf("printed_cost extent=%s frames=%llu points=%llu fuse_sum=%llu clear_sum=%llu\n",
                extent, frames_, points_, fuse_, clear_);
  }

 private:
  InstructionCounter& counter_;
  PrintedFusion fusion_;
  lidar::IbeoLux lux_;
  std::uint64_t deadline_us_ = car().frame_period_us;
  std::uint64_t frames_ = 0;
  std::uint64_t points_ = 0;
  std::uint64_t fuse_ = 0;
  std::uint64_t clear_ = 0;
};

// Both passes are static: each holds a grid.
int run(const char* path) {
  static InstructionCounter counter;
  static Capture capture;
  static PrintedPass to_scan_point(counter, Extent::kToScanPoint);
  static PrintedPass whole_beam(counter, Extent::kWholeBeam);
  counter.start();
  if (!counter.is_exact()) {
    std::puts("printed_cost: instructions are not counted; is this -icount shift=4,sleep=off?");
    return 1;
  }
  for (PrintedPass* const pass : {&to_scan_point, &whole_beam}) {
    if (!capture.open(path)) {
      std::printf("printed_cost: %s cannot be read as a pcap of Ethernet frames\n", path);
      return 1;
    }
    play(capture, car(), counter, *pass);
  }
  to_scan_point.print("scan_point");
  whole_beam.print("whole_beam");
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  if (argc != 2) {
    std::puts("printed_cost: expected one argument, a capture");
    return 2;
  }
  return iog::lab::run(argv[1]);
}
