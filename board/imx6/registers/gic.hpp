#pragma once

#include "registers/gic_of.hpp"

namespace iog::imx6 {

using GicDistributorRegisters = board::GicDistributorOf<160>;  // 32 private and 128 shared

static_assert(board::kIsLaidOut<GicDistributorRegisters>);

}  // namespace iog::imx6
