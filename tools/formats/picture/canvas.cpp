#include "tools/formats/picture/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <png.h>
#include <span>

#include "tools/formats/picture/font.hpp"
#include "tools/formats/picture/png_mark.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

constexpr double kPi = 3.14159265358979;

std::uint8_t mixed_channel(std::uint8_t a, std::uint8_t b, double share) {
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * share));
}

}  // namespace

Colour mixed(Colour a, Colour b, double share) {
  return {mixed_channel(a.red, b.red, share), mixed_channel(a.green, b.green, share),
          mixed_channel(a.blue, b.blue, share)};
}

Canvas::Canvas(int width, int height, Colour background)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background) {}

std::size_t Canvas::place(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(column);
}

Colour Canvas::at(int column, int row) const { return pixels_[place(column, row)]; }

void Canvas::set(int column, int row, Colour colour, double opacity) {
  if (column >= 0 && column < width_ && row >= 0 && row < height_) {
    Colour& pixel = pixels_[place(column, row)];
    pixel = mixed(pixel, colour, opacity);
  }
}

void Canvas::fill(int column, int row, int width, int height, Colour colour, double opacity) {
  for (int y = row; y < row + height; ++y) {
    for (int x = column; x < column + width; ++x) {
      set(x, y, colour, opacity);
    }
  }
}

void Canvas::line(double from_column, double from_row, double to_column, double to_row,
                  Colour colour, double opacity) {
  const double length = std::max(std::abs(to_column - from_column), std::abs(to_row - from_row));
  const int steps = std::max(1, static_cast<int>(std::ceil(length)));
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    set(static_cast<int>(std::floor(from_column + (to_column - from_column) * share)),
        static_cast<int>(std::floor(from_row + (to_row - from_row) * share)), colour, opacity);
  }
}

void Canvas::circle(double column, double row, double radius, Colour colour, double opacity) {
  // Steps of two thirds of a pixel, and no pixel twice in a row, which would show when blended.
  const int steps = std::max(8, static_cast<int>(radius * 2 * kPi * 1.5));
  int last_x = -1;
  int last_y = -1;
  for (int i = 0; i < steps; ++i) {
    const double angle = 2 * kPi * i / steps;
    const int x = static_cast<int>(std::floor(column + radius * std::cos(angle)));
    const int y = static_cast<int>(std::floor(row + radius * std::sin(angle)));
    if (x != last_x || y != last_y) {
      set(x, y, colour, opacity);
    }
    last_x = x;
    last_y = y;
  }
}

void Canvas::text(int column, int row, std::string_view words, Colour colour, int scale) {
  for (const char letter : spelled(words)) {
    const Glyph glyph = glyph_of(letter);
    for (int y = 0; y < kGlyphHeight; ++y) {
      for (int x = 0; x < kGlyphWidth; ++x) {
        if (is_dot(glyph, x, y)) {
          fill(column + x * scale, row + y * scale, scale, scale, colour);
        }
      }
    }
    column += (kGlyphWidth + 1) * scale;
  }
}

int Canvas::text_width(std::string_view words, int scale) {
  return static_cast<int>(spelled(words).size()) * (kGlyphWidth + 1) * scale;
}

void Canvas::write_png(const std::string& path) const {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_);
  image.height = static_cast<png_uint_32>(height_);
  image.format = PNG_FORMAT_RGB;
  static_assert(sizeof(Colour) == 3);
  png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::byte> png(bytes);
  if (png_image_write_to_memory(&image, png.data(), &bytes, 0, pixels_.data(), 0, nullptr) == 0) {
    throw UsageError(path + ": cannot be written: " + image.message);
  }
  OutputFile file(path);
  file.write(with_mark(std::span(png).first(bytes)));
  file.finish();
}

}  // namespace iog::tools
