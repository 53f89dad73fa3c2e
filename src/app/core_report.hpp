// Reports the cores on the console: the number of working cores, and the reason why each of the
// other cores does not work.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "hal/console.hpp"
#include "hal/cores.hpp"
#include "work/team.hpp"

namespace iog::app {

constexpr std::string_view text_of(work::Loss loss) {
  switch (loss) {
    case work::Loss::kNone:
      return "works";
    case work::Loss::kNotAsked:
      return "not asked";
    case work::Loss::kNotUp:
      return "did not come up";
    case work::Loss::kFaulted:
      return "faulted";
    case work::Loss::kStuck:
      return "was stuck";
    case work::Loss::kSilent:
      return "is silent";
  }
  return "unknown";
}

// Writes the number of working cores ("cores: 3 at work"), and a line for each lost core ("core 2
// was stuck: stopped pc=10100474").
template <hal::Console Console, hal::Cores Cores>
void report_cores(Console& console, const work::Team<Cores>& team) {
  const auto digit = [](std::size_t number) { return std::array{static_cast<char>('0' + number)}; };
  const auto write = [&console](const std::array<char, 1>& text) {
    console.write({text.data(), text.size()});
  };
  console.write("cores: ");
  write(digit(team.cores()));
  console.write(" at work\n");
  for (std::size_t core = 1; core < hal::kMaxCores; ++core) {
    const work::Loss loss = team.loss(core);
    if (loss == work::Loss::kNone || loss == work::Loss::kNotAsked) {
      continue;
    }
    console.write("core ");
    write(digit(core));
    console.write(" ");
    console.write(text_of(loss));
    console.write(": ");
    console.write(team.last_word(core));
    console.write("\n");
  }
}

}  // namespace iog::app
