// An image that shares work among the cores there are, then loses one helper after the other.
//
// It prints the sum of what was made, which is the same for any number of cores, and the last words
// of those that were lost.
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>

#include "app/core_report.hpp"
#include "board.hpp"
#include "deep_stack.hpp"
#include "left_core.hpp"
#include "require/require.hpp"
#include "text_line.hpp"
#include "work/team.hpp"

namespace {

using iog::board::Board;

// Under counted instructions the cores run in turns of 100 ms, and one that hangs takes all of its
// turn: the others come within three of them. The watchdog waits for two seconds.
constexpr std::uint32_t kPatienceUs = 1'000'000;
constexpr std::size_t kItems = 64;
constexpr int kRounds = 20;

// Each item makes 16 words out of its number and the round's, in two halves.
class Pile {
 public:
  void begin(std::uint32_t round, std::size_t cores, std::size_t lost) {
    round_ = round;
    lost_ = lost;
    cores_ = cores;
    begun_.store(0, std::memory_order_relaxed);
  }

  void operator()(std::size_t item, std::size_t core) {
    make(item, 0, kWords / 2);
    begun_.fetch_or(1u << core, std::memory_order_acq_rel);
    wait_for_all();
    if (core != 0 && core == lost_) {
      lose(core);
    }
    make(item, kWords / 2, kWords);
  }

  // FNV-1a, word by word.
  std::uint32_t sum(std::uint32_t sum) const {
    for (const auto& words : words_) {
      for (const std::uint32_t word : words) {
        sum = (sum ^ word) * 0x0100'0193;
      }
    }
    return sum;
  }

 private:
  static constexpr std::uint32_t kWords = 16;

  void make(std::size_t item, std::uint32_t begin, std::uint32_t end) {
    const auto number = static_cast<std::uint32_t>(item);
    for (std::uint32_t at = begin; at < end; ++at) {
      words_[item][at] = (round_ * 0x9e37'79b9u ^ number * 0x85eb'ca6bu) + at * at;
    }
  }

  // Every core gets an item.
  void wait_for_all() const {
    while (std::popcount(begun_.load(std::memory_order_relaxed)) < static_cast<int>(cores_)) {
      iog::machine::yield();
    }
  }

  static void lose(std::size_t core) {
    if (core == 1) {
      iog::require(iog::tests::never());
    }
    if (core == 3) {
      iog::tests::overflow(1);
    }
    for (;;) {
    }
  }

  std::uint32_t round_ = 0;
  std::size_t lost_ = 0;
  std::size_t cores_ = 0;
  std::atomic<std::uint32_t> begun_{0};
  std::array<std::array<std::uint32_t, kWords>, kItems> words_{};
};

using Team = iog::work::Team<iog::board::Cores>;

void report(Board& board, const Team& team, std::uint32_t sum) {
  iog::board::TextLine line;
  line.text("sum ").hex(sum).text(" redone ").decimal(team.redone()).text("\n");
  board.console().write(line.view());
  iog::app::report_cores(board.console(), team);
}

// All rounds, then the rest of them after the loss of a core.
void work(Board& board, Team& team, Pile& pile, std::size_t lost) {
  std::uint32_t sum = 0x811c'9dc5;
  for (std::uint32_t round = 1; round <= kRounds; ++round) {
    pile.begin(round, team.cores(), round == kRounds / 2 ? lost : 0);
    team.share(kItems, iog::work::work_of(pile));
    sum = pile.sum(sum);
    board.watchdog().service();
  }
  report(board, team, sum);
}

}  // namespace

int main() {
  static Board board({0x02, 0, 0, 0, 0, 1});
  static Team team(board.cores(), kPatienceUs);
  static Pile pile;
  board.print_banner();
  if (board.cores().count() > 1) {
    iog::tests::leave_a_core(board);
  }
  team.start(iog::hal::kMaxCores);
  work(board, team, pile, 0);
  for (std::size_t core = 1; core < iog::hal::kMaxCores; ++core) {
    if (team.loss(core) == iog::work::Loss::kNone) {
      work(board, team, pile, core);
    }
  }
  board.console().write("all cores seen\n");
  for (;;) {
    board.watchdog().service();
    board.idle();
  }
}
