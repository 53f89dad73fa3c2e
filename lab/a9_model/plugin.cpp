// The model as a plugin of QEMU: decodes what QEMU translates and passes on what it executes.
//
//   -plugin liba9_model.so,out=FILE,variant=pessimistic,ddr_latency=130,function=NAME:HEX
//
// out       the report; standard error without it
// variant   nominal (default), optimistic, pessimistic; must come before single constants
// uncached  BEGIN:BYTES in hexadecimal: memory that is in no cache
// function  a function's name for the report and its entry; may be repeated
// others    constants by name, in decimal
#include <charconv>
#include <cstring>
#include <deque>
#include <fstream>
#include <iostream>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "decode.hpp"
#include "larger_tlb.hpp"
#include "qemu_plugin.hpp"
#include "recorder.hpp"

namespace iog::a9_model {
namespace {

struct Options {
  std::string out;
  std::string heading = "modelled variant=nominal";
  Constants constants = constants_of(Variant::kNominal);
  std::vector<Function> functions;
  std::uint32_t uncached_begin = 0;
  std::uint32_t uncached_bytes = 0;
};

// One machine, one processor: QEMU calls back from one thread.
struct Session {
  explicit Session(Options chosen)
      : options(std::move(chosen)), recorder(options.constants, options.functions) {
    recorder.set_uncached(options.uncached_begin, options.uncached_bytes);
  }

  Options options;
  Recorder recorder;
  std::deque<ProgramInstruction> program;                        // addresses stay
  std::unordered_map<std::uint64_t, ProgramInstruction*> known;  // by address and word
};

// Lives as long as QEMU, which reports after the destructors of this library have run.
Session* session = nullptr;

bool parse_number(std::string_view text, int base, std::uint32_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  return error == std::errc{} && end == text.data() + text.size();
}

bool choose_variant(Options& options, std::string_view value) {
  constexpr std::array<std::string_view, 3> kNames{"nominal", "optimistic", "pessimistic"};
  for (std::size_t index = 0; index < kNames.size(); ++index) {
    if (value == kNames[index]) {
      options.constants = constants_of(static_cast<Variant>(index));
      options.heading = "modelled variant=" + std::string(value);
      return true;
    }
  }
  return false;
}

bool add_function(Options& options, std::string_view value) {
  const std::size_t colon = value.rfind(':');
  std::uint32_t entry = 0;
  if (colon == std::string_view::npos || !parse_number(value.substr(colon + 1), 16, entry)) {
    return false;
  }
  options.functions.push_back({.name = std::string(value.substr(0, colon)), .entry = entry});
  return true;
}

bool set_uncached(Options& options, std::string_view value) {
  const std::size_t colon = value.find(':');
  return colon != std::string_view::npos &&
         parse_number(value.substr(0, colon), 16, options.uncached_begin) &&
         parse_number(value.substr(colon + 1), 16, options.uncached_bytes);
}

bool add_option(Options& options, std::string_view argument) {
  const std::size_t equals = argument.find('=');
  if (equals == std::string_view::npos) {
    return false;
  }
  const std::string_view key = argument.substr(0, equals);
  const std::string_view value = argument.substr(equals + 1);
  if (key == "out") {
    options.out = value;
    return true;
  }
  if (key == "variant") {
    return choose_variant(options, value);
  }
  if (key == "function") {
    return add_function(options, value);
  }
  if (key == "uncached") {
    return set_uncached(options, value);
  }
  std::uint32_t number = 0;
  if (!parse_number(value, 10, number) || !set_constant(options.constants, key, number)) {
    return false;
  }
  options.heading += ' ' + std::string(argument);
  return true;
}

void on_execute(unsigned /*processor*/, void* instruction) {
  session->recorder.begin(*static_cast<const ProgramInstruction*>(instruction));
}

void on_execute_unsupported(unsigned /*processor*/, void* /*data*/) {
  session->recorder.skip_unsupported();
}

void on_access(unsigned /*processor*/, qemu_plugin_meminfo_t info, std::uint64_t address,
               void* /*data*/) {
  const auto bytes = static_cast<std::uint8_t>(1u << qemu_plugin_mem_size_shift(info));
  session->recorder.access(static_cast<std::uint32_t>(address), bytes);
}

// QEMU translates a place again whenever it has thrown its translation away.
ProgramInstruction* instruction_at(std::uint32_t address, std::uint32_t word) {
  ProgramInstruction*& known = session->known[std::uint64_t{address} << 32 | word];
  if (known == nullptr) {
    const Instruction instruction = decode(word);
    session->program.push_back({.address = address,
                                .instruction = instruction,
                                .timing = timing_of(instruction, session->options.constants)});
    known = &session->program.back();
  }
  return known;
}

// A block is all A32 or all Thumb; the interface does not say which. Thumb shows by an instruction
// of two bytes or at an odd halfword. A block of four-byte Thumb instructions alone is taken for
// A32.
bool is_thumb(const qemu_plugin_tb* block) {
  for (std::size_t index = 0; index < qemu_plugin_tb_n_insns(block); ++index) {
    const qemu_plugin_insn* const translated = qemu_plugin_tb_get_insn(block, index);
    if (qemu_plugin_insn_size(translated) != 4 || qemu_plugin_insn_vaddr(translated) % 4 != 0) {
      return true;
    }
  }
  return false;
}

void watch(qemu_plugin_insn* translated) {
  std::uint32_t word = 0;
  std::memcpy(&word, qemu_plugin_insn_data(translated), sizeof word);
  ProgramInstruction* const instruction =
      instruction_at(static_cast<std::uint32_t>(qemu_plugin_insn_vaddr(translated)), word);
  qemu_plugin_register_vcpu_insn_exec_cb(translated, on_execute, QEMU_PLUGIN_CB_NO_REGS,
                                         instruction);
  if (instruction->timing.unit == Unit::kMemory) {
    qemu_plugin_register_vcpu_mem_cb(translated, on_access, QEMU_PLUGIN_CB_NO_REGS,
                                     QEMU_PLUGIN_MEM_RW, nullptr);
  }
}

void on_translate(qemu_plugin_id_t /*id*/, qemu_plugin_tb* block) {
  watch_supervisor_calls(block);
  const bool thumb = is_thumb(block);
  for (std::size_t index = 0; index < qemu_plugin_tb_n_insns(block); ++index) {
    qemu_plugin_insn* const translated = qemu_plugin_tb_get_insn(block, index);
    if (thumb) {
      qemu_plugin_register_vcpu_insn_exec_cb(translated, on_execute_unsupported,
                                             QEMU_PLUGIN_CB_NO_REGS, nullptr);
    } else {
      watch(translated);
    }
  }
}

void on_exit(qemu_plugin_id_t /*id*/, void* /*data*/) {
  if (session->options.out.empty()) {
    session->recorder.report(std::cerr, session->options.heading);
    return;
  }
  std::ofstream file(session->options.out);
  session->recorder.report(file, session->options.heading);
  if (!file.flush()) {
    std::cerr << "a9_model: cannot write " << session->options.out << '\n';
  }
}

}  // namespace
}  // namespace iog::a9_model

int qemu_plugin_version = 1;

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t* info, int argc, char** argv) {
  using namespace iog::a9_model;  // NOLINT(google-build-using-namespace): QEMU wants it global
  if (std::string_view(info->target_name) != "arm") {
    std::cerr << "a9_model: this is a model of A32 code, not of " << info->target_name << '\n';
    return 1;
  }
  Options options;
  for (int index = 0; index < argc; ++index) {
    if (!add_option(options, argv[index])) {
      std::cerr << "a9_model: no option " << argv[index] << '\n';
      return 1;
    }
  }
  session = new Session(std::move(options));
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_translate);
  qemu_plugin_register_atexit_cb(id, on_exit, nullptr);
  return 0;
}
