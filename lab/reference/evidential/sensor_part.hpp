// What a cell of the thesis's grid knows without its map: the lumping under which the map can be
// left out of every scan.
//
// All that is done to a cell is linear in its masses and in those of the scan. So it is enough to
// ask of single sets whether forgetting the map and then doing something is doing it and then
// forgetting the map.
#pragma once

#include <vector>

#include "lab/reference/evidential/perception.hpp"

namespace iog::lab::reference::evidential {

// The set that a cell without map would have in place of this one: the map takes single classes out
// of {D, N} and out of {I, S, U}.
[[nodiscard]] Set without_map(Set set);
[[nodiscard]] MassFunction without_map(const MassFunction& mass);

// What a scan that says both and the map of these classes say together. 0: no map.
[[nodiscard]] MassFunction some_scan_with(Set map_classes);

// All sets but the empty one that the grid of a cell with this map can have, by the thesis's rule.
[[nodiscard]] std::vector<Set> grid_sets(Set map_classes, const ScanParameters& parameters);

[[nodiscard]] bool commutes_with_the_scan(Set set, Set map_classes);
[[nodiscard]] bool commutes_with_specialisation(Set set, Specialised which);
[[nodiscard]] bool commutes_with_ageing(Set set, const ScanParameters& parameters);

// The largest difference of what two cells know of free, occupied and moving, and of how long it
// has been occupied.
[[nodiscard]] double sensor_part_difference(const PerceptionCell& one, const PerceptionCell& other);

}  // namespace iog::lab::reference::evidential
