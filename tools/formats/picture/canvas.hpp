// A picture in memory: pixels, lines, circles and small letters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace iog::tools {

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Colour&, const Colour&) = default;
};

// `share` of b in a, 0 ... 1.
[[nodiscard]] Colour mixed(Colour a, Colour b, double share);

// Column 0 is left, row 0 is on top. What lies outside is not drawn.
class Canvas {
 public:
  Canvas(int width, int height, Colour background);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Colour at(int column, int row) const;

  void set(int column, int row, Colour colour, double opacity = 1);
  void fill(int column, int row, int width, int height, Colour colour, double opacity = 1);
  void line(double from_column, double from_row, double to_column, double to_row, Colour colour,
            double opacity = 1);
  void circle(double column, double row, double radius, Colour colour, double opacity = 1);

  // Letters of 5 by 7 dots, each dot `scale` pixels; (column, row) is the upper left corner. Small
  // letters are shown as capitals, a copyright sign as (C), unknown ones as a space.
  void text(int column, int row, std::string_view words, Colour colour, int scale = 1);
  [[nodiscard]] static int text_width(std::string_view words, int scale = 1);

  // UsageError if the file cannot be written.
  void write_png(const std::string& path) const;

 private:
  [[nodiscard]] std::size_t place(int column, int row) const;

  int width_;
  int height_;
  std::vector<Colour> pixels_;
};

}  // namespace iog::tools
