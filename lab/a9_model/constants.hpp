// Every number of the model, its source, and how far it may be off.
//
// Cycles are those of the core at 1 GHz, so a nanosecond is a cycle. "By the manual" is a statement
// of the maker; "published" is somebody's measurement of a Cortex-A9, named; "assumed" says why.
// The optimistic and the pessimistic value bound what is not certain; where all three are equal,
// the number is not in doubt or its effect is known to be none.
//
// Sources by short name:
//   TRM       Cortex-A9 Technical Reference Manual r4p1, ARM DDI 0388I; its table B-1 by way of
//             OTAWA's module xilinx_A9
//   MPE       Cortex-A9 NEON Media Processing Engine TRM r4p1, ARM DDI 0409I, by way of the
//             pipeline description that Arm gave to GCC, gcc/config/arm/cortex-a9-neon.md
//   GCC       the same for core and VFP, gcc/config/arm/cortex-a9.md
//   LLVM      llvm/lib/Target/ARM/ARMScheduleA9.td, "follows the Technical Reference Manuals"
//   7-cpu     measurements of an Exynos 4210, Cortex-A9 at 1.2 GHz, 7-cpu.com/cpu/Cortex-A9.html
//   NXP       M.-O. Westerburg, "i.MX6 DDR3 RAM-Performance", community.nxp.com/thread/329671
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace iog::a9_model {

enum class Certainty : std::uint8_t { kManual, kPublished, kAssumed };

struct Constants {
  // Front end and window.
  std::uint32_t dispatch_width = 0;
  std::uint32_t fetch_queue = 0;
  std::uint32_t window = 0;
  std::uint32_t taken_branch_bubble = 0;
  std::uint32_t mispredict_penalty = 0;
  std::uint32_t history_bits = 0;
  // Integer pipelines.
  std::uint32_t alus = 0;
  std::uint32_t shift_occupies = 0;
  std::uint32_t load_to_use = 0;
  std::uint32_t load_to_alu = 0;
  std::uint32_t narrow_agu_cycles = 0;
  std::uint32_t narrow_extra = 0;
  // Vector pipeline.
  std::uint32_t vector_skew = 0;
  std::uint32_t vector_queue = 0;
  std::uint32_t vector_to_core = 0;
  std::uint32_t quad_integer_cycles = 0;
  std::uint32_t shares_load_port = 0;
  // Level 1 and the store buffer.
  std::uint32_t cross_word_extra = 0;
  std::uint32_t cross_doubleword_extra = 0;
  std::uint32_t fill_buffers = 0;
  std::uint32_t store_buffer = 0;
  std::uint32_t store_forward_cycles = 0;
  std::uint32_t store_hazard_bytes = 0;
  std::uint32_t stores_wait_for_data = 0;
  std::uint32_t write_streaming_lines = 0;
  std::uint32_t random_replacement = 0;
  // Level 2 and memory.
  std::uint32_t l2_extra = 0;
  std::uint32_t l2_fill_occupies = 0;
  std::uint32_t l2_read_line = 0;
  std::uint32_t l2_write_line = 0;
  std::uint32_t l2_evictions = 0;
  std::uint32_t ddr_latency = 0;
  std::uint32_t ddr_line = 0;
  std::uint32_t prefetch_lines = 0;
  std::uint32_t device_extra = 0;
  // Uncached memory.
  std::uint32_t uncached_reads = 0;
  std::uint32_t uncached_beat = 0;
  std::uint32_t uncached_write = 0;
  // Translation.
  std::uint32_t micro_tlb = 0;
  std::uint32_t main_tlb_extra = 0;
  std::uint32_t walk_extra = 0;
  std::uint32_t page_kb = 0;
};

struct Constant {
  std::string_view name;
  std::uint32_t Constants::*member;
  std::uint32_t nominal;
  std::uint32_t optimistic;
  std::uint32_t pessimistic;
  Certainty certainty;
  std::string_view source;
};

enum class Variant : std::uint8_t { kNominal, kOptimistic, kPessimistic };

std::span<const Constant> constants();

// Values of a variant.
Constants constants_of(Variant variant);

// Changes one value by its name. False: there is no such constant.
bool set_constant(Constants& values, std::string_view name, std::uint32_t value);

}  // namespace iog::a9_model
