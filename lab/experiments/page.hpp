// The page of results: an introduction, the overview of all claims, the sections, what made it.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lab/experiments/section.hpp"

namespace iog::lab {

struct NamedSection {
  std::string_view name;
  Section (*compute)(const TablesInput& input);
};

// In the order of the page.
[[nodiscard]] std::span<const NamedSection> all_sections();

// Computes these sections side by side, as many at a time as the PC has cores. The answer is in
// their order. on_done is told how many are ready, from one thread at a time. If a section throws,
// no other is begun; UsageError stays one, everything else becomes a std::runtime_error with the
// section's name.
[[nodiscard]] std::vector<Section> compute(std::span<const NamedSection> sections,
                                           const TablesInput& input,
                                           const std::function<void(std::size_t)>& on_done);

[[nodiscard]] std::string page_of(const TablesInput& input, std::span<const Section> sections);

}  // namespace iog::lab
