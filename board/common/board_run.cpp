#include "board_run.hpp"

#include "ending.hpp"
#include "machine.hpp"
#include "stack_gauge.hpp"
#include "version.hpp"

namespace iog::board {
namespace {

// Defined by the linker script. startup.S has painted the stack between them.
extern "C" {
extern std::uint32_t main_stack_bottom, main_stack_top;
}

constinit StackGauge main_stack_gauge{};

}  // namespace

void BoardRun::end_run(hal::End end, std::string_view words) {
  TextLine line;
  line.text(words_of(end.cause)).text(": ").text(words);
  end_with_last_word(end, line.view());
}

std::uint32_t BoardRun::stack_bytes() const {
  return machine::bus_address(main_stack_top) - machine::bus_address(main_stack_bottom);
}

std::uint32_t BoardRun::stack_used_bytes() const {
  return main_stack_gauge.used_bytes({&main_stack_bottom, stack_bytes() / 4});
}

TextLine BoardRun::begin_banner(std::string_view chip) const {
  TextLine line;
  line.text("iogrid ").text(kVersion).text(" on ").text(chip).text(", boot ");
  line.decimal(boot_.before.starts).text(": ").text(reason_of(boot_.before.end.cause));
  return line;
}

void BoardRun::add_phy(TextLine& line, const phy::Identity& phy) {
  if (phy.answers()) {
    line.text(", PHY ").hex(phy.id).text(" at ").decimal(phy.address).text("\n");
  } else {
    line.text(", no PHY\n");
  }
}

void BoardRun::add_mac(TextLine& line) const {
  line.text("MAC ");
  for (const std::uint8_t octet : mac_address_) {
    line.octet(octet);
  }
}

}  // namespace iog::board
