// Table 4.7 of the thesis and the rest of its section 4.3.2.2: the grid in a quadtree.
#include "lab/experiments/quadtree_compactness.hpp"
#include "lab/experiments/quadtree_storage.hpp"
#include "lab/experiments/quadtree_time.hpp"
#include "lab/experiments/sections.hpp"

namespace iog::lab {

Section quadtree(const TablesInput& input) {
  Section section;
  section.body.heading("The grid as a quadtree: table 4.7");
  section.body.paragraph(
      "A quadtree stores a grid by blocks: a leaf is a square of cells that all have the same "
      "index and is not part of a larger one, a node is a leaf or stands for the four parts of a "
      "square that is none. The thesis keeps such a tree up to date at every cell, by splits and "
      "merges (section 3.5); `src/tree/split_merge_tree.hpp` does the same and is the "
      "*reference*. "
      "`src/tree/linear_quadtree.hpp` has the same leaves without pointers, built bottom-up from "
      "the fused array once a frame: the *linear* tree. The ring road is the drive that is taken "
      "for the thesis's load, the city is a lighter one.");
  add_compactness(input, section);
  add_storage(input, section);
  add_tree_time(input, section);
  return section;
}

}  // namespace iog::lab
