// The beams of table 4.2, walked as other libraries do: a part of the section on traversal.
#pragma once

#include "lab/experiments/section.hpp"

namespace iog::lab {

void add_peer_walks(Section& section);

}  // namespace iog::lab
