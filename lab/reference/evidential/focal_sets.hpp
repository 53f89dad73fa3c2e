// Which sets can ever carry mass: the focal sets of a family of mass functions that is closed under
// what is done to them. They are what a grid would have to store.
#pragma once

#include <bitset>
#include <cstddef>
#include <functional>
#include <span>

#include "lab/reference/evidential/mass_function.hpp"

namespace iog::lab::reference::evidential {

// Bit a: set a.
using FocalSets = std::bitset<std::size_t{1} << MassFunction::kMostElements>;

[[nodiscard]] FocalSets focal_sets(const MassFunction& mass);

// Something that is done to a mass function. It gives mass to a set whenever it would for any other
// masses of the same focal sets, as sums of products of positive numbers do.
using Operation = std::function<MassFunction(const MassFunction&)>;

// All that the operations can lead to from a vacuous mass function, in any order, any number of
// times.
[[nodiscard]] FocalSets closure(int elements, std::span<const Operation> operations);

}  // namespace iog::lab::reference::evidential
