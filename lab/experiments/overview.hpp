// All claims on one page: where this project equals, beats or departs from the papers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lab/experiments/markdown.hpp"
#include "lab/experiments/section.hpp"

namespace iog::lab {

[[nodiscard]] std::string_view word_of(Verdict verdict);

// How many claims fare how, and one table of them all. std::invalid_argument if a claim that is not
// kEquals gives no reason.
void add_overview(Markdown& page, const std::vector<Claim>& claims);

}  // namespace iog::lab
