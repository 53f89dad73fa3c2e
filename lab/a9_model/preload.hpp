// The addresses of preloads (PLD). QEMU executes a PLD without an access to memory, so its plugin
// interface does not tell them. They follow from the core's registers, which QEMU completes in
// memory at the beginning of a block: with -singlestep, each instruction is a block.
#pragma once

#include <cstdint>

namespace iog::a9_model {

// The address that a PLD or PLDW of A32 at `at` names (ARM DDI 0406C, A8.8.126 to A8.8.128).
// read_register: of r0 to r14.
template <typename ReadRegister>
std::uint32_t preloaded_address(std::uint32_t word, std::uint32_t at, ReadRegister read_register) {
  const std::uint32_t base_number = word >> 16 & 15;
  const std::uint32_t base = base_number == 15 ? at + 8 : read_register(base_number);
  const auto shifted = [&]() -> std::uint32_t {
    const std::uint32_t index = read_register(word & 15);
    const std::uint32_t amount = word >> 7 & 31;
    switch (word >> 5 & 3) {
      case 0:
        return index << amount;
      case 1:
        return amount == 0 ? 0 : index >> amount;
      case 2:
        return static_cast<std::uint32_t>(std::int64_t{static_cast<std::int32_t>(index)} >>
                                          (amount == 0 ? 32 : amount));
      default:
        return index >> amount | index << (-amount & 31);  // RRX is not used for addresses
    }
  };
  const bool has_index = (word >> 25 & 1) != 0;
  const std::uint32_t offset = has_index ? shifted() : word & 0xfff;
  return (word >> 23 & 1) != 0 ? base + offset : base - offset;
}

// A register of QEMU's processor 0, if this QEMU exports the functions that read it.
[[nodiscard]] bool can_read_registers();
[[nodiscard]] std::uint32_t register_of_processor(std::uint32_t number);

}  // namespace iog::a9_model
