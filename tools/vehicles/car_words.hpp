// The words of a car's file and what they stand for.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "tools/car/description.hpp"
#include "tools/vehicles/toml_table.hpp"

namespace iog::tools {

using GridsWord = Choice<vehicle::Grids>;
inline constexpr std::array kGridsWords{
    GridsWord{"indexes", vehicle::Grids::kIndexes},
    GridsWord{"classes", vehicle::Grids::kClasses},
    GridsWord{"both", vehicle::Grids::kBoth},
};
[[nodiscard]] constexpr std::string_view word_of(vehicle::Grids grids) {
  return std::ranges::find(kGridsWords, grids, &GridsWord::value)->word;
}
inline constexpr std::array kRuleWords{
    Choice<vehicle::FusionRule>{"hits_win", vehicle::FusionRule::kHitsWin},
    Choice<vehicle::FusionRule>{"bayes", vehicle::FusionRule::kBayes},
};
inline constexpr std::array kQuantisationWords{
    Choice<index::Quantisation>{"blurring", index::Quantisation::kBlurring},
    Choice<index::Quantisation>{"nearest", index::Quantisation::kNearest},
};
inline constexpr std::array kDiscountingWords{
    Choice<ageing::Discounting>{"conservative", ageing::Discounting::kConservative},
    Choice<ageing::Discounting>{"optimistic", ageing::Discounting::kOptimistic},
    Choice<ageing::Discounting>{"classical", ageing::Discounting::kClassical},
    Choice<ageing::Discounting>{"proportional", ageing::Discounting::kProportional},
};
inline constexpr std::array kWeighingWords{
    Choice<ageing::Weighing>{"by_time", ageing::Weighing::kByTime},
    Choice<ageing::Weighing>{"each_scan", ageing::Weighing::kEachScan},
};
inline constexpr std::array kMovedWords{
    Choice<perception::Moved>{"open_ground", perception::Moved::kOpenGround},
    Choice<perception::Moved>{"literal", perception::Moved::kLiteral},
};
inline constexpr std::array kModeWords{
    Choice<lidar::TurnMode>{"512x10", {512, 10}},   Choice<lidar::TurnMode>{"512x20", {512, 20}},
    Choice<lidar::TurnMode>{"1024x10", {1024, 10}}, Choice<lidar::TurnMode>{"1024x20", {1024, 20}},
    Choice<lidar::TurnMode>{"2048x10", {2048, 10}},
};
inline constexpr std::array kAssignmentWords{
    Choice<const evidence::Assignment*>{"one_mass", nullptr},
    Choice<const evidence::Assignment*>{"reinforced", &evidence::kReinforced},
    Choice<const evidence::Assignment*>{"isopignistic", &evidence::kIsopignistic},
};

}  // namespace iog::tools
