// A plot of curves or points, drawn by gnuplot as SVG.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace iog::tools {

struct Series {
  enum class Style : std::uint8_t { kLine, kPoints, kLineAndPoints, kSteps, kBars };

  std::string name;
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
};

// The same bytes for the same plot. UsageError if gnuplot is missing or the file cannot be written.
void write_svg(const Plot& plot, const std::string& path);

}  // namespace iog::tools
