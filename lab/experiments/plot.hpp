// A plot of curves or points, drawn by gnuplot as SVG.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace iog::lab {

struct Series {
  // kSteps: a point's value holds up to the next point's x. kBars: a point's bar stands at its x,
  // beside those of the plot's other bars.
  enum class Style : std::uint8_t { kLine, kPoints, kLineAndPoints, kSteps, kBars };

  std::string name;  // empty: not in the legend
  std::vector<std::pair<double, double>> points;
  Style style = Style::kLine;
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool has_log_x = false;
  bool has_log_y = false;
  std::vector<Series> series;  // colours that the colour-blind can tell apart, in this order
  std::vector<std::pair<double, std::string>> x_names = {};  // at these x, instead of numbers
};

// The same bytes for the same plot. UsageError if gnuplot is missing or the file cannot be written.
void write_svg(const Plot& plot, const std::string& path);

}  // namespace iog::lab
