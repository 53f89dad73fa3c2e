// Why a block is not taken, in words.
#pragma once

#include "map/block.hpp"

namespace iog::tools {

[[nodiscard]] const char* refusal_text(map::Refusal refusal);

}  // namespace iog::tools
