// An experiment: repeats what a paper claims or asks what a choice costs, and tells what it found
// as tables of observations. It neither judges nor words: lab/pages does.
//
// It is a pure function of its input. The same input gives the same tables on every machine; see
// table.hpp for what does not.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lab/experiments/table.hpp"

namespace iog::lab {

// A recording that the reader has and the project does not ship.
struct Recording {
  std::string pcap;
  std::string vehicle;
};

struct Input {
  std::uint64_t seed = 1;     // of the simulated drive
  std::uint32_t seconds = 2;  // 25 frames a second
  std::uint32_t hills = 2;    // drives of each car through hills
  std::vector<Recording> recordings;
};

using Tables = std::vector<Table>;

struct Experiment {
  std::string_view page;  // its folder: that of docs/results/PAGE.md, or of docs/evidential.md
  std::string_view name;
  Tables (*run)(const Input& input);
};

// In the order in which they are begun. Names are unique.
[[nodiscard]] std::span<const Experiment> all_experiments();

}  // namespace iog::lab
