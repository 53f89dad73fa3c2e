// Walks like those of other grid libraries, written anew from what their sources are seen to do, to
// compare which cells they visit. Only the walk: what the libraries do at its ends is their own.
//
// Not here, because it would be the same again: OctoMap walks like Amanatides and Woo
// (reference/traversal.hpp) in double precision.
#pragma once

#include <vector>

#include "lab/reference/traversal.hpp"

namespace iog::lab::reference {

// Like costmap_2d and Nav2 (raytraceLine): from the cell of the sensor to the cell of the hit, one
// cell per step of the longer axis; the error starts at half the longer extent, rounded down, and
// is compared with the whole. |coordinate| < 2^29.
[[nodiscard]] std::vector<Cell> cells_like_nav2(Cell from, Cell to);

// Like MRPT (COccupancyGridMap2D, simple rays): from cell to cell in as many equal steps as the
// longer extent, in fixed point with 9 fraction bits. A step is rounded to the nearest 1/512; the
// position starts at the cell's lower corner, not at its centre, and is rounded down. The last cell
// is `to` itself, which MRPT marks. |coordinate| < 2^20.
[[nodiscard]] std::vector<Cell> cells_like_mrpt(Cell from, Cell to);

// Like Cartographer (RayToPixelMask with kSubpixelScale = 1000): both ends move to the centre of
// the 1/1000 of a cell that holds them, and every cell that the line between them crosses is found
// column by column, in integers. From left to right, whatever the line's direction. A line through
// a corner steps diagonally. |coordinate| < 2^17.
[[nodiscard]] std::vector<Cell> cells_like_cartographer(CellPoint<double> start,
                                                        CellPoint<double> end);

}  // namespace iog::lab::reference
