#include <array>

#include "lab/experiments/experiments.hpp"

namespace iog::lab {
namespace {

// The longest first, so that no processor waits for one of them at the end.
constexpr auto kExperiments = std::to_array<Experiment>({
    {"hills", "hills_classes", hills_classes},
    {"map_quality", "map_quality", map_quality},
    {"perception", "perception_rules", perception_rules},
    {"objects", "objects_street", objects_street},
    {"objects", "objects_roads", objects_roads},
    {"evidential", "evidential_sizes_street", evidential_sizes_street},
    {"evidential", "evidential_street", evidential_street},
    {"evidential", "evidential_sizes_city", evidential_sizes_city},
    {"perception", "perception_street", perception_street},
    {"evidential", "evidential_roc", evidential_roc},
    {"evidential", "evidential_city", evidential_city},
    {"perception", "perception_poses", perception_poses},
    {"recursive_sets", "recursive_sets", recursive_sets},
    {"inverse_sensor_model", "inverse_sensor_model", inverse_sensor_model},
    {"profiles", "profiles", profiles},
    {"traversal", "traversal_accuracy", traversal_accuracy},
    {"output_rates", "scene_load", scene_load},
    {"worst_frames", "worst_frames", worst_frames},
    {"numerical_quality", "numerical_quality", numerical_quality},
    {"quadtree", "quadtree", quadtree},
    {"stream", "stream", stream_of_tiles},
    {"many_core", "many_core", many_core},
    {"evidential", "evidential_tables", evidential_tables},
    {"evidential", "evidential_cell", evidential_cell},
    {"evidential", "evidential_map", evidential_map},
});

}  // namespace

std::span<const Experiment> all_experiments() { return kExperiments; }

}  // namespace iog::lab
