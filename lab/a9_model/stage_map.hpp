// What a program's file says of an instruction. Which stage it belongs to, by the debug information
// of the compiler (DWARF), also where a function lies in another one; and whether it is Thumb.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace iog::a9_model {

// A function belongs to a stage. The file is the end of the path where the function is defined,
// without its extension; the name is without scope and template arguments.
struct StageRule {
  std::string stage;
  std::string file;      // "grid/carving"
  std::string function;  // "carve_blocks"
};

struct Place {
  std::uint8_t stage = 0;      // by its number; 0: that of whoever has called
  std::uint32_t function = 0;  // which one; 0: unknown, such as assembly
};

class StageMap {
 public:
  // std::runtime_error if the image is no ELF file with debug information, or has nothing that a
  // rule speaks of. No rules: no stages.
  StageMap(const std::string& image, std::span<const StageRule> rules);

  [[nodiscard]] Place at(std::uint32_t address) const {
    const std::uint32_t index = (address - base_) / 4;
    return index < places_.size() ? places_[index] : Place{};
  }

  [[nodiscard]] bool is_thumb(std::uint32_t address) const {
    const std::uint32_t index = (address - base_) / 4;
    return index < thumb_.size() && thumb_[index];
  }

  // Names, by number; the first has none.
  [[nodiscard]] std::span<const std::string> stages() const { return stages_; }

 private:
  std::uint32_t base_ = 0;
  std::vector<Place> places_;  // by instruction, four bytes each
  std::vector<bool> thumb_;
  std::vector<std::string> stages_{""};
};

}  // namespace iog::a9_model
