// Receives poses, checks their senders, decodes each datagram, and looks up a pose for each slice.
// All rejections are counted by cause.
//
// The CRC detects transmission errors, but it does not authenticate the sender. Anyone who can send
// from the configured address can change the vehicle's pose.
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

// For each cause, the number of slices without a pose, and how often the cause began.
struct CauseCounts {
  std::array<std::uint32_t, kCauseCount> slices{};  // see Source::slices()
  std::array<Tally, kCauseCount> began{};           // see Source::tally()

  // Returns the causes that occurred since `before`, with one bit for each cause. There is no bit
  // for kNone.
  [[nodiscard]] std::uint8_t since(const CauseCounts& before) const;
};

class Source {
 public:
  // `description.is_valid()` must be true. `replayer_ipv4` is the address of a replayer that may
  // send on behalf of the source, or 0 if no replayer is used. For `depends_on_arrival`, see
  // History.
  explicit Source(const SourceDescription& description, std::uint32_t replayer_ipv4 = 0,
                  bool depends_on_arrival = false);

  // Returns true if the port receives poses.
  [[nodiscard]] bool listens_to(std::uint16_t udp_port) const {
    return udp_port == description_.udp_port;
  }

  // Processes a datagram on the pose port. The payload may contain any bytes.
  Fate receive(std::uint32_t source_ipv4, std::span<const std::byte> payload,
               std::uint64_t arrival_us);

  // See History.
  void pass(std::uint64_t now_us) { history_.pass(now_us); }
  void pass_silence(std::uint64_t target_us) { history_.pass_silence(target_us); }
  void contradict() { history_.contradict(); }
  [[nodiscard]] std::optional<std::uint64_t> source_time(std::uint64_t target_us) const {
    return history_.source_time(target_us);
  }
  [[nodiscard]] std::uint32_t epoch() const { return history_.epoch(); }
  [[nodiscard]] bool has_moved() const { return history_.has_moved(); }
  [[nodiscard]] std::optional<Message> newest() const { return history_.newest(); }

  // Returns the slice that contains a time on the source's clock.
  [[nodiscard]] Slice slice_of(std::uint64_t time_us) const { return slicing_.slice_of(time_us); }

  // See History. Unlike place(), this function does not change any counters.
  [[nodiscard]] Placed pose_at(std::uint64_t time_us) const { return history_.pose_at(time_us); }

  // Returns the pose of a slice, or the reason why there is none, and counts the result. Call
  // place() once per slice.
  [[nodiscard]] Placed place(const Slice& slice);

  // Returns the number of datagrams with each outcome since start-up.
  [[nodiscard]] const std::array<std::uint32_t, kFateCount>& fates() const { return fates_; }
  // Returns how many slices have had no pose since start-up, for each reason. The entry kNone is
  // the number of slices with a pose.
  [[nodiscard]] const std::array<std::uint32_t, kCauseCount>& slices() const { return slices_; }
  // Returns how often each cause began, and when it last began. For kLate and kImprecise, this is
  // the middle of the first of several consecutive slices with this cause. For the other causes,
  // see History.
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
