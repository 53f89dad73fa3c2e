// Table 4.2 and figure 4.11 of the thesis: what walking in integers misses. The same beams, walked
// as other libraries do.
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "lab/experiments/experiments.hpp"
#include "lab/experiments/traversal/traversal_trial.hpp"
#include "lab/reference/peer_walks.hpp"

namespace iog::lab {
namespace {

using reference::Cell;
using Cells = std::vector<Cell>;

std::string_view name_of(Rounding rounding) {
  return rounding == Rounding::kNearest ? "nearest" : "down";
}

std::string_view name_of(Stand stand) {
  switch (stand) {
    case Stand::kCorner:
      return "corner";
    case Stand::kCellCentre:
      return "cell_centre";
    case Stand::kOppositeCentre:
      return "opposite_centre";
  }
  return "";
}

std::string_view name_of(Beams beams) { return beams == Beams::kAll ? "all" : "oblique"; }

Table resolutions() {
  Table table("traversal_accuracy", {"resolution", "rounding", "stand", "beams", "crossed_cells",
                                     "found_cells", "beside_cells"});
  for (const int resolution : kResolutions) {
    for (const Rounding rounding : {Rounding::kNearest, Rounding::kDown}) {
      const CellWalk walk = discrete_walk(resolution, rounding);
      for (const auto& [stand, beams] :
           {std::pair{Stand::kCorner, Beams::kAll}, std::pair{Stand::kCorner, Beams::kOblique},
            std::pair{Stand::kCellCentre, Beams::kAll}}) {
        const Coverage found = cover(walk, stand, beams);
        table.row(resolution, name_of(rounding), name_of(stand), name_of(beams), found.crossed,
                  found.found, found.beside);
      }
    }
  }
  return table;
}

Table expectations() {
  Table table("traversal_expected", {"resolution", "missed_share"});
  const std::uint64_t crossed =
      cover(discrete_walk(kResolutions.front(), Rounding::kNearest), Stand::kCorner).crossed;
  for (const int resolution : kResolutions) {
    table.row(resolution, expected_misses(resolution, crossed));
  }
  return table;
}

Cell cell_of(CellPoint point) {
  return {static_cast<std::int32_t>(std::floor(point.x)),
          static_cast<std::int32_t>(std::floor(point.y))};
}

template <typename Walk>
CellWalk between_cells(Walk walk) {
  return [walk](CellPoint start, CellPoint end) { return walk(cell_of(start), cell_of(end)); };
}

Cells amanatides_woo_in_float(CellPoint start, CellPoint end) {
  const auto single = [](CellPoint point) {
    return reference::CellPoint<float>{static_cast<float>(point.x), static_cast<float>(point.y)};
  };
  Cells cells;
  reference::walk_amanatides_woo(single(start), single(end),
                                 [&cells](Cell cell) { cells.push_back(cell); });
  return cells;
}

Table peers() {
  Table table("traversal_peers", {"walk", "stand", "crossed_cells", "found_cells", "beside_cells"});
  const std::array<std::pair<std::string_view, CellWalk>, 7> walks{
      {{"discrete", discrete_walk(1024, Rounding::kNearest)},
       {"amanatides_woo_double", reference::cells_amanatides_woo},
       {"amanatides_woo_float", amanatides_woo_in_float},
       {"like_cartographer", reference::cells_like_cartographer},
       {"bresenham", between_cells(reference::cells_bresenham)},
       {"like_nav2", between_cells(reference::cells_like_nav2)},
       {"like_mrpt", between_cells(reference::cells_like_mrpt)}}};
  for (const auto& [name, walk] : walks) {
    for (const Stand stand : {Stand::kCorner, Stand::kCellCentre, Stand::kOppositeCentre}) {
      const Coverage found = cover(walk, stand);
      table.row(name, name_of(stand), found.crossed, found.found, found.beside);
    }
  }
  return table;
}

}  // namespace

Tables traversal_accuracy(const Input& /*input*/) {
  return {resolutions(), expectations(), peers()};
}

}  // namespace iog::lab
