#include "lab/experiments/choice_pictures.hpp"

#include <algorithm>

#include "grid/frame_fusion.hpp"
#include "tools/formats/picture/grid_picture.hpp"

namespace iog::lab {
namespace {

constexpr std::size_t kColumns = 3;
constexpr int kGap = 8;
constexpr int kLabelRows = 14;
constexpr tools::Colour kPaper{255, 255, 255};
constexpr tools::Colour kInk{20, 20, 20};
constexpr tools::Colour kLostHit{214, 0, 150};
// The strongest colours: what is certain.
constexpr double kSurelyFree = -127;
constexpr double kSurelyOccupied = 127;

int pixels(std::size_t count) { return static_cast<int>(count); }

double index_of(CellState state) {
  switch (state) {
    case CellState::kFree:
      return kSurelyFree;
    case CellState::kOccupied:
      return kSurelyOccupied;
    case CellState::kUnknown:
      break;
  }
  return 0;
}

void paste(const tools::Canvas& panel, int column, int row, tools::Canvas& sheet) {
  for (int y = 0; y < panel.height(); ++y) {
    for (int x = 0; x < panel.width(); ++x) {
      sheet.set(column + x, row + y, panel.at(x, y));
    }
  }
}

}  // namespace

void ContactSheet::add(const std::string& label,
                       const std::function<tools::Colour(std::size_t)>& colour_at) {
  const int side = pixels(crop_.cells);
  tools::Canvas panel(side, side + kLabelRows, kPaper);
  panel.text(0, 3, label, kInk);
  for (std::size_t left = 0; left < crop_.cells; ++left) {
    for (std::size_t up = 0; up < crop_.cells; ++up) {
      const std::size_t cell = (crop_.first_y + left) * grid::kStride + crop_.first_x + up;
      panel.set(side - 1 - pixels(left), kLabelRows + side - 1 - pixels(up), colour_at(cell));
    }
  }
  panels_.push_back(panel);
}

void ContactSheet::add_key() {
  const int side = pixels(crop_.cells);
  tools::Canvas panel(side, side + kLabelRows, kPaper);
  constexpr int kSquare = 18;
  int row = kLabelRows;
  const auto explain_colour = [&](tools::Colour colour, const std::string& words) {
    panel.fill(0, row, kSquare, kSquare, colour);
    panel.text(kSquare + 8, row + 6, words, kInk);
    row += kSquare + 6;
  };
  const auto explain = [&](double index, const std::string& words) {
    explain_colour(tools::colour_of_index(index), words);
  };
  explain(10, "occupied, p above 0.88");
  explain(2, "occupied, one hit: p 0.6");
  explain(0, "unknown");
  explain(-14, "free, one beam: p 0.06");
  explain(-56, "free, p below 0.00002");
  explain_colour(kLostHit, "a beam ended here, yet free");
  row += 6;
  for (const char* const words : {"25 m by 25 m, forward is up", "truth: what ideal scanners see",
                                  "hits: where beams ended"}) {
    panel.text(0, row, words, kInk);
    row += kLabelRows;
  }
  panels_.push_back(panel);
}

tools::Canvas ContactSheet::draw() const {
  const int side = pixels(crop_.cells);
  const std::size_t rows = (panels_.size() + kColumns - 1) / kColumns;
  const int row_height = side + kLabelRows + kGap;
  tools::Canvas sheet(pixels(kColumns) * (side + kGap) + kGap, pixels(rows) * row_height + kGap,
                      kPaper);
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    paste(panels_[i], kGap + pixels(i % kColumns) * (side + kGap),
          kGap + pixels(i / kColumns) * row_height, sheet);
  }
  return sheet;
}

tools::Canvas picture_of(const PictureFrame& frame, const std::vector<Choice>& choices) {
  const ByStep<double> values = probabilities(model_of(*frame.car));
  ContactSheet sheet({});
  std::vector<std::uint32_t> hits;
  const auto is_hit = [&hits](std::size_t cell) {
    return std::binary_search(hits.begin(), hits.end(), cell);
  };
  for (const Choice& choice : choices) {
    const FrameEvidence evidence = project(*frame.car->vehicle, frame.points, choice.geometry);
    const FusedGrid grid = fuse(evidence, values, choice);
    hits = evidence.hits;
    std::sort(hits.begin(), hits.end());
    sheet.add(choice.name, [&](std::size_t cell) {
      const double index = grid.index_at(cell);
      return index < 0 && is_hit(cell) ? kLostHit : tools::colour_of_index(index);
    });
  }
  sheet.add("truth", [&frame](std::size_t cell) {
    return tools::colour_of_index(index_of(frame.truth[cell]));
  });
  sheet.add("hits", [&](std::size_t cell) {
    return tools::colour_of_index(is_hit(cell) ? kSurelyOccupied : 0);
  });
  sheet.add_key();
  return sheet.draw();
}

}  // namespace iog::lab
