// The base class of each board's Board manages the run number, the end of the previous run, the end
// of this run, and the main stack.
#pragma once

#include <cstdint>
#include <string_view>

#include "board/common/ethernet/clause_22.hpp"
#include "board/common/ethernet/settings.hpp"
#include "boot_record.hpp"
#include "hal/end_of_run.hpp"
#include "text_line.hpp"

// startup.S calls main() after it has set up memory. In freestanding C++, main() is an ordinary
// function, so it needs a declaration with C linkage. `main()` must not return.
extern "C" int main();

namespace iog::board {

class BoardRun {
 public:
  explicit BoardRun(const MacAddress& address) : mac_address_(address) {}

  const MacAddress& mac_address() const { return mac_address_; }

  // Returns the number of this run, as hal::RunNumber requires.
  std::uint32_t run_number() const { return run_number_; }

  // Ends the run with a last word and a reset, as hal::EndsRuns requires.
  void end_run(hal::End end, std::string_view words);
  hal::RunBefore run_before() const { return boot_.before; }

  // stack_used_bytes() returns the largest use of the main stack since start. `stack_bytes()`
  // returns the size of the main stack.
  std::uint32_t stack_used_bytes() const;
  std::uint32_t stack_bytes() const;

 protected:
  template <typename Memory>
  void open_record(Memory& memory) {
    boot_ = open_boot_record(boot_record, memory);
  }
  // Call this function at the end of start-up. At that time, `ticks` varies between cold starts,
  // because start-up has waited for independent clocks.
  template <typename Memory>
  void number_run(std::uint32_t ticks, Memory& memory) {
    run_number_ =
        begin_run(boot_record, {.noise = boot_noise, .ticks = ticks, .mac = mac_address_}, memory);
  }

  // The following functions write the parts of the banner: the version, the chip and the reason for
  // this boot, then "PHY ... at ...", then "MAC ...", and finally the last word of the previous
  // run, if any.
  TextLine begin_banner(std::string_view chip) const;
  static void add_phy(TextLine& line, const phy::Identity& phy);
  void add_mac(TextLine& line) const;
  template <typename Console>
  void print_last_word_before(Console& console) const {
    if (boot_.last_word_bytes != 0) {
      console.write("previous run: LAST WORD ");
      console.write(boot_.last_word_text());
      console.write("\n");
    }
  }

  MacAddress mac_address_;

 private:
  Boot boot_;
  std::uint32_t run_number_ = 0;
};

}  // namespace iog::board
