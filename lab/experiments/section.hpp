// A section of the results: what one table or figure of the papers claims, and what is found here.
//
// tests/e2e/results makes the page again, without recordings, and compares it with docs/results.md.
// So that it can tell what must be the same, a section keeps three rules:
// - What comes from a recording stands below a subheading that has the word "recording" in it, and
//   only if there are recordings. Such a claim has the word in `place` or `what`. Nothing else of
//   the section changes with the recordings.
// - A paragraph, an item of a list or a row of a table with a number that was timed or is peculiar
//   to the machine says "on this PC" in its words.
// - The file that a plot or picture of a recording is drawn to has "recording" in its name.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/experiments/experiment.hpp"
#include "lab/experiments/markdown.hpp"
#include "lab/experiments/plot.hpp"
#include "tools/formats/picture/canvas.hpp"

namespace iog::lab {

// How a claim of the papers fares here. Found by comparing numbers, not chosen by hand.
enum class Verdict : std::uint8_t { kEquals, kBeats, kFallsShort, kDeparts };

// One line of the overview.
struct Claim {
  std::string place;  // "table 4.2"
  std::string what;   // "cells found at r = 100"
  std::string paper;
  std::string ours;
  Verdict verdict = Verdict::kEquals;
  std::string reason;  // of a difference; may be empty for kEquals
};

struct Section {
  std::vector<Claim> claims;
  Markdown body;
};

struct TablesInput {
  std::uint64_t seed = 1;     // of the simulated drive
  std::uint32_t seconds = 2;  // 25 frames a second
  std::vector<Recording> recordings;
  std::string figures;  // the folder for plots and pictures; empty: none are drawn
};

// The folder's name if none is given: what the text says when nothing is drawn.
inline constexpr const char* kFiguresFolder = "results";

// Draws if pictures are wanted, and says how the text names the file: "<folder's name>/<name>".
[[nodiscard]] std::string draw(const TablesInput& input, const std::string& name, const Plot& plot);
[[nodiscard]] std::string draw(const TablesInput& input, const std::string& name,
                               const tools::Canvas& canvas);

}  // namespace iog::lab
