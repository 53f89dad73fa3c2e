#include "boot_record.hpp"

#include <algorithm>

#include "machine.hpp"

namespace iog::imx6 {
namespace {

// FNV-1a over everything after the seal: random DDR passes once in 2^32 cold starts, and the seal
// of an empty record is not zero, so zeroed memory does not pass.
std::uint32_t seal_of(const BootRecord& record) {
  std::uint32_t hash = 0x811c'9dc5;
  const auto add = [&hash](std::uint32_t value) { hash = (hash ^ value) * 0x0100'0193; };
  add(record.boots);
  add(record.last_word_bytes);
  const std::size_t used =
      std::min<std::size_t>(record.last_word_bytes, BootRecord::kLastWordBytes);
  for (std::size_t index = 0; index < used; ++index) {
    add(static_cast<unsigned char>(record.last_word[index]));
  }
  return hash;
}

void close(BootRecord& record) {
  record.seal = seal_of(record);
  machine::barrier();
}

}  // namespace

Boot open_boot_record(BootRecord& record) {
  Boot boot;
  const bool valid =
      record.last_word_bytes <= BootRecord::kLastWordBytes && record.seal == seal_of(record);
  if (valid) {
    boot.number = record.boots + 1;
    boot.last_word_bytes = record.last_word_bytes;
    boot.last_word = record.last_word;
    boot.reason =
        record.last_word_bytes != 0 ? BootReason::kAfterLastWord : BootReason::kWithoutAWord;
  }
  record.boots = boot.number;
  record.last_word_bytes = 0;
  close(record);
  return boot;
}

void write_last_word(BootRecord& record, std::string_view text) {
  const std::size_t bytes = std::min(text.size(), BootRecord::kLastWordBytes);
  std::copy_n(text.begin(), bytes, record.last_word.begin());
  record.last_word_bytes = static_cast<std::uint32_t>(bytes);
  close(record);
}

}  // namespace iog::imx6
