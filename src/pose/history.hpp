// The poses of the last second, and the pose of any time among them.
//
// Times are of the clock of the poses' source, us, unless they are said to be the target's.
// Messages come in the order of that clock; one that is not newer than the newest is dropped. Poses
// belong together as long as nothing breaks them apart: a silence of kLostUs, a jump, a new run
// of the source, that the sensors contradict them, or a delay that grows. What was placed before a
// break has lost its place, and its window is unknown.
//
// Who may be forged may not blind for good: what does not continue the present course, being of
// another run or of another time, is believed by kConfirmations messages in a row. If it goes back,
// in time or to a run of before, it has to wait until the present course is silent for kLostUs.
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

// The pose of a time, or the cause why there is none.
struct Placed {
  Cause cause = Cause::kLost;
  // If the cause is kNone. Else the pose is zero, and nothing says how well it is known.
  Pose pose{};
  Sigma sigma{};  // the larger ones of the messages that the pose is made of
  [[nodiscard]] constexpr bool has_pose() const { return cause == Cause::kNone; }
  friend constexpr bool operator==(const Placed&, const Placed&) = default;
};

// How often something has begun, and when it did last.
struct Tally {
  std::uint32_t times = 0;
  std::uint64_t since_us = 0;
};

class History {
 public:
  // depends_on_arrival: the offset of the clocks places packets, so it must not grow faster than
  // clocks drift.
  explicit History(bool depends_on_arrival = false) : depends_on_arrival_(depends_on_arrival) {}

  // A sound message and its arrival by the target's clock. kUsed, or kUnconfirmed, kNotNewer,
  // kFlood or kPastRun, which place nothing.
  [[nodiscard]] Fate add(const Message& message, std::uint64_t arrival_us);

  // Time has passed, by the clock of the source: the end of the newest slice, or source_time() of
  // now. Whether the source is lost shows here, or else when its next message comes.
  void pass(std::uint64_t now_us);

  // So much time has passed by the target's clock, and nothing else says how much it was: since the
  // newest message came.
  void pass_silence(std::uint64_t target_us);

  // What the poses have placed contradicts itself: whatever they say, they were wrong. The source
  // may be stuck, so there are none before it says another place than now, or kMaxStuckUs later.
  void contradict();

  // The pose of a time: between two messages on the straight way; after the newest, at most kLateUs
  // after it, moved by its speed and yaw rate. kLost, kJump, kRestart, kContradicted, kDrifting:
  // the time is before the first message since that break; kLate, kImprecise. Without any break it
  // is kLost.
  [[nodiscard]] Placed pose_at(std::uint64_t time_us) const;

  // The clock of the source at a time of the target's clock: measured, as seen by the message of
  // the last second that was least delayed, so never ahead by more than the shortest way of a
  // message. Empty while there is no message of the last second.
  [[nodiscard]] std::optional<std::uint64_t> source_time(std::uint64_t target_us) const;

  // Rises with each break: whatever was placed under another epoch is unknown now.
  [[nodiscard]] std::uint32_t epoch() const { return epoch_; }

  // Whether a message of this run has given a place or heading that would be a jump from the first
  // one.
  [[nodiscard]] bool has_moved() const { return has_moved_; }

  // Of kLost and kContradicted (since the last message before it), kJump, kRestart and kDrifting
  // (since the first message after it); the others are of slices.
  [[nodiscard]] const Tally& breaks(Cause cause) const {
    return breaks_[static_cast<std::size_t>(cause)];
  }

  // The newest message, also when it is too old to place anything. Empty before the first.
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
    std::uint64_t offset_us = 0;  // target's clock less the source's, modulo 2^64
    Residual residual{};          // to what the message before it predicts
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

  // The entry of this age: 0 is the newest. age < count_.
  [[nodiscard]] const Entry& entry(std::size_t age) const {
    return entries_[(next_ + kHistoryMessages - 1 - age) % kHistoryMessages];
  }

  bool depends_on_arrival_;
  std::array<Entry, kHistoryMessages> entries_{};  // a ring, the oldest is overwritten
  std::size_t next_ = 0;
  std::size_t count_ = 0;                           // entries of the course
  std::size_t unbroken_ = 0;                        // the newest of them, which belong together
  Cause began_by_ = Cause::kLost;                   // what the unbroken ones follow
  bool is_whole_ = true;                            // none of the unbroken ones was overwritten
  std::array<Entry, kConfirmations> candidates_{};  // of a course that is not believed yet
  std::size_t candidate_count_ = 0;
  std::uint64_t arrival_us_ = 0;    // of the newest message, by the target's clock
  std::optional<Message> stuck_{};  // where the source was contradicted, while nothing is believed
  std::optional<Entry> floor_{};    // the message that set the floor
  std::optional<std::uint64_t>
      drifted_us_{};  // when the offset last grew, while nothing is believed
  Pose first_{};      // of the run
  bool has_moved_ = false;
  RunMemory runs_;
  std::uint32_t epoch_ = 0;
  std::array<Tally, kCauseCount> breaks_{};
};

}  // namespace iog::pose
