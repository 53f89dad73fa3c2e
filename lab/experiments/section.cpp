#include "lab/experiments/section.hpp"

#include <filesystem>

namespace iog::lab {
namespace {

std::string path_in_text(const TablesInput& input, const std::string& name) {
  const std::string folder = std::filesystem::path(input.figures).filename().string();
  return (folder.empty() ? std::string(kFiguresFolder) : folder) + "/" + name;
}

}  // namespace

std::string draw(const TablesInput& input, const std::string& name, const Plot& plot) {
  if (!input.figures.empty()) {
    write_svg(plot, input.figures + "/" + name);
  }
  return path_in_text(input, name);
}

std::string draw(const TablesInput& input, const std::string& name, const tools::Canvas& canvas) {
  if (!input.figures.empty()) {
    canvas.write_png(input.figures + "/" + name);
  }
  return path_in_text(input, name);
}

}  // namespace iog::lab
