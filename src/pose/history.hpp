// The poses of the last second, interpolated at any time in it.
//
// Times are in us of the clock of the pose source, unless they are called the target's. Messages
// must come in the order of that clock; a message that is not newer than the newest is dropped. A
// sequence of poses ends with a break: a silence of kLostUs, a jump, a new run of the source, a
// contradiction by the sensors, or a growing delay. Data registered before a break has lost its
// place, so its window is unknown.
//
// A forged message must not blind the target for good. A message of another run or another time,
// which does not continue the present sequence, is accepted only after kConfirmations of them in a
// row. If it goes back in time, or to an earlier run, the present sequence must also have been
// silent for kLostUs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "health/constants.hpp"
#include "pose/fate.hpp"
#include "pose/limits.hpp"
#include "pose/message.hpp"
#include "pose/motion.hpp"
#include "pose/run_memory.hpp"

namespace iog::pose {

// The pose at a time, or the reason why there is none.
struct Placed {
  Cause cause = Cause::kLost;
  // Valid if the cause is kNone. Otherwise the pose is zero, and its deviations are unknown.
  Pose pose{};
  Sigma sigma{};  // the larger ones of the messages that it is interpolated from
  [[nodiscard]] constexpr bool has_pose() const { return cause == Cause::kNone; }
  friend constexpr bool operator==(const Placed&, const Placed&) = default;
};

// How often a cause began, and when it began last.
struct Tally {
  std::uint32_t times = 0;
  std::uint64_t since_us = 0;
};

class History {
 public:
  // depends_on_arrival: packets are timed by the offset of the clocks, so the offset must not grow
  // faster than clocks drift.
  explicit History(bool depends_on_arrival = false) : depends_on_arrival_(depends_on_arrival) {}

  // Adds a valid message with its arrival by the target's clock. Returns kUsed; or kUnconfirmed,
  // kNotNewer, kFlood or kPastRun, which change no pose.
  [[nodiscard]] Fate add(const Message& message, std::uint64_t arrival_us);

  // Reports the present time by the clock of the source: the end of the newest slice, or
  // source_time() of now. Detects a lost source, which otherwise only its next message would show.
  void pass(std::uint64_t now_us);

  // Reports the present time by the target's clock, for when nothing else tells how much time has
  // passed since the newest message.
  void pass_silence(std::uint64_t target_us);

  // Reports that registered data contradicts itself, so the poses were wrong. The source may be
  // stuck. So poses are rejected until they give another place than now, or until kMaxStuckUs
  // later.
  void contradict();

  // The pose at a time. Between two messages it is interpolated linearly. Up to kLateUs after the
  // newest message it is predicted by the speed and the yaw rate. The cause is kLost, kJump,
  // kRestart, kContradicted or kDrifting if the time is before the first message after that break,
  // and kLost if there was no break. The other causes are kLate and kImprecise.
  [[nodiscard]] Placed pose_at(std::uint64_t time_us) const;

  // Converts a time of the target's clock to the clock of the source, by the least delayed message
  // of the last second. The result is never ahead by more than the shortest delay of a message.
  // Empty if there is no message of the last second.
  [[nodiscard]] std::optional<std::uint64_t> source_time(std::uint64_t target_us) const;

  // Increases with each break. Data registered in an earlier epoch is unknown now.
  [[nodiscard]] std::uint32_t epoch() const { return epoch_; }

  // Whether a message of this run differs from the first one by a jump in place or heading.
  [[nodiscard]] bool has_moved() const { return has_moved_; }

  // How often each break occurred, and when it last did. kLost and kContradicted begin with the
  // last message before the break; kJump, kRestart and kDrifting with the first message after it.
  // The other causes concern slices.
  [[nodiscard]] const Tally& breaks(Cause cause) const {
    return breaks_[static_cast<std::size_t>(cause)];
  }

  // The newest message, even if it is too old to register anything. Empty before the first one.
  [[nodiscard]] std::optional<Message> newest() const {
    return count_ == 0 ? std::nullopt : std::optional(entry(0).message);
  }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, depends_on_arrival_);
  }

 private:
  struct Entry {
    Message message{};
    std::uint64_t offset_us = 0;  // target's clock minus the source's, modulo 2^64
    Residual residual{};          // to the prediction from the previous message
  };

  [[nodiscard]] Fate take_candidate(const Entry& candidate, std::uint64_t arrival_us);
  void begin_course();
  [[nodiscard]] static bool has_leapt(const Entry& before, const Entry& next);
  [[nodiscard]] bool is_silent(std::uint64_t arrival_us) const;
  void append(Entry next);
  void break_off(Cause cause, std::uint64_t since_us);
  [[nodiscard]] bool is_stuck(const Message& next) const;
  [[nodiscard]] bool is_drifting(const Entry& next);
  [[nodiscard]] std::uint64_t least_offset_us(const Entry& newest, std::size_t first_age) const;
  [[nodiscard]] bool is_jump_to(const Entry& next) const;
  [[nodiscard]] Cause cause_before_the_oldest() const;

  // The entry of this age; 0 is the newest. age < count_.
  [[nodiscard]] const Entry& entry(std::size_t age) const {
    return entries_[(next_ + kHistoryMessages - 1 - age) % kHistoryMessages];
  }

  bool depends_on_arrival_;
  std::array<Entry, kHistoryMessages> entries_{};  // a ring; the oldest entry is overwritten
  std::size_t next_ = 0;
  std::size_t count_ = 0;                           // entries of the present sequence
  std::size_t unbroken_ = 0;                        // the newest of them without a break
  Cause began_by_ = Cause::kLost;                   // the break before the unbroken ones
  bool is_whole_ = true;                            // none of the unbroken ones was overwritten
  std::array<Entry, kConfirmations> candidates_{};  // of a sequence that is not accepted yet
  std::size_t candidate_count_ = 0;
  std::uint64_t arrival_us_ = 0;    // of the newest message, by the target's clock
  std::optional<Message> stuck_{};  // message of the contradiction, while poses are rejected
  std::optional<Entry> floor_{};    // the message that set the floor
  std::optional<std::uint64_t>
      drifted_us_{};  // last growth of the offset, while poses are rejected
  Pose first_{};      // first pose of the run
  bool has_moved_ = false;
  RunMemory runs_;
  std::uint32_t epoch_ = 0;
  std::array<Tally, kCauseCount> breaks_{};
};

}  // namespace iog::pose
