// The base class of each board's Board. It manages the run number, the end of the previous run, the
// end of this run, and the main stack.
#pragma once

#include <cstdint>
#include <string_view>

#include "board/common/ethernet/clause_22.hpp"
#include "board/common/ethernet/settings.hpp"
#include "boot_record.hpp"
#include "hal/end_of_run.hpp"
#include "text_line.hpp"

// startup.S calls main() after it has set up memory. In freestanding C++, main() is an ordinary
// function, so it needs a declaration with C linkage. It must not return.
extern "C" int main();

namespace iog::board {

class BoardRun {
 public:
  explicit BoardRun(const MacAddress& address) : mac_address_(address) {}

  const MacAddress& mac_address() const { return mac_address_; }

  // The number of this run, as hal::RunNumber requires.
  std::uint32_t run_number() const { return run_number_; }

  // Ends the run with a last word and a reset, as hal::EndsRuns requires.
  void end_run(hal::End end, std::string_view words);
  hal::RunBefore run_before() const { return boot_.before; }

  // The largest use of the main stack since start, and its size.
  std::uint32_t stack_used_bytes() const;
  std::uint32_t stack_bytes() const;

 protected:
  template <typename Memory>
  void open_record(Memory& memory) {
    boot_ = open_boot_record(boot_record, memory);
  }
  // Call it at the end of start-up. By then, waits for independent clocks make `ticks` vary between
  // cold starts.
  template <typename Memory>
  void number_run(std::uint32_t ticks, Memory& memory) {
    run_number_ =
        begin_run(boot_record, {.noise = boot_noise, .ticks = ticks, .mac = mac_address_}, memory);
  }

  // Parts of the banner: version, chip and the reason for this boot; "PHY ... at ..."; "MAC ...";
  // the last word of the previous run, if there is one.
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
