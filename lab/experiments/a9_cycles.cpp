#include "lab/experiments/a9_cycles.hpp"

#include <algorithm>
#include <initializer_list>

#include "lab/experiments/cortex_a9.hpp"
#include "lab/experiments/markdown.hpp"
#include "tools/simulate/scene_catalogue.hpp"

namespace iog::lab {
namespace {

constexpr double kClockHz = 1e9;

constexpr const char* kNominal = " variant=nominal";
constexpr const char* kOptimistic = " variant=optimistic";
constexpr const char* kPessimistic = " variant=pessimistic";

// The same key of the three lines of a run. A run of one variant has it for all.
Modelled modelled_on_a9(const std::string& run, const std::string& key) {
  const double nominal = measured_on_a9(run + kNominal, key);
  const auto of = [&](const char* variant) {
    return has_a9_run(run + variant) ? measured_on_a9(run + variant, key) : nominal;
  };
  return {.nominal = nominal, .optimistic = of(kOptimistic), .pessimistic = of(kPessimistic)};
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

// The runs of the default scene do not name it.
std::string naming(std::string_view scene) {
  return scene == tools::kDefaultScene ? "" : std::string(" scene=").append(scene);
}

A9Cycles cycles_of_run(const std::string& run) {
  const double frames = measured_on_a9(run + kNominal, "frames");
  A9Cycles cycles{.frames = frames,
                  .before = measured_on_a9(run + kNominal, "before"),
                  .receive = stage_of(run, "receive_", frames),
                  .decode = stage_of(run, "decode_", frames),
                  .beams = stage_of(run, "beams_", frames),
                  .carve = stage_of(run, "carve_", frames),
                  .mark = stage_of(run, "mark_", frames),
                  .encode = stage_of(run, "encode_", frames),
                  .send = stage_of(run, "send_", frames),
                  .clear = stage_of(run, "clear_", frames),
                  .fuse = {},
                  .publish = {},
                  .fused = {},
                  .whole = stage_of(run, "frame_", frames)};
  cycles.fuse = sum_of({cycles.beams, cycles.carve});
  cycles.publish = sum_of({cycles.encode, cycles.send, cycles.clear});
  cycles.fused = sum_of({cycles.decode, cycles.fuse, cycles.mark, cycles.clear});
  return cycles;
}

A9Cycles cycles_of_run(const std::string& run, Paths paths) {
  return cycles_of_run(paths == Paths::kForgotten ? run + " paths=forgotten" : run);
}

A9Floor floor_of_run(const std::string& run) {
  const double frames = measured_on_a9(run + kNominal, "frames");
  return {.lines = measured_on_a9(run + kNominal, "lines") / frames,
          .fuse = stage_of(run, "fuse_", frames),
          .send = stage_of(run, "send_", frames),
          .clear = stage_of(run, "clear_", frames)};
}

}  // namespace

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

A9Cycles a9_cycles(std::string_view scene, int sensors, Paths paths) {
  return cycles_of_run("model frame_cost" + naming(scene) + " sensors=" + std::to_string(sensors),
                       paths);
}

A9Cycles a9_shortest(std::string_view scene) {
  return cycles_of_run("model frame_cost" + naming(scene) + " sensors=4 coding=shortest");
}

A9Cycles a9_worst_cycles(std::string_view name, Paths paths) {
  return cycles_of_run("model frame_cost worst=" + std::string(name) + " sensors=4", paths);
}

A9Cycles a9_long_run(std::string_view scene) {
  return cycles_of_run("model long_run" + naming(scene) + " sensors=4");
}

double A9Floor::fused_cycles() const { return fuse.cycles.nominal + clear.cycles.nominal; }
double A9Floor::whole_cycles() const { return fused_cycles() + send.cycles.nominal; }

A9Floor a9_floor(std::string_view scene) { return floor_of_run("model floor" + naming(scene)); }

A9Tree a9_tree(std::string_view scene) {
  const std::string run = "model tree" + naming(scene);
  const double frames = measured_on_a9(run + kNominal, "frames");
  return {.leaves = measured_on_a9(run + kNominal, "leaves") / frames,
          .bytes = measured_on_a9(run + kNominal, "bytes") / frames,
          .cost = stage_of(run, "tree_", frames)};
}

A9Floor a9_worst_floor(std::string_view name) {
  return floor_of_run("model floor worst=" + std::string(name));
}

A9Scaling a9_scaling(const A9Load& load) {
  const auto pair = [](const char* key, int value) {
    return std::string(" ").append(key).append("=").append(std::to_string(value));
  };
  const std::string run = "model scaling" + pair("cells_per_side", load.cells_per_side) +
                          pair("cell_mm", load.cell_mm) + pair("sensors", load.sensors) +
                          pair("azimuths", load.azimuths) + pair("range_cm", load.range_cm);
  const double frames = measured_on_a9(run + kNominal, "frames");
  const auto stage = [&](const char* name) { return stage_of(run, name, frames); };
  const StageCost clear = stage("clear_");
  return {
      .points = measured_on_a9(run + kNominal, "points"),
      .messages = measured_on_a9(run + kNominal, "messages"),
      .fused = sum_of({stage("decode_"), stage("beams_"), stage("carve_"), stage("mark_"), clear}),
      .publish = sum_of({stage("encode_"), stage("send_"), clear}),
      .whole = stage("frame_")};
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

}  // namespace iog::lab
