#include "lab/experiments/detection_quality/quality_choices.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace iog::lab {
namespace {

constexpr std::array kBothRules{IndexRule::kHitsWin, IndexRule::kBayes};

std::string short_name_of(IndexRule rule) {
  switch (rule) {
    case IndexRule::kHitsWin:
      return "hits_win";
    case IndexRule::kBayes:
      return kBayesName;
    case IndexRule::kSequential:
      break;
  }
  return kSequentialName;
}

std::string plain_name_of(IndexRule rule) {
  return rule == IndexRule::kHitsWin ? kHitsWinName : short_name_of(rule);
}

// "0.2", "0.005".
std::string digits_of(double epsilon) {
  std::array<char, 16> text{};
  static_cast<void>(std::snprintf(text.data(), text.size(), "%.3g", epsilon));
  return text.data();
}

Choice of(const IndexFusion& fusion) { return {.name = name_of(fusion), .fusion = fusion}; }

Choice of(IndexRule rule, Geometry geometry) {
  return {
      .name = name_of(rule, geometry), .fusion = IndexFusion{.rule = rule}, .geometry = geometry};
}

}  // namespace

std::string name_of(const IndexFusion& fusion) {
  const bool is_nearest = fusion.policy == index::Quantisation::kNearest;
  const bool is_wide = fusion.limit != kInt8Limit;
  if (!is_nearest && !is_wide && fusion.epsilon == kDefaultEpsilon) {
    return plain_name_of(fusion.rule);
  }
  std::string name = short_name_of(fusion.rule);
  name += is_nearest ? ", nearest" : "";
  name += fusion.epsilon == kDefaultEpsilon ? "" : ", epsilon " + digits_of(fusion.epsilon);
  return name + (is_wide ? ", wide" : "");
}

std::string name_of(IndexRule rule, Geometry geometry) {
  if (geometry.path == Path::kBresenham) {
    return short_name_of(rule) + ", Bresenham";
  }
  switch (geometry.sampling) {
    case Sampling::kCentre:
      return short_name_of(rule) + ", cell centre";
    case Sampling::kEntry:
      return short_name_of(rule) + ", entry";
    case Sampling::kModel:
      break;
  }
  return plain_name_of(rule);
}

std::string nearest_name() { return name_of(IndexFusion{.policy = index::Quantisation::kNearest}); }

std::vector<Choice> rule_choices() {
  return {of({.rule = IndexRule::kHitsWin}),
          of({.rule = IndexRule::kBayes}),
          of({.rule = IndexRule::kSequential}),
          {.name = kDoubleName, .fusion = ProbabilityRule::kBayes},
          {.name = kPoolName, .fusion = ProbabilityRule::kLinearOpinionPool},
          {.name = kMaximumName, .fusion = ProbabilityRule::kMaximum}};
}

std::vector<Choice> quantisation_choices() {
  std::vector<Choice> choices;
  for (const IndexRule rule : kBothRules) {
    choices.push_back(of({.rule = rule, .policy = index::Quantisation::kNearest}));
    for (const double epsilon : kSweep) {
      choices.push_back(of({.rule = rule, .epsilon = epsilon}));
    }
    for (const double epsilon : kWideSweep) {
      choices.push_back(of({.rule = rule, .epsilon = epsilon, .limit = kNoLimit}));
    }
  }
  return choices;
}

std::vector<Choice> traversal_choices() {
  std::vector<Choice> choices;
  for (const IndexRule rule : kBothRules) {
    choices.push_back(of(rule, {}));
    choices.push_back(of(rule, {.path = Path::kBresenham}));
  }
  return choices;
}

std::vector<Choice> sampling_choices() {
  std::vector<Choice> choices;
  for (const IndexRule rule : kBothRules) {
    for (const Sampling sampling : {Sampling::kModel, Sampling::kCentre, Sampling::kEntry}) {
      choices.push_back(of(rule, {.sampling = sampling}));
    }
  }
  return choices;
}

std::vector<Choice> all_choices() {
  std::vector<Choice> all;
  for (const auto& list :
       {rule_choices(), quantisation_choices(), traversal_choices(), sampling_choices()}) {
    for (const Choice& choice : list) {
      const auto has_name = [&](const Choice& other) { return other.name == choice.name; };
      if (std::none_of(all.begin(), all.end(), has_name)) {
        all.push_back(choice);
      }
    }
  }
  return all;
}

}  // namespace iog::lab
