#pragma once

#include "registers/gic_of.hpp"

namespace iog::zcu102 {

using GicDistributorRegisters = board::GicDistributorOf<192>;  // 32 private and 160 shared

static_assert(board::kIsLaidOut<GicDistributorRegisters>);

}  // namespace iog::zcu102
