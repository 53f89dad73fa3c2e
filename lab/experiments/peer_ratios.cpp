#include "lab/experiments/peer_ratios.hpp"

#include <sstream>
#include <stdexcept>

#include "lab/experiments/peers_page.hpp"

namespace iog::lab {
namespace {

// "≥ 1,000" is 1000, "0.75, not met" is 0.75: digits and a point, up to a blank behind them.
double number_in(const std::string& cell) {
  std::string digits;
  for (const char letter : cell) {
    const bool belongs = ('0' <= letter && letter <= '9') || letter == '.';
    if (belongs) {
      digits += letter;
    } else if (letter == ' ' && !digits.empty()) {
      break;
    }
  }
  return std::stod(digits);
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream rest(row.substr(1));
  for (std::string cell; std::getline(rest, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' ');
    const std::size_t last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

}  // namespace

std::vector<PeerRatio> peer_ratios() {
  std::istringstream page{std::string(kPeersPage)};
  std::vector<PeerRatio> ratios;
  bool is_there = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) {
      is_there = line == "## Goals";
    }
    const bool is_row = is_there && line.starts_with("| ") && line.find("≥") != std::string::npos;
    const std::vector<std::string> cells = is_row ? cells_of(line) : std::vector<std::string>();
    if (cells.size() >= 5) {
      ratios.push_back({.peer = cells[0],
                        .what = cells[1],
                        .goal = number_in(cells[2]),
                        .city = number_in(cells[3]),
                        .ring_road = number_in(cells[4])});
    }
  }
  if (ratios.empty()) {
    throw std::out_of_range("docs/peers.md: no goals");
  }
  return ratios;
}

}  // namespace iog::lab
