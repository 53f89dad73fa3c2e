#include "work/round.hpp"

#include "require/require.hpp"

namespace iog::work {

static_assert(Round::kMaxItems <= 0xFFFF, "the ticket has 16 bits for them");

// Clears the flags and writes the work before the ticket announces the items.
void Round::open(std::size_t items, Work work) {
  require(items <= kMaxItems && look().left() == 0);
  for (std::size_t item = 0; item < items; ++item) {
    is_done_[item].store(false, std::memory_order_relaxed);
  }
  work_ = work;
  items_ = items;
  checked_ = 0;
  const std::uint32_t number = look().number() + 1U;
  ticket_.store((number & 0xFFFFU) << 16 | static_cast<std::uint32_t>(items),
                std::memory_order_release);
}

// Acquires the work that core 0 wrote. Releases the store that marks this core as busy, so that
// core 0 sees it once all items are taken.
std::optional<std::size_t> Round::claim(Ticket& seen) {
  const std::size_t left = seen.left();
  if (left == 0 ||
      !ticket_.compare_exchange_strong(seen.word, seen.word - 1, std::memory_order_acq_rel,
                                       std::memory_order_acquire)) {
    return std::nullopt;
  }
  return items_ - left;
}

Round::Ticket Round::help(std::size_t core, std::atomic<std::uint32_t>& done) {
  Ticket seen = look();
  while (seen.left() > 0) {
    if (const std::optional<std::size_t> item = claim(seen)) {
      run(*item, core);
      finish(*item);
      count_up(done, 1);
      seen = look();
    }
  }
  return seen;
}

bool Round::is_done() {
  while (checked_ < items_ && is_done_[checked_].load(std::memory_order_acquire)) {
    ++checked_;
  }
  return checked_ == items_;
}

std::size_t Round::redo() {
  std::size_t redone = 0;
  for (; !is_done(); ++redone) {
    run(checked_, 0);
    finish(checked_);
  }
  return redone;
}

}  // namespace iog::work
