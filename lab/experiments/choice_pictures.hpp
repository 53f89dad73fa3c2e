// One frame's grid under several choices, side by side.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lab/evaluation/cell_state.hpp"
#include "lab/evidence/projection.hpp"
#include "lab/experiments/fusion_trial.hpp"
#include "tools/formats/picture/canvas.hpp"

namespace iog::lab {

// A square of the grid, 25 m wide, with the car at its lower edge.
struct Crop {
  std::size_t first_x = 530;  // cells, at the front bumper
  std::size_t first_y = 387;
  std::size_t cells = 250;
};

// Panels in rows of three, a pixel for a cell, x (forward) up and y to the left, as in
// picture_of().
class ContactSheet {
 public:
  explicit ContactSheet(const Crop& crop) : crop_(crop) {}

  // colour_at: of a cell, y * grid::kStride + x.
  void add(const std::string& label, const std::function<tools::Colour(std::size_t)>& colour_at);

  // What the colours mean.
  void add_key();

  [[nodiscard]] tools::Canvas draw() const;

 private:
  Crop crop_;
  std::vector<tools::Canvas> panels_;
};

// A frame whose truth is known, to draw under any choice.
struct PictureFrame {
  const tools::CatalogueEntry* car = nullptr;
  FramePoints points;
  std::vector<CellState> truth;
};

// The choices' grids, with the cells in which a beam ended and which come out free in a colour of
// their own; then the truth that they are scored by, all cells in which beams ended, and a key.
[[nodiscard]] tools::Canvas picture_of(const PictureFrame& frame,
                                       const std::vector<Choice>& choices);

}  // namespace iog::lab
