#include "lab/experiments/quadtree_storage.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "lab/experiments/fused_drive.hpp"
#include "lab/experiments/quadtree_grids.hpp"
#include "lab/experiments/quadtree_pair.hpp"

namespace iog::lab {
namespace {

constexpr double kArrayBytes = geometry::kCellCount;
constexpr double kMebibyte = 1 << 20;

// A node of the thesis: two pointers of four bytes and an index. The reference has one number in
// place of the pointers.
constexpr double kThesisNodeBytes = 9;
constexpr double kReferenceNodeBytes = sizeof(tree::Node) + sizeof(index::OccupancyIndex);
constexpr double kThesisMebibytes = 3.15;

constexpr double kGoalOfArray = 0.5;

// A grid, or the mean of several.
struct Stored {
  std::string name;
  double leaves = 0;
  double nodes = 0;
  double linear_bytes = 0;

  [[nodiscard]] double of_array() const { return linear_bytes / kArrayBytes; }
};

Stored stored(const std::string& name, const QuadtreeSize& size) {
  return {.name = name,
          .leaves = static_cast<double>(size.leaves),
          .nodes = static_cast<double>(size.nodes),
          .linear_bytes = static_cast<double>(size.linear_bytes)};
}

std::vector<Stored> store_frames(const char* scene, const std::string& words,
                                 const TablesInput& input, QuadtreePair& trees) {
  std::vector<Stored> frames;
  fuse_drive(scene, input.seed, input.seconds, vehicle::FusionRule::kHitsWin, [&](GridCells cells) {
    const std::string name = words + ", frame " + std::to_string(frames.size());
    frames.push_back(stored(name, trees.build(cells, name)));
  });
  return frames;
}

// The frames of a drive.
struct FramesStored {
  Stored mean;
  Stored largest;  // by its bytes
  double frames = 0;
};

FramesStored summary_of(const std::string& words, const std::vector<Stored>& frames) {
  FramesStored drive{.mean = {.name = words + ", mean"},
                     .largest = *std::ranges::max_element(frames, {}, &Stored::linear_bytes),
                     .frames = static_cast<double>(frames.size())};
  for (const Stored& frame : frames) {
    drive.mean.leaves += frame.leaves / drive.frames;
    drive.mean.nodes += frame.nodes / drive.frames;
    drive.mean.linear_bytes += frame.linear_bytes / drive.frames;
  }
  drive.largest.name = words + ", largest frame";
  return drive;
}

// All that was built and compared.
struct Outcome {
  FramesStored ring_road;
  FramesStored city;
  std::vector<Stored> drawn;  // the worst, a checkerboard, last

  [[nodiscard]] double frames() const { return ring_road.frames + city.frames; }
  [[nodiscard]] double grids() const { return frames() + static_cast<double>(drawn.size()); }
};

Outcome store_all(const TablesInput& input) {
  QuadtreePair trees;
  const auto drive = [&](const char* scene, const std::string& words) {
    return summary_of(words, store_frames(scene, words, input, trees));
  };
  Outcome outcome{
      .ring_road = drive("ring_road", "ring road"), .city = drive("city", "city"), .drawn = {}};
  for (const NamedGrid& grid : drawn_grids(input.seed)) {
    const auto cells = std::span(grid.cells).first<geometry::kCellCount>();
    outcome.drawn.push_back(stored(grid.name, trees.build(cells, grid.name)));
  }
  return outcome;
}

void describe_check(const Outcome& outcome, Markdown& body) {
  body.subheading("Nothing is lost");
  body.paragraph(
      "Both trees were built of " + grouped(outcome.grids()) +
      " grids while this page was made: " + grouped(outcome.ring_road.frames) +
      " frames of the ring road and " + grouped(outcome.city.frames) +
      " of the city, as the firmware fuses them (hits_win, blurring, epsilon = 0.05), and the " +
      grouped(static_cast<double>(outcome.drawn.size())) +
      " drawn grids of the next table. Every time the leaves of the linear tree cover each of the "
      "1,048,576 cells once and have the index that the array has there, and the reference has the "
      "same leaves. A grid that differed would have ended `experiments` with its name instead of "
      "this page.");
}

std::vector<std::string> row_of(const Stored& stored) {
  return {stored.name,
          grouped(stored.leaves),
          grouped(stored.nodes),
          grouped(stored.linear_bytes),
          fixed(stored.of_array(), 2),
          grouped(kReferenceNodeBytes * stored.nodes),
          fixed(kReferenceNodeBytes * stored.nodes / kArrayBytes, 2),
          grouped(kThesisNodeBytes * stored.nodes),
          fixed(kThesisNodeBytes * stored.nodes / kArrayBytes, 2)};
}

void print_bytes(const Outcome& outcome, Markdown& body) {
  std::vector<std::vector<std::string>> rows{
      row_of(outcome.ring_road.mean), row_of(outcome.ring_road.largest), row_of(outcome.city.mean),
      row_of(outcome.city.largest)};
  for (const Stored& grid : outcome.drawn) {
    rows.push_back(row_of(grid));
  }
  body.table({"grid", "leaves", "nodes", "linear, bytes", "array = 1", "reference, bytes",
              "array = 1", "thesis's nodes, bytes", "array = 1"},
             rows);
}

// The largest of both drives decides.
std::string verdict_on_goal(const Outcome& outcome) {
  const double largest =
      std::max(outcome.ring_road.largest.of_array(), outcome.city.largest.of_array());
  return std::string("The goal is less than half of the array: **")
      .append(largest < kGoalOfArray ? "met" : "missed")
      .append("**, the largest frame takes ")
      .append(percent(largest, 0));
}

void describe_bytes(const Outcome& outcome, Markdown& body) {
  body.subheading("Memory");
  body.paragraph(
      "What the same grids need. The array has a byte a cell, 1,048,576. The linear tree has four "
      "bytes for each of the 1,024 tiles, and for each tile that is not uniform 52 bytes and a "
      "byte a leaf. The reference has " +
      fixed(kReferenceNodeBytes, 0) +
      " bytes a node, a number and an index; the thesis's node has nine, two pointers and an "
      "index:");
  print_bytes(outcome, body);
  const double thesis_nodes = kThesisMebibytes * kMebibyte / kThesisNodeBytes;
  body.paragraph("The thesis's 3.15 MB are " + grouped(thesis_nodes) + " of its nodes, one for " +
                 fixed(kArrayBytes / thesis_nodes, 2) + " cells, about as in its table 4.7. " +
                 verdict_on_goal(outcome) +
                 ". It cannot be met by every grid: of a checkerboard each cell is a leaf, and "
                 "whoever must be ready for it reserves " +
                 fixed(outcome.drawn.back().of_array(), 2) +
                 " times the array. With less, tiles that find no room read as unknown and are "
                 "counted (`LinearQuadtree::lost_tiles`).");
}

Claim claim_on_loss(const Outcome& outcome) {
  return {.place = "section 4.3.2.2",
          .what = "cells in which a quadtree differs from the array",
          .paper = "none",
          .ours = "none in " + grouped(outcome.frames()) + " frames, nor in drawn grids",
          .verdict = Verdict::kEquals,
          .reason = ""};
}

Claim claim_on_memory(const Outcome& outcome) {
  const Stored& mean = outcome.ring_road.mean;
  const double mebibytes = mean.linear_bytes / kMebibyte;
  return {.place = "section 4.3.2.2",
          .what = "memory of a quadtree, 8-bit indexes",
          .paper = "3.15 MB, the array 1 MB",
          .ours = fixed(mebibytes, 2) + " MB",
          .verdict = mebibytes < kThesisMebibytes ? Verdict::kBeats : Verdict::kFallsShort,
          .reason =
              "a linear quadtree, without pointers; mean frame of the ring road, taken for "
              "the thesis's load; the city " +
              fixed(outcome.city.mean.linear_bytes / kMebibyte, 2) + " MB"};
}

}  // namespace

void add_storage(const TablesInput& input, Section& section) {
  const Outcome outcome = store_all(input);
  section.claims.push_back(claim_on_loss(outcome));
  section.claims.push_back(claim_on_memory(outcome));
  describe_check(outcome, section.body);
  describe_bytes(outcome, section.body);
}

}  // namespace iog::lab
