#pragma once

#include "registers/gic_of.hpp"

namespace iog::zcu102 {

using GicDistributorRegisters = board::GicDistributorOf<192>;  // 32 private and 160 shared

static_assert(offsetof(GicDistributorRegisters, igroupr) == 0x080);
static_assert(offsetof(GicDistributorRegisters, isenabler) == 0x100);
static_assert(offsetof(GicDistributorRegisters, icenabler) == 0x180);
static_assert(offsetof(GicDistributorRegisters, icpendr) == 0x280);
static_assert(offsetof(GicDistributorRegisters, ipriorityr) == 0x400);
static_assert(offsetof(GicDistributorRegisters, itargetsr) == 0x800);
static_assert(offsetof(GicDistributorRegisters, icfgr) == 0xc00);
static_assert(offsetof(GicDistributorRegisters, sgir) == 0xf00);

}  // namespace iog::zcu102
