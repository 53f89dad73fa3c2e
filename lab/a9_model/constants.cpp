#include "constants.hpp"

#include <algorithm>

namespace iog::a9_model {
namespace {

using C = Constants;
constexpr Certainty kManual = Certainty::kManual;
constexpr Certainty kPublished = Certainty::kPublished;
constexpr Certainty kAssumed = Certainty::kAssumed;

// name, member, nominal, optimistic, pessimistic, certainty, source
constexpr std::array kTable{
    Constant{"dispatch_width", &C::dispatch_width, 2, 2, 2, kManual,
             "GCC: \"a dual issue pipeline\"; LLVM: issue width 2"},
    Constant{"fetch_queue", &C::fetch_queue, 8, 16, 4, kAssumed,
             "instructions fetched ahead of dispatch; the TRM names a queue and no size"},
    Constant{"window", &C::window, 20, 40, 8, kAssumed,
             "instructions in flight; 7-cpu: 56 physical registers, of which the architecture's 33 "
             "are taken, so 23 results at most; optimistic: if only the 16 of one mode are"},
    Constant{"taken_branch_bubble", &C::taken_branch_bubble, 1, 0, 1, kAssumed,
             "the target of a predicted branch is fetched in the next cycle but one; the TRM says "
             "only that loops below 64 bytes need no instruction cache"},
    Constant{"mispredict_penalty", &C::mispredict_penalty, 10, 8, 13, kAssumed,
             "optimistic: LLVM, from the depth of the pipeline; pessimistic: 13 of the deeper "
             "Cortex-A8 by its TRM (ARM DDI 0344, 5.1); the A9 manual names none"},
    Constant{"history_bits", &C::history_bits, 10, 12, 6, kAssumed,
             "branches that index the global history buffer; 10 in the Cortex-A8, not stated for "
             "the A9"},
    Constant{"alus", &C::alus, 2, 2, 2, kManual,
             "GCC: two pipelines for data processing, the multiplier in one of them"},
    Constant{"shift_occupies", &C::shift_occupies, 0, 0, 1, kAssumed,
             "1: an operation of n cycles in table B-1 keeps its ALU for n (LLVM itineraries); 0: "
             "for one (GCC, and LLVM's newer model)"},
    Constant{"load_to_use", &C::load_to_use, 4, 4, 4, kPublished,
             "7-cpu: 4 cycles a step through a list in L1; TRM table B-2: one in the AGU and 3"},
    Constant{"load_to_alu", &C::load_to_alu, 3, 3, 4, kManual,
             "TRM B.3: forwarding to an unshifted data-processing instruction saves one cycle"},
    Constant{"narrow_agu_cycles", &C::narrow_agu_cycles, 2, 1, 2, kManual,
             "TRM table B-2: LDRB and LDRH keep the AGU for two cycles; optimistic, because 7-cpu "
             "finds one load a cycle and does not say of what size"},
    Constant{"narrow_extra", &C::narrow_extra, 1, 1, 1, kManual,
             "TRM table B-2: LDRB and LDRH are one cycle later than LDR"},
    Constant{"vector_skew", &C::vector_skew, 3, 3, 3, kAssumed,
             "cycles from dispatch to the first NEON stage; 3 makes the result of a vector load "
             "usable in the next instruction, as MPE and LLVM state"},
    Constant{"vector_queue", &C::vector_queue, 8, 16, 4, kAssumed,
             "vector instructions between dispatch and issue; no source"},
    Constant{"vector_to_core", &C::vector_to_core, 3, 2, 8, kAssumed,
             "cycles from a vector result to the core beside the skew; GCC says 2 from issue"},
    Constant{"quad_integer_cycles", &C::quad_integer_cycles, 1, 1, 2, kManual,
             "MPE: integer operations on q registers issue in one cycle; pessimistic, because the "
             "data path is 64 bits wide for other operations"},
    Constant{"shares_load_port", &C::shares_load_port, 1, 1, 1, kManual,
             "GCC: loads and stores of the core and vector instructions share an issue port"},
    Constant{"cross_word_extra", &C::cross_word_extra, 1, 1, 1, kPublished,
             "7-cpu: crossing of 4 bytes"},
    Constant{"cross_doubleword_extra", &C::cross_doubleword_extra, 6, 6, 6, kPublished,
             "7-cpu: crossing of 8 bytes"},
    Constant{"fill_buffers", &C::fill_buffers, 2, 4, 2, kManual,
             "TRM 7.1: two 32-byte line fill buffers, and 7-cpu's 68 ns a line of random reads are "
             "half the latency; optimistic: TRM 7.1.1, up to four outstanding misses"},
    Constant{"store_buffer", &C::store_buffer, 4, 4, 4, kManual,
             "TRM 7.1: four 64-bit slots that merge"},
    Constant{"store_forward_cycles", &C::store_forward_cycles, 4, 3, 8, kAssumed,
             "from stored data to a load of it; nominal as a load from L1, no source"},
    Constant{"store_hazard_bytes", &C::store_hazard_bytes, 8, 4, 8, kAssumed,
             "a load waits for a store to the same so many bytes; 8 is a slot of the store buffer"},
    Constant{"stores_wait_for_data", &C::stores_wait_for_data, 0, 0, 1, kAssumed,
             "1: a store takes the AGU only when its data is ready; Arm's description of the core "
             "lets it resolve in the memory system"},
    Constant{"write_streaming_lines", &C::write_streaming_lines, 2, 1, 1000000000, kPublished,
             "after so many whole lines in a row stores are not allocated in L1, nor read from "
             "DDR; 7-cpu: sequential writes reach 1600 MB/s, reads 1010 MB/s; pessimistic: never"},
    Constant{"random_replacement", &C::random_replacement, 1, 1, 1, kManual,
             "TRM 7.1.1: the data cache is pseudo-random; assumed of the other two; 0: least "
             "recently used"},
    Constant{"l2_extra", &C::l2_extra, 19, 16, 26, kPublished,
             "7-cpu: 23 cycles a step in L2, 4 of them L1; pessimistic: PL310 with the RAM "
             "latencies 1-3-2 of this board and a SCU at the same clock"},
    Constant{"l2_fill_occupies", &C::l2_fill_occupies, 14, 14, 19, kPublished,
             "cycles that a fill buffer is taken; 7-cpu: 7 cycles a line for two parallel chains"},
    Constant{"l2_read_line", &C::l2_read_line, 7, 5, 9, kPublished,
             "7-cpu: 7 cycles a line in parallel, 8.7 in a sequence"},
    Constant{"l2_write_line", &C::l2_write_line, 4, 4, 8, kPublished,
             "7-cpu: 11.5 cycles a line where each is filled and evicted; 4 beats of 64 bits"},
    Constant{"l2_evictions", &C::l2_evictions, 3, 3, 3, kAssumed,
             "lines that may wait for the memory channel before a replacement in L2 does"},
    Constant{"ddr_latency", &C::ddr_latency, 110, 90, 150, kPublished,
             "7-cpu: 110 ns beyond L2, on an Exynos; no figure for the i.MX6 was found"},
    Constant{"ddr_line", &C::ddr_line, 20, 16, 32, kPublished,
             "cycles of the memory channel for 32 bytes; 7-cpu: 1600 MB/s of writes; NXP: between "
             "1.0 and 1.7 GB/s on the i.MX6, with 64 bits no more than with 32"},
    Constant{"prefetch_lines", &C::prefetch_lines, 2, 3, 0, kAssumed,
             "lines ahead of a stream; set so that reading reaches 7-cpu's 1010 MB/s"},
    Constant{"device_extra", &C::device_extra, 40, 20, 80, kAssumed,
             "reading a register beside L1, such as a timer; no source"},
    Constant{"uncached_reads", &C::uncached_reads, 1, 2, 1, kAssumed,
             "reads of uncached memory under way; TRM 8.1.3: all have one AXI ID, so they come in "
             "order; each takes as long as a line from the DDR, as the PL310 passes it on"},
    Constant{
        "uncached_beat", &C::uncached_beat, 2, 1, 4, kAssumed,
        "each further doubleword of one instruction's burst (TRM 8.1.2: INCR, up to nine of 64 "
        "bits); nominal: l2_read_line is 7 for four; pessimistic: twice that"},
    Constant{
        "uncached_write", &C::uncached_write, 5, 2, 32, kAssumed,
        "the memory channel for a doubleword (TRM 8.1.2: INCR 1); nominal: a quarter of "
        "ddr_line, as the PL310's store buffer gathers lines; pessimistic: each goes by itself"},
    Constant{"micro_tlb", &C::micro_tlb, 32, 32, 8, kManual,
             "TRM 6.1: 32 entries; 7-cpu: perhaps 8 in the first revision"},
    Constant{"main_tlb_extra", &C::main_tlb_extra, 7, 7, 7, kPublished, "7-cpu: 7 cycles"},
    Constant{
        "walk_extra", &C::walk_extra, 25, 14, 60, kAssumed,
        "a walk looks up one or two descriptors in L1 (TRM 6.1) or behind it; 7-cpu: at least 7"},
    Constant{"page_kb", &C::page_kb, 1024, 1024, 4, kManual,
             "board/imx6/memory/mmu.hpp: sections; pessimistic: pages of an operating system"},
};

}  // namespace

std::span<const Constant> constants() { return kTable; }

Constants constants_of(Variant variant) {
  Constants values;
  for (const Constant& constant : kTable) {
    values.*constant.member = variant == Variant::kNominal      ? constant.nominal
                              : variant == Variant::kOptimistic ? constant.optimistic
                                                                : constant.pessimistic;
  }
  return values;
}

bool set_constant(Constants& values, std::string_view name, std::uint32_t value) {
  const auto found = std::ranges::find(kTable, name, &Constant::name);
  if (found == kTable.end()) {
    return false;
  }
  values.*(found->member) = value;
  return true;
}

}  // namespace iog::a9_model
