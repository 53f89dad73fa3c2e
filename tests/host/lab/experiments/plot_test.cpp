#include "lab/experiments/plot.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::lab {
namespace {

std::string svg_of(const Plot& plot) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "plot.svg";
  write_svg(plot, path);
  const auto bytes = tools::read_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

Plot plot_with(Series::Style style, std::size_t series) {
  Plot plot{.title = "title", .x_label = "x of it", .y_label = "y of it", .series = {}};
  for (std::size_t i = 0; i < series; ++i) {
    const auto y = static_cast<double>(i + 1);
    plot.series.push_back(
        {.name = "series " + std::to_string(i), .points = {{1, y}, {10, 2 * y}}, .style = style});
  }
  return plot;
}

TEST(Plot, IsAnSvgOnWhiteWithItsWords) {
  const std::string svg = svg_of(plot_with(Series::Style::kLine, 2));
  EXPECT_TRUE(svg.starts_with("<?xml"));
  EXPECT_NE(svg.find("fill=\"#ffffff\""), std::string::npos);
  for (const char* words : {">title<", ">x of it<", ">y of it<", ">series 0<", ">series 1<"}) {
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  }
}

TEST(Plot, TheSamePlotHasTheSameBytes) {
  for (const auto style :
       {Series::Style::kLine, Series::Style::kPoints, Series::Style::kLineAndPoints,
        Series::Style::kSteps, Series::Style::kBars}) {
    const Plot plot = plot_with(style, 3);
    EXPECT_EQ(svg_of(plot), svg_of(plot));
  }
}

// Words are words: gnuplot's quotes, commands and back quotes, a shell's, and XML's.
TEST(Plot, NoWordIsACommand) {
  const tests::TemporaryFolder folder;
  const std::string trap = folder / "trap";
  const std::string evil = "it's `touch " + trap + "` $(touch " + trap + ") '; system('touch " +
                           trap + "')\nset output '" + trap + "'\n# \\ \" <&>_{x}^2";
  Plot plot = plot_with(Series::Style::kLine, 1);
  plot.title = plot.x_label = plot.y_label = plot.series[0].name = evil;
  plot.x_names = {{1, evil}};
  const std::string svg = svg_of(plot);
  EXPECT_FALSE(std::filesystem::exists(trap));
  for (const char* words : {">it's `touch ", "; system('touch ", " # \\ \" &lt;&amp;>_{x}^2<"}) {
    EXPECT_GE(count(svg, words), 5U) << words;
  }
}

// Thin lines and small markers of one hue are alike to many readers, and to every printer.
TEST(Plot, SevenSeriesDifferInColourAndInShape) {
  const std::string svg = svg_of(plot_with(Series::Style::kLineAndPoints, 7));
  for (const char* colour : {"0, 114, 178", "213,  94,   0", "0, 158, 115", "204, 121, 167",
                             "230, 159,   0", "86, 180, 233"}) {
    EXPECT_NE(svg.find(colour), std::string::npos) << colour;
  }
  EXPECT_GE(count(svg, "stroke-dasharray"), 6U);
}

TEST(Plot, WhatIsNotFiniteOrNotPositiveOnALogAxisIsLeftOut) {
  Plot plot = plot_with(Series::Style::kLineAndPoints, 1);
  plot.has_log_x = plot.has_log_y = true;
  plot.series[0].points = {{1, 1}, {2, 0}, {3, -1}, {4, std::strtod("nan", nullptr)}, {5, 9}};
  EXPECT_EQ(count(svg_of(plot), " transform='translate("), 3U);  // two points and the legend's
}

TEST(Plot, AFolderThatIsNotThereIsWrongUse) {
  EXPECT_THROW(write_svg(plot_with(Series::Style::kLine, 1), "/nowhere/plot.svg"),
               tools::UsageError);
}

TEST(Plot, AMissingGnuplotIsNamedWithItsPackage) {
  const std::string before = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const tests::TemporaryFolder folder;
  try {
    write_svg(plot_with(Series::Style::kLine, 1), folder / "missing.svg");
    ADD_FAILURE() << "a plot without gnuplot";
  } catch (const tools::UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("gnuplot-nox"), std::string::npos);
  }
  setenv("PATH", before.c_str(), 1);
}

}  // namespace
}  // namespace iog::lab
