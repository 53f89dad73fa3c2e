// The model as a plugin of QEMU: decodes what QEMU translates and passes on what it executes.
//
//   -plugin
//   liba9_model.so,image=FILE,out=FILE,variant=pessimistic,ddr_latency=130,stage=NAME:FILE:FUNCTION
//
// out       the report; standard error without it
// variant   nominal (default), optimistic, pessimistic; must come before single constants
// uncached  BEGIN:BYTES in hexadecimal: memory that is in no cache
// image     the program that runs, with debug information; needed
// stage     a stage's name for the report, and a function that belongs to it, by the end of the
// path
//           of its file, without an extension (stage_map.hpp); may be repeated
// others    constants by name, in decimal
#include <charconv>
#include <cstring>
#include <deque>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "decode.hpp"
#include "larger_tlb.hpp"
#include "preload.hpp"
#include "qemu_plugin.hpp"
#include "recorder.hpp"

namespace iog::a9_model {
namespace {

struct Options {
  std::string out;
  std::string heading = "modelled variant=nominal";
  Constants constants = constants_of(Variant::kNominal);
  std::string image;
  std::vector<StageRule> stages;
  std::uint32_t uncached_begin = 0;
  std::uint32_t uncached_bytes = 0;
};

// One machine, one processor: QEMU calls back from one thread.
struct Session {
  explicit Session(Options chosen)
      : options(std::move(chosen)),
        stages(options.image, options.stages),
        recorder(options.constants, stages.stages()) {
    recorder.set_uncached(options.uncached_begin, options.uncached_bytes);
  }

  Options options;
  StageMap stages;
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

bool add_stage(Options& options, std::string_view value) {
  const std::size_t first = value.find(':');
  const std::size_t second = value.rfind(':');
  if (first == second) {
    return false;
  }
  options.stages.push_back({.stage = std::string(value.substr(0, first)),
                            .file = std::string(value.substr(first + 1, second - first - 1)),
                            .function = std::string(value.substr(second + 1))});
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
  if (key == "image") {
    options.image = value;
    return true;
  }
  if (key == "stage") {
    return add_stage(options, value);
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

void on_preload(unsigned /*processor*/, void* data) {
  const auto& preload = *static_cast<const ProgramInstruction*>(data);
  session->recorder.begin(preload);
  session->recorder.access(preloaded_address(preload.word, preload.address, register_of_processor),
                           1);
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
                                .word = word,
                                .instruction = instruction,
                                .timing = timing_of(instruction, session->options.constants),
                                .place = session->stages.at(address)});
    known = &session->program.back();
  }
  return known;
}

void watch(qemu_plugin_insn* translated) {
  std::uint32_t word = 0;
  std::memcpy(&word, qemu_plugin_insn_data(translated), sizeof word);
  ProgramInstruction* const instruction =
      instruction_at(static_cast<std::uint32_t>(qemu_plugin_insn_vaddr(translated)), word);
  const bool preloads = instruction->instruction.kind == Kind::kPreload && can_read_registers();
  qemu_plugin_register_vcpu_insn_exec_cb(translated, preloads ? on_preload : on_execute,
                                         QEMU_PLUGIN_CB_NO_REGS, instruction);
  if (instruction->timing.unit == Unit::kMemory) {
    qemu_plugin_register_vcpu_mem_cb(translated, on_access, QEMU_PLUGIN_CB_NO_REGS,
                                     QEMU_PLUGIN_MEM_RW, nullptr);
  }
}

void on_translate(qemu_plugin_id_t /*id*/, qemu_plugin_tb* block) {
  watch_supervisor_calls(block);
  const auto begin =
      static_cast<std::uint32_t>(qemu_plugin_insn_vaddr(qemu_plugin_tb_get_insn(block, 0)));
  const bool is_thumb = session->stages.is_thumb(begin);  // a block is all of one kind
  for (std::size_t index = 0; index < qemu_plugin_tb_n_insns(block); ++index) {
    qemu_plugin_insn* const translated = qemu_plugin_tb_get_insn(block, index);
    if (is_thumb) {
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
  try {
    session = new Session(std::move(options));
  } catch (const std::runtime_error& error) {
    std::cerr << "a9_model: " << error.what() << '\n';
    return 1;
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_translate);
  qemu_plugin_register_atexit_cb(id, on_exit, nullptr);
  return 0;
}
