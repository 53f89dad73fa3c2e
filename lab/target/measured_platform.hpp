// What the pipeline meets in the benchmark (app::Platform): messages go into Ethernet frames of the
// firmware's port, as on the target, and from there nowhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "app/platform.hpp"
#include "instruction_counter.hpp"
#include "lab/a9_model/marker.hpp"
#include "net/config.hpp"
#include "net/outbound.hpp"
#include "require/require.hpp"
#include "wire.hpp"
#include "work/round.hpp"

namespace iog::lab {

// What was divided among cores since the model was last told to forget: items of each round of the
// cores, in order, and kFrameEnd for the end of a frame. What core 0 does beside a round is its
// first item. The model is told of the end of each item, and of what one core did alone before the
// items.
class SharedRounds {
 public:
  static constexpr std::uint16_t kFrameEnd = 0;
  // All items are done as by a helper, which keeps what it changes as it was before.
  static constexpr std::size_t kHelper = 1;

  void share(std::size_t items, work::Work work, work::Beside beside) {
    const bool is_beside = beside.run != nullptr;
    note(static_cast<std::uint16_t>(items + (is_beside ? 1 : 0)));
    a9_model::end_round();
    if (is_beside) {
      beside();
      a9_model::end_round();
    }
    for (std::size_t item = 0; item < items; ++item) {
      work.run(work.context, item, kHelper);
      a9_model::end_round();
    }
  }
  void end_frame() {
    note(kFrameEnd);
    a9_model::end_round();
  }
  void forget() {
    count_ = 0;
    a9_model::forget_so_far();
  }
  [[nodiscard]] std::span<const std::uint16_t> rounds() const {
    return std::span(rounds_).first(count_);
  }

 private:
  void note(std::uint16_t items) {
    require(count_ < rounds_.size());
    rounds_[count_++] = items;
  }

  std::size_t count_ = 0;
  std::array<std::uint16_t, 1024> rounds_{};
};

class MeasuredPlatform {
 public:
  // cores: as many as the pipeline is to think that there are. One does all of their work.
  explicit MeasuredPlatform(InstructionCounter& counter, std::size_t cores = 1)
      : counter_(counter), cores_(cores) {}

  [[nodiscard]] bool send_message(std::span<const std::byte> message) {
    imx6::EnetPort& port = Wire::of_machine().port();
    const std::span<std::byte> buffer = port.acquire();
    require(buffer.size() >= net::kMaxFrameBytes);
    const std::size_t frame_bytes = net::build_datagram(
        buffer.first<net::kMaxFrameBytes>(), kNetwork, kPeer, identification_++, message);
    last_messages_[slot_] = buffer.subspan(net::kMessageOffset, message.size());
    port.commit(frame_bytes);
    sent_bytes_ += frame_bytes;
    ++messages_;
    if (messages_ % board::TransmitShaper::kFramesPerWindow == 0) {
      port.pump();
    }
    return true;
  }

  void keep_cache(bool keep) {
    Wire::of_machine().cache().keep(keep);
    if (keep) {
      a9_model::keep_l2();
    } else {
      a9_model::release_l2();
    }
  }

  [[nodiscard]] std::uint32_t ticks() { return counter_.now(); }
  [[nodiscard]] std::uint32_t ticks_hz() const {
    return InstructionCounter::kInstructionsPerSecond;
  }
  [[nodiscard]] std::uint32_t run_number() const { return 1; }
  [[nodiscard]] std::size_t cores() const { return cores_; }
  void share(std::size_t items, work::Work work, work::Beside beside = {}) {
    if (cores_ == 1 || items == 0) {
      work::do_alone(items, work, beside);
    } else {
      shared_.share(items, work, beside);
    }
  }
  [[nodiscard]] SharedRounds& shared() { return shared_; }

  // Called once for each frame, before its first message. One datagram closes two frames at most,
  // the second of which is all but empty, so that the last message of either is still in the ring.
  [[nodiscard]] app::Vitals vitals(const app::FrameTimes& /*times*/) {
    slot_ ^= 1U;
    ++closed_;
    return {};
  }

  // Calls visit(message) with the last message of each frame that has closed since the last call.
  template <typename Visit>
  void for_each_closed(Visit&& visit) {
    for (unsigned count = std::exchange(closed_, 0U); count > 0; --count) {
      visit(last_messages_[(slot_ + count - 1) % last_messages_.size()]);
    }
  }

  [[nodiscard]] std::uint64_t messages() const { return messages_; }
  [[nodiscard]] std::uint64_t sent_bytes() const { return sent_bytes_; }  // whole Ethernet frames

 private:
  // Addresses change no instruction count.
  static constexpr net::Config kNetwork{.mac = {{0x02, 0, 0, 0, 0, 1}},
                                        .address = net::ipv4(10, 0, 2, 15),
                                        .prefix_bits = 24,
                                        .peer = net::ipv4(10, 0, 2, 2),
                                        .peer_port = 15'000,
                                        .source_port = 15'001};
  static_assert(net::is_valid(kNetwork));
  static constexpr net::Destination kPeer{.mac = {{0x02, 0, 0, 0, 0, 2}},
                                          .address = kNetwork.peer,
                                          .port = kNetwork.peer_port,
                                          .source_port = kNetwork.source_port};

  InstructionCounter& counter_;
  std::size_t cores_;
  SharedRounds shared_;
  std::array<std::span<const std::byte>, 2> last_messages_{};
  unsigned slot_ = 0;
  unsigned closed_ = 0;
  std::uint16_t identification_ = 0;
  std::uint64_t messages_ = 0;
  std::uint64_t sent_bytes_ = 0;
};

}  // namespace iog::lab
