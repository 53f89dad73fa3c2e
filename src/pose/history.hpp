// Stores the poses of the last second and interpolates the pose at any time within this second.
//
// Times are in us on the clock of the pose source unless the target's clock is mentioned. Messages
// must arrive in the order of the source's clock. Messages that are not newer than the newest one
// so far are dropped. A sequence of poses ends with a break, which can be a gap of kLostUs without
// messages, a jump, a new run of the source, a contradiction by the sensors, or a growing delay.
// After a break, the position of previously registered data is no longer known, so the window is
// reset to unknown.
//
// A forged message must not disable the pose input permanently. Messages whose run or time does not
// continue the current sequence are therefore accepted only once kConfirmations of them have
// arrived in a row. If they are not newer than the newest accepted message, or if they belong to an
// earlier run, the current sequence must also have been silent for kLostUs.
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
  // The pose and its standard deviations are valid if the cause is kNone. Otherwise, the pose is
  // zero and its standard deviations are unknown.
  Pose pose{};
  Sigma sigma{};  // the larger values of the two messages between which the pose is interpolated
  [[nodiscard]] constexpr bool has_pose() const { return cause == Cause::kNone; }
  friend constexpr bool operator==(const Placed&, const Placed&) = default;
};

// How often a cause began, and when it last began.
struct Tally {
  std::uint32_t times = 0;
  std::uint64_t since_us = 0;
};

class History {
 public:
  // `depends_on_arrival` is true if packet times are derived from the clock offset. In this case,
  // the offset must not grow faster than clocks drift.
  explicit History(bool depends_on_arrival = false) : depends_on_arrival_(depends_on_arrival) {}

  // Adds a valid message and its arrival time on the target's clock. Returns kUsed if the message
  // becomes the newest pose. Otherwise, returns kUnconfirmed, kNotNewer, kFlood or kPastRun without
  // changing any pose.
  [[nodiscard]] Fate add(const Message& message, std::uint64_t arrival_us);

  // Reports the current time on the clock of the source. The caller passes the end of the newest
  // slice, or the current time as converted by source_time(). This detects the loss of the source,
  // which would otherwise be noticed only when its next message arrives.
  void pass(std::uint64_t now_us);

  // Reports the current time on the target's clock. Call pass_silence() if the time since the
  // newest message cannot be determined from other data.
  void pass_silence(std::uint64_t target_us);

  // Reports that the registered data contradict each other. The poses were therefore wrong, and the
  // source may be stuck. Poses are then rejected for kMaxStuckUs, or until one differs from the
  // newest pose by more than the jump limits.
  void contradict();

  // Returns the pose at a time. Between two messages, the pose is interpolated linearly. After the
  // newest message, the pose is predicted from the speed and the yaw rate for up to kLateUs. If no
  // message since the last break is old enough, the result states the cause of the break: kLost,
  // kJump, kRestart, kContradicted or kDrifting. If no break has occurred yet, the cause is kLost.
  // Other possible causes are kLate and kImprecise.
  [[nodiscard]] Placed pose_at(std::uint64_t time_us) const;

  // Converts a time from the target's clock to the source's clock, based on the shortest message
  // delay in the last second. The result lags behind the source's clock by this delay. Returns
  // nothing if no pose has been accepted since the last break.
  [[nodiscard]] std::optional<std::uint64_t> source_time(std::uint64_t target_us) const;

  // Returns the number of breaks so far. The position of data registered in an earlier epoch is no
  // longer known.
  [[nodiscard]] std::uint32_t epoch() const { return epoch_; }

  // Returns true if any message of this run differs from the first one by more than the jump
  // limits.
  [[nodiscard]] bool has_moved() const { return has_moved_; }

  // Returns how often each break occurred, and when it last occurred. For `kLost` and
  // `kContradicted`, this is the time of the last message before the break. For `kJump`, `kRestart`
  // and `kDrifting`, it is the time of the first message after the break. All other causes apply to
  // slices, not to breaks.
  [[nodiscard]] const Tally& breaks(Cause cause) const {
    return breaks_[static_cast<std::size_t>(cause)];
  }

  // Returns the newest message, even if it is too old for registering data. Returns nothing before
  // the first message.
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
    std::uint64_t offset_us = 0;  // target's clock minus the source's clock, modulo 2^64
    Residual residual{};          // difference to the prediction from the previous message
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

  // Returns the entry with the given age. The newest entry has an age of 0. `age` must be below
  // count_.
  [[nodiscard]] const Entry& entry(std::size_t age) const {
    return entries_[(next_ + kHistoryMessages - 1 - age) % kHistoryMessages];
  }

  bool depends_on_arrival_;
  std::array<Entry, kHistoryMessages> entries_{};  // a ring buffer; the oldest entry is overwritten
  std::size_t next_ = 0;
  std::size_t count_ = 0;                           // entries of the current sequence
  std::size_t unbroken_ = 0;                        // the newest entries without a break between
                                                    // them
  Cause began_by_ = Cause::kLost;                   // the break before the unbroken entries
  bool is_whole_ = true;                            // none of the unbroken entries was overwritten
  std::array<Entry, kConfirmations> candidates_{};  // of a sequence that has not been accepted yet
  std::size_t candidate_count_ = 0;
  std::uint64_t arrival_us_ = 0;    // of the newest message, on the target's clock
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
