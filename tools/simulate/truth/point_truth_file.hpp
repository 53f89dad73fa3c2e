// What is true of the points of a drive, as a CSV: frame, time_us, port, point, class, thing, x_mm,
// y_mm, z_mm, height_mm.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "tools/program/file.hpp"
#include "tools/simulate/scanners/point_truth.hpp"

namespace iog::tools {

class PointTruthFile {
 public:
  // UsageError if it cannot be written.
  explicit PointTruthFile(const std::string& path);

  // A row for each beam that came back. time_us and port are its packet's, as in the capture; point
  // is its number among those that the packet's decoder visits, from 0. Clutter has no place.
  void write(std::uint32_t frame, std::span<const SimulatedPacket> packets);
  void finish() { file_.finish(); }

 private:
  OutputFile file_;
};

}  // namespace iog::tools
