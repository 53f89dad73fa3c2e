// Ours and others on the same simulated beams, for lab/peers/run, which makes a page of it.
//
// Times are CPU time of this thread, so that what else runs on the machine disturbs less: the
// library's own time is fuse and clear, the counters have both apart, all per frame.
#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <ctime>
#include <string>
#include <string_view>

#include "lab/evidence/projection.hpp"
#include "lab/peers/contender.hpp"

namespace iog::lab {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::uint32_t kSeconds = 2;
constexpr std::uint32_t kFrameStep = 5;

double thread_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void run(benchmark::State& state, MakeContender make, const PeerFrames& frames) {
  const std::unique_ptr<Contender> contender = make(frames);
  double fuse_s = 0;
  double clear_s = 0;
  double passes = 0;
  for ([[maybe_unused]] auto each : state) {
    double pass_s = 0;
    for (std::size_t frame = 0; frame < frames.frames.size(); ++frame) {
      const double begin = thread_seconds();
      contender->fuse(frame);
      benchmark::ClobberMemory();
      const double fused = thread_seconds();
      contender->clear();
      benchmark::ClobberMemory();
      const double cleared = thread_seconds();
      fuse_s += fused - begin;
      clear_s += cleared - fused;
      pass_s += cleared - begin;
    }
    state.SetIterationTime(pass_s);
    ++passes;
  }
  const double fused_frames = passes * static_cast<double>(frames.frames.size());
  contender->fuse(0);
  const CellCounts cells = contender->count();
  state.counters["fuse_us"] = 1e6 * fuse_s / fused_frames;
  state.counters["clear_us"] = 1e6 * clear_s / fused_frames;
  state.counters["free_cells"] = static_cast<double>(cells.free);
  state.counters["occupied_cells"] = static_cast<double>(cells.occupied);
  state.counters["stored_cells"] = static_cast<double>(cells.stored);
}

// Cells that beams carve and mark, each as often as a beam does it.
std::size_t updates_of(const PeerFrames& frames) {
  std::size_t updates = 0;
  for (const PeerFrame& frame : frames.frames) {
    FramePoints points;
    for (const PeerBeam& beam : frame) {
      points.push_back({beam.sensor, beam.point});
    }
    const FrameEvidence evidence = project(*frames.vehicle, points);
    updates += static_cast<std::size_t>(
        std::ranges::count_if(evidence.cells, [](const auto& seen) { return seen.step <= 0; }));
  }
  return updates;
}

void describe(const std::string& scene, const PeerFrames& frames) {
  benchmark::AddCustomContext(scene + "_updates", std::to_string(updates_of(frames)));
  benchmark::AddCustomContext(scene + "_frames", std::to_string(frames.frames.size()));
  benchmark::AddCustomContext(scene + "_beams", std::to_string(frames.beams));
  benchmark::AddCustomContext(scene + "_only_carving", std::to_string(frames.only_carving));
  benchmark::AddCustomContext(scene + "_later_echoes", std::to_string(frames.later_echoes));
}

template <const char* kScene>
const PeerFrames& frames() {
  static const PeerFrames result =
      frames_of(tools::find_vehicle(tools::kDefaultVehicle), kScene, kSeed, kSeconds, kFrameStep);
  return result;
}

constexpr char kCity[] = "city";
constexpr char kRingRoad[] = "ring_road";

template <MakeContender kMake, const char* kScene>
void measure(benchmark::State& state) {
  run(state, kMake, frames<kScene>());
}

struct Entry {
  std::string name;
  void (*in_city)(benchmark::State&);
  void (*on_ring_road)(benchmark::State&);
};

template <MakeContender kMake>
Entry entry(const char* name) {
  return {name, measure<kMake, kCity>, measure<kMake, kRingRoad>};
}

std::array<Entry, 9> entries() {
  return {entry<make_hits_win>("ours"),
          entry<make_bayes>("ours_bayes"),
          entry<make_printed>("printed"),
          entry<make_printed_whole_beams>("printed_whole_beams"),
          entry<make_float_bayes>("float_bayes"),
          entry<make_float_log_odds>("float_log_odds"),
          entry<make_mrpt>("mrpt"),
          entry<make_octomap_clouds>("octomap_clouds"),
          entry<make_octomap_rays>("octomap_rays")};
}

// passes: over all frames, to count instructions; 0 for as many as the library wants.
void enter(const std::string& name, void (*measure)(benchmark::State&), int passes) {
  auto* const entered = benchmark::RegisterBenchmark(name.c_str(), measure)
                            ->UseManualTime()
                            ->Unit(benchmark::kMicrosecond);
  if (passes > 0) {
    entered->Iterations(passes);
  }
}

}  // namespace
}  // namespace iog::lab

// With --passes=N as the last argument, each benchmark makes N passes over its frames.
int main(int argc, char** argv) {
  constexpr std::string_view kPasses = "--passes=";
  const std::string_view last = argv[argc - 1];
  const int passes = last.starts_with(kPasses) ? std::stoi(argv[--argc] + kPasses.size()) : 0;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 2;
  }
  iog::lab::describe("city", iog::lab::frames<iog::lab::kCity>());
  iog::lab::describe("ring_road", iog::lab::frames<iog::lab::kRingRoad>());
  for (const iog::lab::Entry& entry : iog::lab::entries()) {
    iog::lab::enter("city/" + entry.name, entry.in_city, passes);
    iog::lab::enter("ring_road/" + entry.name, entry.on_ring_road, passes);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
