// The main loop, which handles everything after start-up.
//
//     wire bytes -> datagram -> scan points -> beams -> cells -> indexes -> tiles -> wire bytes
//                          '-> poses -> slices -> masses of the window -> classes -^
//
// The loop never blocks. The loop processes datagrams as they arrive and puts messages into the
// transmit ring. When there is no more work to do, the processor sleeps until the next Ethernet
// frame or tick. If the loop is too slow, datagrams are shed and counted (app/backlog.hpp).
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "app/backlog.hpp"
#include "app/command_gate.hpp"
#include "app/core_report.hpp"
#include "app/life.hpp"
#include "app/loop_times.hpp"
#include "app/offering.hpp"
#include "app/pipeline.hpp"
#include "authentication/stream_signer.hpp"
#include "hal/clock.hpp"
#include "hal/console.hpp"
#include "hal/cores.hpp"
#include "hal/end_of_run.hpp"
#include "hal/ethernet_port.hpp"
#include "hal/run_number.hpp"
#include "hal/serial_port.hpp"
#include "hal/shared_cache.hpp"
#include "hal/thermometer.hpp"
#include "hal/watchdog.hpp"
#include "health/memory_check.hpp"
#include "net/host.hpp"
#include "require/require.hpp"
#include "serial/grid_sender.hpp"
#include "stream/channel.hpp"
#include "stream/message.hpp"
#include "stream/target_state.hpp"
#include "work/team.hpp"

namespace iog::app {

// A machine provides one object for each hardware interface, and reports the maximum stack depth so
// far.
template <typename T>
concept Machine = requires(T& machine) {
  requires hal::Clock<std::remove_reference_t<decltype(machine.clock())>>;
  requires hal::Stopwatch<std::remove_reference_t<decltype(machine.stopwatch())>>;
  requires hal::Watchdog<std::remove_reference_t<decltype(machine.watchdog())>>;
  requires hal::EthernetPort<std::remove_reference_t<decltype(machine.ethernet())>>;
  requires hal::SerialPort<std::remove_reference_t<decltype(machine.serial())>>;
  requires hal::RunNumber<T>;
  requires hal::EndsRuns<T>;
  requires hal::Thermometer<T>;
  requires hal::Cores<std::remove_reference_t<decltype(machine.cores())>>;
  requires hal::Console<std::remove_reference_t<decltype(machine.console())>>;
  { machine.stack_used_bytes() } -> std::convertible_to<std::uint32_t>;
  { machine.idle() } -> std::same_as<void>;
};

// The maximum number of datagrams that the loop processes in one pass. This limit ensures that the
// loop runs its tick and services the watchdog even during a flood of datagrams. A frame from four
// LUX units consists of 24 datagrams, and the receive ring holds 256 datagrams.
inline constexpr int kMaxDatagramsPerPass = 64;

// The maximum number of datagrams that the loop sheds at once if it is too slow. This limit is
// twice the capacity of the receive ring, because the ring may fill up again during shedding.
inline constexpr int kMaxDatagramsLeft = 512;

// Adapts the machine to Platform, the interface that the pipeline requires.
template <Machine M>
class MachinePlatform {
 public:
  using Port = std::remove_reference_t<decltype(std::declval<M&>().ethernet())>;

  using Team = work::Team<std::remove_reference_t<decltype(std::declval<M&>().cores())>>;

  // `cores` is the number of cores to use. If the machine has fewer cores, all of its cores are
  // used. `commands` is set only if the car has a key.
  MachinePlatform(M& machine, const net::Config& config, std::size_t cores = 1,
                  const std::optional<SignedCommands>& commands = {})
      : team_(machine.cores(), kPatienceUs),
        machine_(machine),
        host_(machine.ethernet(), config),
        offering_(machine.ethernet(), host_, config, machine.run_number()),
        gate_(commands, machine.run_number()) {
    team_.start(cores);
    report_cores(machine_.console(), team_);
    if (gate_.is_on()) {
      signer_.emplace(gate_.key(), stream::kSignatureChannel, machine.run_number());
    }
  }

  [[nodiscard]] net::Host<Port>& host() { return host_; }
  [[nodiscard]] Offering<Port>& offering() { return offering_; }

  // Returns the datagram to pass to the pipeline. Returns nothing if service discovery has handled
  // the datagram, or if a required signature is invalid. The returned datagram is valid until the
  // next call.
  [[nodiscard]] std::optional<intake::Datagram> admit(const net::Datagram& datagram,
                                                      std::uint64_t now_us) {
    if (offering_.take(datagram, now_us)) {
      return std::nullopt;
    }
    return gate_.pass({datagram.source.value, datagram.destination_port, datagram.payload});
  }

  // Sends a message. A frame may have hundreds of messages, so each call also services the serial
  // transmitter.
  [[nodiscard]] bool send_message(std::span<const std::byte> message) {
    machine_.serial().pump();
    const bool is_sent = offering_.send_message(message);
    if (signer_) {
      sign(message);
    }
    return is_sent;
  }

  // `team()` returns the supervised cores (app/life.hpp). `frames()` returns the number of closed
  // frames, modulo 2^32.
  [[nodiscard]] Team& team() { return team_; }
  [[nodiscard]] std::uint32_t frames() const { return frames_; }

  [[nodiscard]] std::size_t cores() const { return team_.cores(); }
  void share(std::size_t items, work::Work work, work::Beside beside = {}) {
    const std::uint32_t before = team_.troubles();
    auto timed = [this, work](std::size_t item, std::size_t core) {
      const std::uint32_t begin = machine_.stopwatch().ticks();
      work.run(work.context, item, core);
      core_times_.add(core, machine_.stopwatch().ticks() - begin);
    };
    team_.share(items, work::work_of(timed), beside);
    if (team_.troubles() != before) {
      report_cores(machine_.console(), team_);
    }
  }

  void keep_cache(bool keep) {
    if constexpr (hal::SharedCache<M>) {
      machine_.keep_cache(keep);
    }
  }

  // Writes the time statistics to the console. Call this function when no work is pending.
  void tell_times(std::uint64_t now_us) { times_.tell(now_us, machine_.console()); }

  std::uint32_t ticks() { return machine_.stopwatch().ticks(); }
  std::uint32_t ticks_hz() { return machine_.stopwatch().ticks_hz(); }
  std::uint32_t run_number() { return machine_.run_number(); }

  // The counters for signed commands are included only if signed commands are enabled. The counters
  // for service discovery are included if service discovery or signed commands are enabled.
  [[nodiscard]] const Vitals& vitals(const FrameTimes& times) {
    ++frames_;
    offering_.begin_frame();
    times_.add(times, core_times_, ticks_hz());
    Vitals& vitals = vitals_;
    vitals.stack_used_bytes = machine_.stack_used_bytes();
    vitals.temperature_dc = machine_.temperature_dc();
    stream::put_all(vitals.link_counters, host_.counters(), machine_.ethernet().counters(),
                    team_.counts(), machine_.run_before(), times_.counts(), offering_.counts(),
                    gate_.counts());
    vitals.link_counter_count = gate_.is_on()       ? stream::kMaxLinkCounters
                                : offering_.is_on() ? stream::place_of(stream::Group::kCommand)
                                                    : stream::place_of(stream::Group::kDiscovery);
    vitals.link_drops = stream::losses_of(vitals.link_counters);
    return vitals;
  }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    host_.for_each_constant(visit);
    offering_.for_each_constant(visit);
    gate_.for_each_constant(visit);
  }

 private:
  // A signature is sent after each frame. If a frame has many messages, signatures are also sent
  // between the messages.
  void sign(std::span<const std::byte> message) {
    signer_->add(message);
    if (signer_->is_full() || stream::ends_frame(message)) {
      static_cast<void>(offering_.send_message(signer_->sign()));
    }
  }

  // One frame period. Encoding all tiles takes a small fraction of a frame period.
  static constexpr std::uint32_t kPatienceUs = 40'000;

  // Members aligned to a cache line come first.
  work::CoreTimes core_times_;
  Team team_;
  M& machine_;
  net::Host<Port> host_;
  Offering<Port> offering_;
  CommandGate gate_;
  std::optional<authentication::StreamSigner> signer_;
  LoopTimes times_;
  std::uint32_t frames_ = 0;
  Vitals vitals_;
};

// The target's pipeline. The pipeline sends every frame, including any classes, to the network. The
// serial link carries as much of the frame's grid as the link's bandwidth allows.
template <Machine M, vehicle::Grids kGrids>
using MachinePipeline =
    std::conditional_t<vehicle::have_classes(kGrids),
                       PerceptionPipeline<MachinePlatform<M>, serial::GridSender>,
                       Pipeline<MachinePlatform<M>, serial::GridSender>>;

// Returns true if fusing must stop because the current frame is due to end.
template <typename ItsPipeline>
[[nodiscard]] bool must_yield(const Backlog& backlog, const ItsPipeline& pipeline,
                              std::uint64_t now_us) {
  return pipeline.is_begun() && backlog.must_yield(pipeline.deadline_us(), now_us);
}

// Processes the datagrams of one pass, at most kMaxDatagramsPerPass. If the frame is due to end,
// the function stops early, so that slow processing of points cannot delay the end of the frame.
// The function also stops early if datagrams have waited too long.
template <Machine M, typename ItsPipeline>
void take_datagrams(M& machine, MachinePlatform<M>& platform, const Backlog& backlog,
                    ItsPipeline& pipeline) {
  for (int taken = 0; taken < kMaxDatagramsPerPass; ++taken) {
    const std::uint64_t now_us = machine.clock().now_us();
    if (must_yield(backlog, pipeline, now_us) || backlog.is_too_long(now_us)) {
      break;
    }
    const auto datagram = platform.host().poll(now_us);
    if (!datagram) {
      break;
    }
    if (const auto admitted = platform.admit(*datagram, now_us)) {
      pipeline.take(*admitted, now_us);
    }
    machine.serial().pump();
  }
}

// Sheds the datagrams in the receive ring. If the frame is due to end, it is closed first, and the
// next pass sheds the remaining datagrams.
template <Machine M, typename ItsPipeline>
void leave_datagrams(M& machine, MachinePlatform<M>& platform, Backlog& backlog,
                     ItsPipeline& pipeline) {
  std::uint64_t now_us = machine.clock().now_us();
  for (int left = 0; left < kMaxDatagramsLeft; ++left) {
    if (must_yield(backlog, pipeline, now_us)) {
      return;
    }
    const auto datagram = platform.host().poll(now_us);
    if (!datagram) {
      break;
    }
    if (const auto admitted = platform.admit(*datagram, now_us)) {
      pipeline.leave(*admitted, now_us);
    }
    now_us = machine.clock().now_us();
  }
  backlog.begin(now_us);
}

// Runs the next step of the memory check if it is due. Ends the run if a memory region has changed.
template <Machine M>
void check_memory(M& machine, health::MemoryCheck& check) {
  if (const auto changed = check.step(machine.clock().now_us())) {
    machine.end_run(
        {.cause = hal::EndCause::kMemory, .detail = static_cast<std::uint32_t>(*changed)},
        check.regions()[*changed].name);
  }
}

// Runs one pass of the loop. A pass processes datagrams, performs the actions that are due, and
// sends as many messages as possible. Returns true if Ethernet frames are still waiting.
template <Machine M, typename ItsPipeline>
bool pass(M& machine, MachinePlatform<M>& platform, serial::GridSender& serial, Backlog& backlog,
          health::MemoryCheck& check, Life& life, ItsPipeline& pipeline) {
  const auto now_us = [&machine] { return machine.clock().now_us(); };
  backlog.begin_pass(now_us());
  take_datagrams(machine, platform, backlog, pipeline);
  life.lives(Alive::kDatagrams, now_us());
  pipeline.tick(now_us());
  platform.offering().tick(now_us());
  life.lives(Alive::kTime, now_us());
  machine.ethernet().pump();
  life.lives(Alive::kNetwork, now_us());
  serial.pump(now_us(), machine.serial());
  life.lives(Alive::kLine, now_us());
  check_memory(machine, check);
  life.end_pass(machine, platform, check);
  if (machine.ethernet().receive().empty()) {
    backlog.clear();
    platform.tell_times(now_us());
    return false;
  }
  if (backlog.is_too_long(now_us())) {
    leave_datagrams(machine, platform, backlog, pipeline);
  }
  return true;
}

// Runs the loop and never returns. The pipeline contains the grid, so it must be in static memory.
template <Machine M, typename ItsPipeline>
[[noreturn]] void run(M& machine, MachinePlatform<M>& platform, serial::GridSender& serial,
                      health::MemoryCheck& check, ItsPipeline& pipeline) {
  Backlog backlog;
  Life life(machine.clock().now_us());
  pipeline.start(machine.clock().now_us());
  for (;;) {
    if (!pass(machine, platform, serial, backlog, check, life, pipeline)) {
      machine.idle();
    }
  }
}

}  // namespace iog::app
