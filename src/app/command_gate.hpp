// Checks the signatures of commands (poses and maps). If the car has a key, only commands signed
// with this key pass the gate, and the gate removes their signatures. All other datagrams pass
// unchanged.
//
//     datagram -> [gate] authentic pose or chunk -> pipeline
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "authentication/command_counts.hpp"
#include "authentication/secured_message.hpp"
#include "intake/datagram.hpp"
#include "map/chunk.hpp"
#include "pose/message.hpp"
#include "protection/believed.hpp"
#include "stream/channel.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::app {

// A car that accepts only signed commands. The target also signs its stream with `key`. If the car
// file does not enable classes, the target accepts no commands.
struct SignedCommands {
  authentication::Key key{};
  const vehicle::Vehicle* vehicle = nullptr;
  std::uint32_t replayer_ipv4 = 0;  // as for the pipeline
};

class CommandGate {
 public:
  // If `commands` is empty, every datagram passes the gate. `run` is the target's run number, which
  // every signature covers.
  CommandGate(const std::optional<SignedCommands>& commands, std::uint32_t run)
      : CommandGate(commands.value_or(SignedCommands{}), run, commands ? kOn : kOff) {}
  // The gate is not copyable, because the verifiers point to the key.
  CommandGate(const CommandGate&) = delete;
  CommandGate& operator=(const CommandGate&) = delete;

  [[nodiscard]] bool is_on() const { return signs_ != kOff; }

  // Returns the key, which is meaningful only if the gate is enabled. The reference is valid for
  // the lifetime of the gate.
  [[nodiscard]] const authentication::CmacKey& key() const { return key_; }

  // Returns the datagram to pass to the pipeline. Returns nothing if the datagram is a command that
  // is not authentic. The returned datagram is valid until the next call. A command from an unknown
  // source is passed on with an empty payload so that the pipeline can count it. The gate therefore
  // computes no MAC for unknown sources.
  [[nodiscard]] std::optional<intake::Datagram> pass(const intake::Datagram& datagram) {
    if (guards_ == kOff) {
      return datagram;
    }
    for (Door& door : doors_) {
      if (door.udp_port == datagram.destination_port ||
          door.same_udp_port == datagram.destination_port) {
        return pass(datagram, door);
      }
    }
    return datagram;
  }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, signs_, guards_, run_, replayer_ipv4_, key_);
    for (const Door& door : doors_) {
      health::visit_constants(visit, door.source_ipv4, door.udp_port, door.same_udp_port);
      door.verifier.for_each_constant(visit);
    }
  }

  // All counts are 0 if the gate is disabled.
  [[nodiscard]] authentication::CommandCounts counts() const {
    authentication::CommandCounts counts;
    if (is_on()) {
      for (std::size_t i = 0; i < doors_.size(); ++i) {
        counts.kinds[i] = {doors_[i].verdicts, doors_[i].verifier.counter()};
      }
      counts.signature = counts.signature_by(key_, stream::kNetworkChannel.event.event_id, run_);
    }
    return counts;
  }

 private:
  // Only the value kOff disables the gate. A single bit flip cannot change kOn to kOff.
  static constexpr std::uint32_t kOff = 0x6F66'6621;
  static constexpr std::uint32_t kOn = 0x9099'99DE;

  // The port is stored twice, so that one copy is still correct after a bit flip.
  struct Door {
    std::uint32_t source_ipv4;
    std::uint16_t udp_port;
    std::uint16_t same_udp_port;
    authentication::Verifier verifier;
    std::array<std::uint32_t, authentication::kVerdictCount> verdicts{};
  };

  CommandGate(const SignedCommands& commands, std::uint32_t run, std::uint32_t signs)
      : signs_(signs),
        guards_(signs == kOn && vehicle::have_classes(commands.vehicle->grids) ? kOn : kOff),
        run_(run),
        replayer_ipv4_(commands.replayer_ipv4),
        key_(commands.key),
        doors_{{door_of(signs == kOn ? commands.vehicle->poses : pose::SourceDescription{},
                        pose::kPoseChannel),
                door_of(signs == kOn ? commands.vehicle->maps : map::SourceDescription{},
                        map::kMapChannel)}} {}

  template <typename Source>
  [[nodiscard]] Door door_of(const Source& source, const protection::Channel& channel) const {
    return {.source_ipv4 = source.source_ipv4,
            .udp_port = source.udp_port,
            .same_udp_port = source.udp_port,
            .verifier = authentication::Verifier(key_, channel.event.event_id, run_)};
  }

  std::optional<intake::Datagram> pass(intake::Datagram datagram, Door& door) {
    if (!protection::may_send(datagram.source_ipv4, door.source_ipv4, replayer_ipv4_)) {
      datagram.payload = {};
      return datagram;
    }
    const authentication::Verdict verdict = door.verifier.verify(datagram.payload);
    ++door.verdicts[static_cast<std::size_t>(verdict)];
    if (verdict != authentication::Verdict::kAuthentic) {
      return std::nullopt;
    }
    const auto message =
        std::span(message_).first(datagram.payload.size() - authentication::kTrailerBytes);
    authentication::strip(datagram.payload, message);
    datagram.payload = message;
    return datagram;
  }

  std::uint32_t signs_;
  std::uint32_t guards_;
  std::uint32_t run_;
  std::uint32_t replayer_ipv4_;
  authentication::CmacKey key_;
  std::array<Door, 2> doors_;
  std::array<std::byte, protection::kMaxMessageBytes> message_{};
};

}  // namespace iog::app
