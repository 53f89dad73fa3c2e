#include "tools/reference/fusion.hpp"

namespace iog::tools::reference {

double fuse_bayes(double p, double q) { return p * q / (p * q + (1 - p) * (1 - q)); }

}  // namespace iog::tools::reference
