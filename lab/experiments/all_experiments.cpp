#include <array>

#include "lab/experiments/experiments.hpp"

namespace iog::lab {
namespace {

// The longest first, so that no processor waits for one of them at the end.
constexpr auto kExperiments = std::to_array<Experiment>({
    {"map_quality", map_quality},
    {"perception_rules", perception_rules},
    {"evidential_street", evidential_street},
    {"perception_street", perception_street},
    {"evidential_roc", evidential_roc},
    {"evidential_city", evidential_city},
    {"perception_poses", perception_poses},
    {"recursive_sets", recursive_sets},
    {"inverse_sensor_model", inverse_sensor_model},
    {"profiles", profiles},
    {"traversal_accuracy", traversal_accuracy},
    {"scene_load", scene_load},
    {"worst_frames", worst_frames},
    {"numerical_quality", numerical_quality},
    {"quadtree", quadtree},
    {"stream", stream_of_tiles},
    {"many_core", many_core},
    {"order_of_fusion", order_of_fusion},
    {"detection_quality", detection_quality},
    {"price_of_hits_win", price_of_hits_win},
    {"free_on_things", free_on_things},
    {"evidential_tables", evidential_tables},
    {"evidential_cell", evidential_cell},
    {"evidential_map", evidential_map},
    {"evidential_cells", evidential_cells},
});

}  // namespace

std::span<const Experiment> all_experiments() { return kExperiments; }

}  // namespace iog::lab
