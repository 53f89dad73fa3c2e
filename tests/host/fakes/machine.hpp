// The machine of the tests: registers are RAM, and every store and barrier is written down in
// order.
//
// A test may answer like a device: `on_store` runs after each store, `on_load` before each load,
// and both may change the registers with poke().
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

namespace iog::board {}
namespace iog::imx6 {
using namespace board;  // NOLINT(google-build-using-namespace): shared parts
}
namespace iog::zcu102 {
using namespace board;  // NOLINT(google-build-using-namespace): shared parts
}

namespace iog::machine {

struct Event {
  enum class Kind { kStore, kBarrier, kSleep };
  Kind kind = Kind::kStore;
  const void* address = nullptr;
  std::uint32_t value = 0;
};

// What happened since the last reset(). One trace for the whole process: tests run one at a time.
struct Recorder {
  std::vector<Event> events;
  std::function<void(const void* address, std::uint32_t value)> on_store;
  std::function<void(const void* address)> on_load;

  void reset() { *this = Recorder{}; }
};
inline Recorder recorder;

template <typename T>
inline T load(const T& location) {
  if (recorder.on_load) {
    recorder.on_load(&location);
  }
  T value{};
  std::memcpy(&value, &location, sizeof(T));
  return value;
}

template <typename T>
inline void store(T& location, T value) {
  std::memcpy(&location, &value, sizeof(T));
  recorder.events.push_back({Event::Kind::kStore, &location, value});
  if (recorder.on_store) {
    recorder.on_store(&location, value);
  }
}

inline constexpr std::size_t kBurstBytes = 32;
inline void copy_bursts(std::byte* to, const std::byte* from, std::size_t bursts) {
  std::memcpy(to, from, bursts * kBurstBytes);
}

inline void barrier() { recorder.events.push_back({Event::Kind::kBarrier}); }
inline void wait_for_interrupt() { recorder.events.push_back({Event::Kind::kSleep}); }
inline void yield() {}

// The counter of the ZCU102, in microseconds, as the test sets it.
inline std::uint64_t counter_us = 0;
inline std::uint64_t counter() { return counter_us; }
inline std::uint64_t counter_hz() { return 1'000'000; }

// Half of a pointer of the PC: enough to tell buffers apart, and what the rings write in
// descriptors.
template <typename T>
inline std::uint32_t bus_address(const T& object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&object));
}

// The hardware's side of a register: sets it without a trace, whatever its type allows the driver.
template <typename Register, typename Word>
inline void poke(Register& target, Word value) {
  static_assert(sizeof(Register) == sizeof(Word));
  std::memcpy(static_cast<void*>(&target), &value, sizeof(Word));
}

template <typename Word, typename Register>
inline Word peek(const Register& source) {
  static_assert(sizeof(Register) == sizeof(Word));
  Word value{};
  std::memcpy(&value, &source, sizeof(Word));
  return value;
}

}  // namespace iog::machine
