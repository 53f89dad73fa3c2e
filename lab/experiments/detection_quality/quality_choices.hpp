// The choices that detection_quality puts side by side: each named as the tables name it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lab/experiments/fusion_trial.hpp"

namespace iog::lab {

// The names that numbers are looked up by.
inline constexpr const char* kHitsWinName = "hits_win (default)";
inline constexpr const char* kBayesName = "bayes";
inline constexpr const char* kSequentialName = "sequential";
inline constexpr const char* kDoubleName = "Bayes in double";
inline constexpr const char* kPoolName = "linear opinion pool";
inline constexpr const char* kMaximumName = "maximum policy";

inline constexpr std::array kSweep{0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.001};
inline constexpr std::array kWideSweep{0.01, 0.001};

// "hits_win, nearest", "bayes, epsilon 0.01, wide": the name of an index rule with one thing
// changed; the rule's own name if nothing is.
[[nodiscard]] std::string name_of(const IndexFusion& fusion);
[[nodiscard]] std::string name_of(IndexRule rule, Geometry geometry);

[[nodiscard]] std::string nearest_name();  // hits_win with nearest instead of blurring

// One list for each table; hits_win and bayes as they are open all but the first.
[[nodiscard]] std::vector<Choice> rule_choices();
[[nodiscard]] std::vector<Choice> quantisation_choices();
[[nodiscard]] std::vector<Choice> traversal_choices();
[[nodiscard]] std::vector<Choice> sampling_choices();

// All of them, each once.
[[nodiscard]] std::vector<Choice> all_choices();

}  // namespace iog::lab
