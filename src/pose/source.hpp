// The poses' source as the target knows it: its senders, what came of each datagram, and what came
// of each slice that asked for a pose. Everything that is not used is counted by its cause.
//
// The CRC finds what a network spoils; it is no authentication. Whoever can send in the name of the
// described address can move the vehicle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "health/constants.hpp"
#include "pose/fate.hpp"
#include "pose/history.hpp"
#include "pose/message.hpp"
#include "pose/slice.hpp"
#include "pose/source_description.hpp"

namespace iog::pose {

// What kept slices from their place, and broke the poses apart, since start.
struct CauseCounts {
  std::array<std::uint32_t, kCauseCount> slices{};  // as Source::slices()
  std::array<Tally, kCauseCount> began{};           // as Source::tally()

  // Bit by cause: it was met since those counts. kNone is no cause.
  [[nodiscard]] std::uint8_t since(const CauseCounts& before) const;
};

class Source {
 public:
  // description.is_valid(). replayer_ipv4 may send in the name of the source, 0: none.
  // depends_on_arrival: as of History.
  explicit Source(const SourceDescription& description, std::uint32_t replayer_ipv4 = 0,
                  bool depends_on_arrival = false);

  // Whether a datagram to this port is of poses.
  [[nodiscard]] bool listens_to(std::uint16_t udp_port) const {
    return udp_port == description_.udp_port;
  }

  // A datagram that came to the poses' port. Any bytes may come.
  Fate receive(std::uint32_t source_ipv4, std::span<const std::byte> payload,
               std::uint64_t arrival_us);

  // As in History.
  void pass(std::uint64_t now_us) { history_.pass(now_us); }
  void pass_silence(std::uint64_t target_us) { history_.pass_silence(target_us); }
  void contradict() { history_.contradict(); }
  [[nodiscard]] std::optional<std::uint64_t> source_time(std::uint64_t target_us) const {
    return history_.source_time(target_us);
  }
  [[nodiscard]] std::uint32_t epoch() const { return history_.epoch(); }
  [[nodiscard]] bool has_moved() const { return history_.has_moved(); }
  [[nodiscard]] std::optional<Message> newest() const { return history_.newest(); }

  // The slice that holds a time of the source's clock.
  [[nodiscard]] Slice slice_of(std::uint64_t time_us) const { return slicing_.slice_of(time_us); }

  // As in History; nothing is counted.
  [[nodiscard]] Placed pose_at(std::uint64_t time_us) const { return history_.pose_at(time_us); }

  // The pose of a slice, or the cause why it has none, which is counted. Ask once for each slice.
  [[nodiscard]] Placed place(const Slice& slice);

  // Datagrams by what became of them, since start.
  [[nodiscard]] const std::array<std::uint32_t, kFateCount>& fates() const { return fates_; }
  // Slices by why they had no pose (kNone: those that had one), since start.
  [[nodiscard]] const std::array<std::uint32_t, kCauseCount>& slices() const { return slices_; }
  // How often each cause has begun, and when it did last: of kLate and kImprecise the middle of the
  // first slice in a row that was not placed because of it; of the others as in History.
  [[nodiscard]] Tally tally(Cause cause) const;
  [[nodiscard]] CauseCounts cause_counts() const;

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, description_, replayer_ipv4_, slicing_);
    history_.for_each_constant(visit);
  }

 private:
  SourceDescription description_;
  std::uint32_t replayer_ipv4_;
  Slicing slicing_;
  History history_;
  std::array<std::uint32_t, kFateCount> fates_{};
  std::array<std::uint32_t, kCauseCount> slices_{};
  std::array<Tally, kCauseCount> spells_{};  // of slices
  Cause latest_ = Cause::kNone;              // of the latest slice
};

}  // namespace iog::pose
