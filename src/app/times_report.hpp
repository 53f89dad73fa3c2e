// What the loop has measured of itself, for the console: "worst publish 12345 us" when one of its
// times has become worse. A line fits into the transmitter of a serial line, so writing it does
// not block.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "app/loop_times.hpp"
#include "hal/console.hpp"

namespace iog::app {

class TimesReport {
 public:
  // A line a second at most. Call it when nothing waits.
  template <hal::Console Console>
  void tell(LoopTimes& times, std::uint64_t now_us, Console& console) {
    if (now_us - told_us_ < kEveryUs) {
      return;
    }
    told_us_ = now_us;
    if (const auto news = times.news()) {
      console.write("worst ");
      console.write(news->name);
      console.write(" ");
      write(news->worst_us, console);
      console.write(" us\n");
    }
  }

 private:
  static constexpr std::uint64_t kEveryUs = 1'000'000;

  template <hal::Console Console>
  static void write(std::uint32_t number, Console& console) {
    std::array<char, 10> digits{};
    std::size_t first = digits.size();
    do {
      digits[--first] = static_cast<char>('0' + number % 10);
      number /= 10;
    } while (number != 0);
    console.write(std::string_view(digits.data() + first, digits.size() - first));
  }

  std::uint64_t told_us_ = 0;
};

}  // namespace iog::app
