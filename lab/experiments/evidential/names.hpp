// What the tables of the evidential thesis call its choices.
#pragma once

#include <array>
#include <string_view>

#include "lab/reference/evidential/lidar_models.hpp"
#include "lab/reference/evidential/perception.hpp"

namespace iog::lab {

template <typename Choice>
struct Named {
  std::string_view name;
  Choice choice;
};
template <typename Choice>
Named(const char*, Choice) -> Named<Choice>;

inline constexpr std::array kAgeings{
    Named{"classical", reference::evidential::Ageing::kClassical},
    Named{"conservative", reference::evidential::Ageing::kConservative},
    Named{"optimistic", reference::evidential::Ageing::kOptimistic},
    Named{"proportional", reference::evidential::Ageing::kProportional},
    Named{"contextual", reference::evidential::Ageing::kContextual}};

inline constexpr std::array kTemporalRules{
    Named{"the thesis's", reference::evidential::TemporalRule::kThesis},
    Named{"conjunctive", reference::evidential::TemporalRule::kConjunctive},
    Named{"Dempster", reference::evidential::TemporalRule::kDempster},
    Named{"Yager", reference::evidential::TemporalRule::kYager},
    Named{"disjunctive", reference::evidential::TemporalRule::kDisjunctive}};

inline constexpr std::array kLidarModels{
    Named{"multi-echo", reference::evidential::LidarModel::kMultiEcho},
    Named{"reinforced", reference::evidential::LidarModel::kReinforced},
    Named{"imprecise", reference::evidential::LidarModel::kImprecise}};

inline constexpr std::array kSpecialisations{
    Named{"every set", reference::evidential::Specialised::kEverySet},
    Named{"occupied sets", reference::evidential::Specialised::kOccupiedSets}};

// By map class; 0 is no map.
inline constexpr std::array kContexts{Named{"none", reference::evidential::Set{0}},
                                      Named{"road", reference::evidential::kRoad},
                                      Named{"intermediate", reference::evidential::kIntermediate},
                                      Named{"building", reference::evidential::kBuilding}};

}  // namespace iog::lab
