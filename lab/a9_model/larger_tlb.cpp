#include "larger_tlb.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <dlfcn.h>

namespace iog::a9_model {
namespace {

// Not of the plugin interface. A QEMU that does not export them stays as slow as it was.
using FindProcessor = void* (*)(int index);
using FlushTlb = void (*)(void* processor);

void empty_tlb() {
  static const auto find_processor =
      reinterpret_cast<FindProcessor>(dlsym(RTLD_DEFAULT, "qemu_get_cpu"));
  static const auto flush_tlb = reinterpret_cast<FlushTlb>(dlsym(RTLD_DEFAULT, "tlb_flush"));
  if (find_processor != nullptr && flush_tlb != nullptr) {
    flush_tlb(find_processor(0));
  }
}

// An image reads its input by supervisor calls. Their number doubles from one time to the next, so
// that a run of any length has a few.
void on_supervisor_call(unsigned /*processor*/, void* /*data*/) {
  static std::uint64_t calls = 0;
  if (std::has_single_bit(++calls)) {
    empty_tlb();
  }
}

// SVC of A32 and of Thumb (ARM DDI 0406, A8.8.228).
bool is_supervisor_call(const qemu_plugin_insn* instruction) {
  if (qemu_plugin_insn_size(instruction) == 2) {
    std::uint16_t half = 0;
    std::memcpy(&half, qemu_plugin_insn_data(instruction), sizeof half);
    return half >> 8 == 0xDF;
  }
  std::uint32_t word = 0;
  std::memcpy(&word, qemu_plugin_insn_data(instruction), sizeof word);
  return (word >> 24 & 0xF) == 0xF && word >> 28 != 0xF;
}

}  // namespace

void watch_supervisor_calls(const qemu_plugin_tb* block) {
  for (std::size_t index = 0; index < qemu_plugin_tb_n_insns(block); ++index) {
    qemu_plugin_insn* const instruction = qemu_plugin_tb_get_insn(block, index);
    if (is_supervisor_call(instruction)) {
      qemu_plugin_register_vcpu_insn_exec_cb(instruction, on_supervisor_call,
                                             QEMU_PLUGIN_CB_NO_REGS, nullptr);
    }
  }
}

}  // namespace iog::a9_model
