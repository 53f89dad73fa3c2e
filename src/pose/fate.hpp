// The outcomes of datagrams on the pose port, and of slices that need a pose. The values are
// defined in docs/spec.md, sections 5.2 and 5.5.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::pose {

// The outcome of a datagram. All outcomes except the first two are drops, which have no effect.
enum class Fate : std::uint8_t {
  kUsed,          // it is the newest pose
  kUnconfirmed,   // it waits for confirmation, because its run has not been accepted yet
  kStranger,      // it does not come from the configured sender
  kTooShort,      // shorter than a message
  kNotOurs,       // wrong SOME/IP service, event or message type
  kWrongVersion,  // of the interface or of the content
  kDamaged,       // wrong CRC, data id, or length covered by the CRC
  kWrongLength,   // the content does not have its stated length
  kWrongFlags,    // an undefined flag is set
  kNotZero,       // a field that must be zero is not
  kOutOfRange,    // impossible position, speed or yaw rate
  kNoSigma,       // a standard deviation is zero, which no source can reach
  kTooOld,        // it was older than kMaxAgeUs when it was sent
  kNotNewer,      // not newer than the newest message of its run
  kFlood,         // less than kMinSpacingUs newer than the newest message of its run
  kPastRun,       // its run has been replaced by a newer run
};
inline constexpr std::size_t kFateCount = 16;

// The reason why a slice has no pose, or why the window was reset to unknown.
enum class Cause : std::uint8_t {
  kNone,
  kLate,          // no message within kLateUs of the slice: the slice is not registered
  kImprecise,     // a standard deviation above kMaxSigma...: the slice is not registered
  kLost,          // no message for kLostUs: the window is unknown
  kJump,          // too far from the prediction: the window is unknown
  kRestart,       // a new run of the sender: the window is unknown
  kContradicted,  // beams pass through standing objects on all sides: the window is unknown
  kDrifting,      // growing delay, with packets timed by arrival: the window is unknown
};
inline constexpr std::size_t kCauseCount = 8;

}  // namespace iog::pose
