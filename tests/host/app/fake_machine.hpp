// What MachinePlatform asks of a board, with a clock that goes on only where a test moves it or the
// loop idles, a ring that takes any frame, and a serial line that takes nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fakes/fake_ethernet_port.hpp"
#include "fakes/scripted_cores.hpp"
#include "hal/end_of_run.hpp"
#include "hal/thermometer.hpp"

namespace iog::app::testing {

struct FakeClock {
  std::uint64_t time_us = 1'000'000;
  [[nodiscard]] std::uint64_t now_us() const { return time_us; }
};

struct FakeStopwatch {
  [[nodiscard]] std::uint32_t ticks() const { return 0; }
  [[nodiscard]] std::uint32_t ticks_hz() const { return 1'000'000; }
};

struct FakeConsole {
  std::string text{};
  void write(std::string_view line) { text += line; }
};

struct FakeWatchdog {
  void service() { ++services; }
  std::uint32_t services = 0;
};

struct FakeLine {
  [[nodiscard]] std::uint32_t bytes_per_second() const { return 11'520; }
  [[nodiscard]] std::size_t free_bytes() const { return 0; }
  void write(std::span<const std::byte> /*bytes*/) {}
  void pump() {}
};

class FakeMachine {
 public:
  FakeMachine() { port_.set_ring_slots(100'000); }
  FakeClock& clock() { return clock_; }
  const FakeStopwatch& stopwatch() { return stopwatch_; }
  FakeWatchdog& watchdog() { return watchdog_; }
  fakes::FakeEthernetPort& ethernet() { return port_; }
  FakeLine& serial() { return line_; }
  tests::ScriptedCores& cores() { return cores_; }
  FakeConsole& console() { return console_; }
  [[nodiscard]] std::uint32_t run_number() const { return 1; }
  // It goes on: whoever ends it looks at `ends`.
  void end_run(hal::End end, std::string_view words) {
    ends.push_back(end);
    last_words += words;
  }
  [[nodiscard]] hal::RunBefore run_before() const { return before; }
  [[nodiscard]] std::uint32_t stack_used_bytes() const { return 0; }
  [[nodiscard]] std::int16_t temperature_dc() const { return temperature; }
  void idle() { clock_.time_us += 100; }

  hal::RunBefore before{};
  std::int16_t temperature = hal::kTemperatureNotKnown;
  std::vector<hal::End> ends{};
  std::string last_words{};

 private:
  FakeClock clock_;
  FakeStopwatch stopwatch_;
  FakeWatchdog watchdog_;
  fakes::FakeEthernetPort port_;
  FakeLine line_;
  tests::ScriptedCores cores_;
  FakeConsole console_;
};

}  // namespace iog::app::testing
