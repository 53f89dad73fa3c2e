// Where commands come in, which are poses and maps: of a car that has a key, those alone that are
// signed with it, as they were before they were signed. Everything else passes as it is.
//
//     datagram -> [gate] authentic pose or chunk -> pipeline
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "authentication/secured_message.hpp"
#include "intake/datagram.hpp"
#include "map/chunk.hpp"
#include "pose/message.hpp"
#include "protection/believed.hpp"
#include "stream/channel.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::app {

// Whose commands are to be signed, and with what; its stream is signed, too. A car without classes
// takes none.
struct SignedCommands {
  authentication::Key key{};
  const vehicle::Vehicle* vehicle = nullptr;
  std::uint32_t replayer_ipv4 = 0;  // as of the pipeline
};

class CommandGate {
 public:
  // Messages of poses by authentication::Verdict, and the counter of the last authentic one; then
  // the same of maps; then what signs all of these, two words.
  static constexpr std::size_t kCountsOfOne = authentication::kVerdictCount + 1;
  static constexpr std::size_t kCounts = 2 * kCountsOfOne + 2;
  using Counts = std::array<std::uint32_t, kCounts>;

  // Without commands everything passes. run: of the target, which signers have heard of.
  CommandGate(const std::optional<SignedCommands>& commands, std::uint32_t run) {
    if (!commands) {
      return;
    }
    const vehicle::Vehicle& car = *commands->vehicle;
    run_ = run;
    replayer_ipv4_ = commands->replayer_ipv4;
    key_.emplace(commands->key);
    if (vehicle::have_classes(car.grids)) {
      doors_[0].emplace(car.poses.source_ipv4, car.poses.udp_port,
                        authentication::Verifier(*key_, pose::kPoseChannel.event.event_id, run));
      doors_[1].emplace(car.maps.source_ipv4, car.maps.udp_port,
                        authentication::Verifier(*key_, map::kMapChannel.event.event_id, run));
    }
  }
  // Verifiers point to the key.
  CommandGate(const CommandGate&) = delete;
  CommandGate& operator=(const CommandGate&) = delete;

  [[nodiscard]] bool is_on() const { return key_.has_value(); }

  // Of a gate that is on; as long as the gate.
  [[nodiscard]] const authentication::CmacKey& key() const { return *key_; }

  // The datagram as the pipeline is to see it, valid until the next one; nothing: it is no
  // authentic command. A stranger's is passed without its bytes, and counted as a stranger's there:
  // no MAC is computed for an address that the target does not listen to.
  [[nodiscard]] std::optional<intake::Datagram> pass(const intake::Datagram& datagram) {
    for (std::optional<Door>& door : doors_) {
      if (door && door->udp_port == datagram.destination_port) {
        return pass(datagram, *door);
      }
    }
    return datagram;
  }

  // Only of a gate that is on.
  [[nodiscard]] Counts counts() const {
    Counts counts{};
    for (std::size_t i = 0; i < doors_.size(); ++i) {
      if (doors_[i]) {
        const auto begin = counts.begin() + static_cast<std::ptrdiff_t>(i * kCountsOfOne);
        *std::ranges::copy(doors_[i]->verdicts, begin).out = doors_[i]->verifier.counter();
      }
    }
    const auto signature =
        authentication::mac_of_counters(*key_, stream::kNetworkChannel.event.event_id, run_,
                                        std::span(counts).first<kCounts - 2>());
    std::ranges::copy(signature, counts.end() - 2);
    return counts;
  }

 private:
  struct Door {
    Door(std::uint32_t ipv4, std::uint16_t port, const authentication::Verifier& its)
        : source_ipv4(ipv4), udp_port(port), verifier(its) {}

    std::uint32_t source_ipv4;
    std::uint16_t udp_port;
    authentication::Verifier verifier;
    std::array<std::uint32_t, authentication::kVerdictCount> verdicts{};
  };

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

  std::uint32_t run_ = 0;
  std::uint32_t replayer_ipv4_ = 0;
  std::optional<authentication::CmacKey> key_;
  std::array<std::optional<Door>, 2> doors_{};
  std::array<std::byte, protection::kMaxMessageBytes> message_{};
};

}  // namespace iog::app
