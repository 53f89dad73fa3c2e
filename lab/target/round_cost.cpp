// round_cost: what a round of the cores costs the Cortex-A9 itself, when its items are nothing.
// Runs in QEMU with the cost model (lab/a9_model/run), which tells what opening, taking items and
// looking whether all are done take; prints one line of key=value pairs.
//
//   round_cost <items>
//
// One core does all of it, so nothing waits for another core's cache line.
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "lab/a9_model/marker.hpp"
#include "number_in.hpp"
#include "require/require.hpp"
#include "work/round.hpp"

namespace iog::lab {
namespace {

constexpr std::uint32_t kRounds = 100;

[[gnu::noinline]] void do_nothing(std::size_t /*item*/) {}

// The model reports it.
[[gnu::noinline]] void run_rounds(std::size_t items, std::uint32_t rounds) {
  static work::Round round;
  static std::atomic<std::uint32_t> done{0};
  auto nothing = [](std::size_t item, std::size_t /*core*/) { do_nothing(item); };
  const std::uint32_t before = done;
  for (std::uint32_t number = 0; number < rounds; ++number) {
    round.open(items, work::work_of(nothing));
    static_cast<void>(round.help(0, done));
    require(round.is_done());
  }
  require(done - before == rounds * items);
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  const std::size_t items =
      argc == 2 ? iog::lab::number_in(argv[1], iog::work::Round::kMaxItems) : 0;
  if (items == 0) {
    std::puts("round_cost: expected a number of items");
    return 2;
  }
  iog::lab::run_rounds(items, 1);
  iog::a9_model::forget_so_far();
  iog::lab::run_rounds(items, iog::lab::kRounds);
  std::printf("round_cost items=%lu rounds=%lu\n", static_cast<unsigned long>(items),
              static_cast<unsigned long>(iog::lab::kRounds));
  return 0;
}
