// A point of a cloud that tier4/nebula has decoded.
#pragma once

namespace iog::tests {

struct NebulaPoint {
  int x_mm;
  int y_mm;
  int z_mm;
};

}  // namespace iog::tests
