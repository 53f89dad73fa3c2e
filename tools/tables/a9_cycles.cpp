#include "tools/tables/a9_cycles.hpp"

#include <algorithm>
#include <initializer_list>

#include "tools/simulate/scene_catalogue.hpp"
#include "tools/tables/cortex_a9.hpp"
#include "tools/tables/markdown.hpp"

namespace iog::tools {
namespace {

constexpr double kClockHz = 1e9;

constexpr const char* kNominal = " variant=nominal";
constexpr const char* kOptimistic = " variant=optimistic";
constexpr const char* kPessimistic = " variant=pessimistic";

// The same key of the three lines of a run.
Modelled modelled_on_a9(const std::string& run, const std::string& key) {
  return {.nominal = measured_on_a9(run + kNominal, key),
          .optimistic = measured_on_a9(run + kOptimistic, key),
          .pessimistic = measured_on_a9(run + kPessimistic, key)};
}

// From the keys that begin with `stage`, sums over so many frames.
StageCost stage_of(const std::string& run, const std::string& stage, double frames) {
  const auto mean = [&](const char* key) {
    return measured_on_a9(run + kNominal, stage + key) / frames;
  };
  return {.cycles = modelled_on_a9(run, stage + "cycles") * (1 / frames),
          .instructions = mean("instructions"),
          .l1d_refills = mean("l1d_refills"),
          .l2_misses = mean("l2_misses"),
          .mispredicts = mean("mispredicts")};
}

StageCost sum_of(std::initializer_list<StageCost> stages) {
  StageCost sum;
  for (const StageCost& stage : stages) {
    sum.cycles.nominal += stage.cycles.nominal;
    sum.cycles.optimistic += stage.cycles.optimistic;
    sum.cycles.pessimistic += stage.cycles.pessimistic;
    sum.instructions += stage.instructions;
    sum.l1d_refills += stage.l1d_refills;
    sum.l2_misses += stage.l2_misses;
    sum.mispredicts += stage.mispredicts;
  }
  return sum;
}

}  // namespace

// The runs of the default scene do not name it.
A9Cycles a9_cycles(std::string_view scene, int sensors) {
  std::string run("model frame_cost ");
  if (scene != kDefaultScene) {
    run.append("scene=").append(scene).append(" ");
  }
  run.append("sensors=").append(std::to_string(sensors));
  const double frames = measured_on_a9(run + kNominal, "frames");
  A9Cycles cycles{.frames = frames,
                  .receive = stage_of(run, "receive_", frames),
                  .decode = stage_of(run, "decode_", frames),
                  .fuse = stage_of(run, "fuse_", frames),
                  .mark = stage_of(run, "mark_", frames),
                  .clear = stage_of(run, "clear_", frames),
                  .publish = stage_of(run, "publish_", frames),
                  .fused = {},
                  .whole = stage_of(run, "frame_", frames)};
  cycles.fused = sum_of({cycles.decode, cycles.fuse, cycles.mark, cycles.clear});
  return cycles;
}

StageCost a9_walk(const std::string& walk) {
  return stage_of("model traversal_cost walk=" + walk, "", 1);
}

Modelled cycles_of(double instructions, const StageCost& stage) {
  return stage.cycles * (instructions / stage.instructions);
}

Modelled hz_of(const Modelled& cycles) {
  return {.nominal = kClockHz / cycles.nominal,
          .optimistic = kClockHz / cycles.optimistic,
          .pessimistic = kClockHz / cycles.pessimistic};
}

std::string banded(const Modelled& value, int decimals) {
  const auto [low, high] = std::minmax(value.optimistic, value.pessimistic);
  const auto written = [decimals](double number) {
    return decimals == 0 ? grouped(number) : fixed(number, decimals);
  };
  return written(value.nominal) + " (" + written(low) + " to " + written(high) + ")";
}

Verdict verdict_by_nominal(double paper, const Modelled& ours) {
  return ours.nominal > paper ? Verdict::kBeats : Verdict::kFallsShort;
}

bool is_in_band(double paper, const Modelled& ours) {
  const auto [low, high] = std::minmax(ours.optimistic, ours.pessimistic);
  return low <= paper && paper <= high;
}

}  // namespace iog::tools
