// What a scan point is worth under each epsilon, and whether the cell that holds it takes it.
#pragma once

#include <cstdint>

#include "lab/experiments/experiment.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {

// Steps are those from the 1D cell k of the scan point. The farthest stands for all further ahead.
[[nodiscard]] Table model_of_steps();           // their probabilities
[[nodiscard]] Table indexes_of_steps();         // their indexes, by each epsilon of kSweep
[[nodiscard]] Table recursive_sets_of_sweep();  // the sets of kSweep

// Hits at random ranges and directions, and how many of them do not give their own cell the index
// of cell k.
[[nodiscard]] Table displaced_hits(const tools::CatalogueEntry& car, std::uint64_t seed);

}  // namespace iog::lab
