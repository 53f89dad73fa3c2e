// What is compared: ways to make a grid of a frame's beams. Each is given the beams in its own form
// when it is made, so that no conversion is timed.
#pragma once

#include <cstddef>
#include <memory>

#include "lab/peers/beams.hpp"

namespace iog::lab {

struct CellCounts {
  std::size_t free = 0;
  std::size_t occupied = 0;
  std::size_t stored = 0;  // cells of the array or nodes of the tree, known or not
};

class Contender {
 public:
  Contender() = default;
  Contender(const Contender&) = delete;
  Contender& operator=(const Contender&) = delete;
  virtual ~Contender() = default;

  // Adds this frame's beams to the grid.
  virtual void fuse(std::size_t frame) = 0;

  // All cells back to unknown.
  virtual void clear() = 0;

  // Cells that are likelier free than not, or likelier occupied.
  [[nodiscard]] virtual CellCounts count() const = 0;
};

// frames outlives the contender.
using MakeContender = std::unique_ptr<Contender> (*)(const PeerFrames& frames);

[[nodiscard]] std::unique_ptr<Contender> make_hits_win(const PeerFrames& frames);
[[nodiscard]] std::unique_ptr<Contender> make_bayes(const PeerFrames& frames);
[[nodiscard]] std::unique_ptr<Contender> make_printed(const PeerFrames& frames);
[[nodiscard]] std::unique_ptr<Contender> make_printed_whole_beams(const PeerFrames& frames);
[[nodiscard]] std::unique_ptr<Contender> make_float_bayes(const PeerFrames& frames);
[[nodiscard]] std::unique_ptr<Contender> make_float_log_odds(const PeerFrames& frames);
[[nodiscard]] std::unique_ptr<Contender> make_mrpt(const PeerFrames& frames);
[[nodiscard]] std::unique_ptr<Contender> make_octomap_clouds(const PeerFrames& frames);
[[nodiscard]] std::unique_ptr<Contender> make_octomap_rays(const PeerFrames& frames);

}  // namespace iog::lab
