// The experiments, in the order of the page that shows them.
#pragma once

#include "lab/experiments/experiment.hpp"

namespace iog::lab {

[[nodiscard]] Tables recursive_sets(const Input& input);  // thesis, figure 3.6, section 3.4.6.3
[[nodiscard]] Tables inverse_sensor_model(const Input& input);  // thesis, table 4.1
[[nodiscard]] Tables profiles(const Input& input);              // table 4.3, figures 4.6, 4.14
[[nodiscard]] Tables traversal_accuracy(const Input& input);    // table 4.2, figure 4.11
[[nodiscard]] Tables scene_load(const Input& input);         // thesis, table 4.4: whose load it is
[[nodiscard]] Tables worst_frames(const Input& input);       // and what a frame may have at most
[[nodiscard]] Tables numerical_quality(const Input& input);  // table 4.6
[[nodiscard]] Tables quadtree(const Input& input);           // thesis, table 4.7, section 4.3.2.2
[[nodiscard]] Tables stream_of_tiles(const Input& input);    // bytes of a frame, bad and slow links
[[nodiscard]] Tables many_core(const Input& input);          // many-core paper, table I
[[nodiscard]] Tables perception_rules(const Input& input);   // classes of the perception grid
[[nodiscard]] Tables perception_street(const Input& input);  // of what stops
[[nodiscard]] Tables perception_poses(const Input& input);   // and when poses are bad
[[nodiscard]] Tables objects_roads(const Input& input);      // things with a speed on it
[[nodiscard]] Tables objects_street(const Input& input);     // and of what parks and leaves
[[nodiscard]] Tables hills_classes(const Input& input);      // and where the world is not flat
[[nodiscard]] Tables map_quality(const Input& input);        // names, by maps right and wrong
// M. Kurdej's thesis on map-aided evidential grids.
[[nodiscard]] Tables evidential_tables(const Input& input);  // tables 6.1 to 6.4
[[nodiscard]] Tables evidential_cell(const Input& input);    // figures 4.7, 5.6, 5.7, table 7.1
[[nodiscard]] Tables evidential_map(const Input& input);     // in every scan, or at the decision
[[nodiscard]] Tables evidential_city(const Input& input);    // its choices on the same drives
[[nodiscard]] Tables evidential_street(const Input& input);
[[nodiscard]] Tables evidential_sizes_city(const Input& input);  // ours, in cells of three sizes
[[nodiscard]] Tables evidential_sizes_street(const Input& input);
[[nodiscard]] Tables evidential_roc(const Input& input);  // the same, whatever the threshold

}  // namespace iog::lab
