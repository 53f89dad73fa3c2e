#include "boot_record.hpp"

#include <algorithm>

namespace iog::board {
namespace {

// FNV-1a over everything after the seal: random DDR passes once in 2^32 cold starts, and the seal
// of an empty record is not zero, so zeroed memory does not pass.
std::uint32_t seal_of(const BootRecord& record) {
  std::uint32_t hash = 0x811c'9dc5;
  const auto add = [&hash](std::uint32_t value) { hash = (hash ^ value) * 0x0100'0193; };
  add(record.boots);
  add(record.run_number);
  add(record.cause);
  add(record.detail);
  add(record.last_word_bytes);
  const std::size_t used =
      std::min<std::size_t>(record.last_word_bytes, BootRecord::kLastWordBytes);
  for (std::size_t index = 0; index < used; ++index) {
    add(static_cast<unsigned char>(record.last_word[index]));
  }
  return hash;
}

// Every bit of a word reaches every bit of the result: the finaliser of MurmurHash3 (Appleby,
// public domain), which maps the 2^32 words one to one.
std::uint32_t stirred(std::uint32_t hash) {
  hash = (hash ^ hash >> 16) * 0x85eb'ca6b;
  hash = (hash ^ hash >> 13) * 0xc2b2'ae35;
  return hash ^ hash >> 16;
}

std::uint32_t number_drawn_from(const Differences& differences) {
  std::uint32_t number = stirred(differences.ticks);
  for (const std::uint32_t word : differences.noise) {
    number = stirred(number ^ word);
  }
  for (const std::uint8_t octet : differences.mac) {
    number = stirred(number ^ octet);
  }
  return number;
}

void close(BootRecord& record) { record.seal = seal_of(record); }

}  // namespace

Boot detail::open(BootRecord& record) {
  Boot boot;
  const bool valid =
      record.last_word_bytes <= BootRecord::kLastWordBytes && record.seal == seal_of(record);
  if (valid) {
    boot.before.starts = record.boots + 1;
    boot.before.end = {.cause = hal::EndCause::kWithoutAWord};
    boot.last_word_bytes = record.last_word_bytes;
    boot.last_word = record.last_word;
  }
  if (valid && record.last_word_bytes != 0) {
    boot.before.end = {.cause = static_cast<hal::EndCause>(record.cause), .detail = record.detail};
  }
  record.boots = boot.before.starts;
  record.cause = 0;
  record.detail = 0;
  record.run_number = valid ? record.run_number : 0;
  record.last_word_bytes = 0;
  close(record);
  return boot;
}

std::uint32_t detail::begin_run(BootRecord& record, const Differences& differences) {
  const bool has_one = record.run_number != 0;
  const std::uint32_t number = has_one ? record.run_number + 1 : number_drawn_from(differences);
  record.run_number = number != 0 ? number : 1;
  close(record);
  return record.run_number;
}

void detail::write_last_word(BootRecord& record, hal::End end, std::string_view text) {
  const std::size_t bytes = std::min(text.size(), BootRecord::kLastWordBytes);
  std::copy_n(text.begin(), bytes, record.last_word.begin());
  record.last_word_bytes = static_cast<std::uint32_t>(bytes);
  record.cause = static_cast<std::uint32_t>(end.cause);
  record.detail = end.detail;
  close(record);
}

}  // namespace iog::board
