// The liveness monitor services the watchdog only while all checkpoints report within their time
// windows. The checkpoints are the steps of the loop, the cores, the Ethernet controller, the
// closing of frames and the memory check. If a checkpoint is late, the run ends, and the next run
// reports which checkpoint was late.
//
// A core that faulted or was stopped is known to be lost. A lost core does not have to report,
// because the other cores do its work (docs/cores.md). A core that should be alive but does not
// answer a wake-up counts as late, even if it has no work.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/cores.hpp"
#include "hal/end_of_run.hpp"
#include "hal/ethernet_port.hpp"
#include "health/memory_check.hpp"
#include "health/supervision.hpp"

namespace iog::app {

// The values are bit positions on the wire (docs/spec.md 3.7).
enum class Alive : std::uint8_t {
  kDatagrams,  // the loop has taken the datagrams that had arrived
  kTime,       // it has compared the clock with the frame's deadline
  kNetwork,    // it has handed frames to the controller
  kLine,       // it has served the serial line
  kFrames,     // a frame was closed, if only to report silence
  kMemory,     // a memory check is complete
  kPort,       // a frame was received or sent, there is no link, or nothing is waiting and the port
               // can receive
  kCore1,      // the core has answered a wake-up, or is known to be lost
  kCore2,
  kCore3,
};
inline constexpr std::size_t kAliveCount = 10;

class Life {
 public:
  // The window is longer than an emulated core may have to wait on a busy PC. It is also longer
  // than two periods of the slowest frames (2 s), because missing data is reported only after two
  // periods.
  static constexpr std::uint64_t kWindowUs = 5'000'000;
  // `docs/safety.md` states that a complete memory check takes at most kMemoryWindowUs.
  static constexpr std::uint64_t kMemoryWindowUs = 10'000'000;
  // The period for waking the cores and checking the controller. A window contains 20 of these
  // periods.
  static constexpr std::uint64_t kCallUs = 250'000;

  explicit Life(std::uint64_t now_us) : supervision_(kCheckpoints, now_us), called_us_(now_us) {}

  void lives(Alive who, std::uint64_t now_us) {
    supervision_.lives(static_cast<std::size_t>(who), now_us);
  }

  // Call this function once per pass, after all steps. `machine` and `platform` are the same as in
  // app/loop.hpp.
  template <typename M, typename P>
  void end_pass(M& machine, P& platform, const health::MemoryCheck& check) {
    const std::uint64_t now_us = machine.clock().now_us();
    note_progress(Alive::kFrames, platform.frames(), frames_, now_us);
    note_progress(Alive::kMemory, check.rounds(), rounds_, now_us);
    if (now_us - called_us_ >= kCallUs) {
      called_us_ = now_us;
      look_at(machine.ethernet().life(), now_us);
      call(platform.team(), now_us);
    }
    const std::uint32_t late = supervision_.late(now_us);
    if (late != 0) {
      platform.offering().withdraw();
      machine.end_run({.cause = hal::EndCause::kLate, .detail = late},
                      supervision_.name_of_first(late));
      return;
    }
    machine.watchdog().service();
  }

 private:
  using Supervision = health::Supervision<kAliveCount>;

  static constexpr Supervision::Checkpoints kCheckpoints{{
      {.name = "datagrams", .window_us = kWindowUs},
      {.name = "time", .window_us = kWindowUs},
      {.name = "network", .window_us = kWindowUs},
      {.name = "serial line", .window_us = kWindowUs},
      {.name = "frames", .window_us = kWindowUs},
      {.name = "check of memory", .window_us = kMemoryWindowUs},
      {.name = "Ethernet controller", .window_us = kWindowUs},
      {.name = "core 1", .window_us = kWindowUs},
      {.name = "core 2", .window_us = kWindowUs},
      {.name = "core 3", .window_us = kWindowUs},
  }};

  void note_progress(Alive who, std::uint32_t count, std::uint32_t& before, std::uint64_t now_us) {
    if (count != before) {
      before = count;
      lives(who, now_us);
    }
  }

  void look_at(const hal::PortLife& life, std::uint64_t now_us) {
    note_progress(Alive::kPort, life.moved, moved_, now_us);
    if (life.is_excused) {
      lives(Alive::kPort, now_us);
    }
  }

  // Reports each core as alive if it has answered since the last call or is not expected to answer.
  // Then wakes the cores again.
  template <typename Team>
  void call(Team& team, std::uint64_t now_us) {
    for (std::size_t core = 1; core < hal::kMaxCores; ++core) {
      const auto who = static_cast<Alive>(static_cast<std::size_t>(Alive::kCore1) + core - 1);
      note_progress(who, team.comes(core), comes_[core], now_us);
      if (!team.is_asked(core)) {
        lives(who, now_us);
      }
    }
    team.call();
  }

  Supervision supervision_;
  std::uint64_t called_us_;
  std::uint32_t frames_ = 0;
  std::uint32_t rounds_ = 0;
  std::uint32_t moved_ = 0;
  std::array<std::uint32_t, hal::kMaxCores> comes_{};
};

}  // namespace iog::app
