// What becomes of a datagram on the poses' port, and of a slice that asks for a pose. The values
// are those of docs/spec.md, sections 5.2 and 5.5.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::pose {

// Each datagram has one of these fates. All but the first two are drops: they change nothing.
enum class Fate : std::uint8_t {
  kUsed,          // it is the newest pose
  kUnconfirmed,   // of a run that is not believed yet; it waits for the next ones
  kStranger,      // not from the sender that the description names
  kTooShort,      // shorter than a message
  kNotOurs,       // another SOME/IP, service, event or message type
  kWrongVersion,  // of the interface, or of the content
  kDamaged,       // wrong CRC, data id or length of what the CRC covers
  kWrongLength,   // the content is not as long as it says
  kWrongFlags,    // a flag that does not exist
  kNotZero,       // something that has to be zero is not
  kOutOfRange,    // position, speed or yaw rate cannot be
  kNoSigma,       // a standard deviation of zero: no source is so precise
  kTooOld,        // older than kMaxAgeUs when it was sent
  kNotNewer,      // not newer than the newest of its run
  kFlood,         // less than kMinSpacingUs newer
  kPastRun,       // of a run that another one has followed
};
inline constexpr std::size_t kFateCount = 16;

// Why a slice has no pose, or why what was placed before has lost its place.
enum class Cause : std::uint8_t {
  kNone,
  kLate,          // no message within kLateUs of the slice: the slice is not placed
  kImprecise,     // a standard deviation above kMaxSigma...: the slice is not placed
  kLost,          // no message for kLostUs: the window is unknown
  kJump,          // off the prediction: the window is unknown
  kRestart,       // a new run of the sender: the window is unknown
  kContradicted,  // beams go through what stood, all around: the window is unknown
  kDrifting,      // poses come later and later, and packets are placed by arrival: unknown
};
inline constexpr std::size_t kCauseCount = 8;

}  // namespace iog::pose
