#include "lab/experiments/traversal_peers.hpp"

#include <cmath>

#include "lab/experiments/traversal_trial.hpp"
#include "lab/reference/peer_walks.hpp"

namespace iog::lab {
namespace {

using reference::Cell;
using Cells = std::vector<Cell>;

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

}  // namespace

void add_peer_walks(Section& section) {
  struct Named {
    const char* name;
    CellWalk walk;
  };
  const std::vector<Named> walks{
      {"ours, r = 1024", discrete_walk(1024, Rounding::kNearest)},
      {"Amanatides and Woo, double, as in OctoMap", reference::cells_amanatides_woo},
      {"Amanatides and Woo, float", amanatides_woo_in_float},
      {"like Cartographer: thousandths of a cell", reference::cells_like_cartographer},
      {"Bresenham", between_cells(reference::cells_bresenham)},
      {"like Nav2 and costmap_2d", between_cells(reference::cells_like_nav2)},
      {"like MRPT: 9 fraction bits", between_cells(reference::cells_like_mrpt)}};
  std::vector<std::vector<std::string>> rows;
  for (const Named& named : walks) {
    std::vector<std::string> row{named.name};
    for (const Stand stand : {Stand::kCorner, Stand::kCellCentre, Stand::kOppositeCentre}) {
      const Coverage coverage = cover(named.walk, stand);
      row.push_back(percent(coverage.share_found(), 2));
      row.push_back(percent(coverage.share_beside(), 2));
    }
    rows.push_back(row);
  }
  const Coverage bresenham = cover(walks[4].walk, Stand::kCorner);
  Markdown& body = section.body;
  body.subheading("The same beams, walked as others do");
  body.paragraph(
      "Walks that other libraries use, written anew for this comparison from what their sources "
      "are seen to do (`lab/reference/peer_walks.hpp`); not their code, and without what they "
      "do besides. From the south-west corner, from the centre of the first cell, and from the "
      "centre of the north-east cell looking south-west; *beside*: visited though not crossed, as "
      "a share of the crossed.");
  body.table(
      {"walk", "corner: found", "beside", "centre: found", "beside", "south-west: found", "beside"},
      rows);
  body.paragraph(
      "Bresenham's line has one cell per step of its longer axis, here " +
      percent(bresenham.share_found() + bresenham.share_beside(), 0) +
      " as many as are crossed, so that it cannot find more; and it joins the centres of two "
      "cells, wherever in them the beam begins and ends. Nav2 starts from half of the longer "
      "extent, rounded down, but an odd extent has no ties: its walk is Bresenham's, cell for "
      "cell. MRPT's starts at a cell's lower corner and rounds its position down, so that it lies "
      "to one side of the beam by up to a cell, and to another side for another direction. "
      "Cartographer's is exact between the centres of the thousandths that hold the ends, so that "
      "the lidar, too, moves by half a thousandth. In single precision, the shares of the line "
      "that Amanatides and Woo add up lead a beam around the other side of a corner now and "
      "then.");
}

}  // namespace iog::lab
