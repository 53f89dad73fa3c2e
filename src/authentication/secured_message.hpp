// A message whose sender is proved, as AUTOSAR has it (PRS_SecOcProtocol: Secured I-PDU): behind
// the message, and counted by the length of SOME/IP but not by that of E2E,
//
//    n - 12  u32 counter: the freshness value, truncated to its low half
//    n -  8  8 bytes of MAC: the first 64 bits of a CMAC with AES-128
//
// The MAC is of the data id, u16; of the message from its byte 8 on, without these 12 bytes; and of
// the complete freshness value, which is the number of the target's run, u32, and the counter. As
// with E2E, what is before byte 8 is not covered: the data id and the length stand for it.
//
// The target's run is never sent here: the signer has to know it. So no message of another run is
// believed, also not after a reset, and neither end has to remember anything. Within a run the
// counter of each kind of message rises.
//
// Why 64 bits: NIST SP 800-38B, appendix A.2, asks for as many where no limit on guesses is
// enforced. The 24 and 28 bits of the profiles 1 and 3 of SecOC are for the 8 bytes of a CAN frame:
// on a link that carries 70,000 poses a second 2^23 guesses take two minutes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "authentication/cmac.hpp"
#include "health/constants.hpp"
#include "protection/protected_message.hpp"

namespace iog::authentication {

inline constexpr std::size_t kCounterBytes = 4;
inline constexpr std::size_t kMacBytes = 8;
inline constexpr std::size_t kTrailerBytes = kCounterBytes + kMacBytes;
inline constexpr std::size_t kLeastSecuredBytes = protection::kProtectionBytes + kTrailerBytes;
inline constexpr std::size_t kMostSecuredBytes = protection::kMaxMessageBytes + kTrailerBytes;

struct Freshness {
  std::uint32_t run = 0;      // of the target
  std::uint32_t counter = 0;  // 1 for the first message of its kind; it does not wrap
};

// Signs a protected message (protection/protected_message.hpp) that has kTrailerBytes of room
// behind it: kLeastSecuredBytes <= secured.size() <= kMostSecuredBytes.
void sign(const CmacKey& key, std::uint16_t data_id, Freshness freshness,
          std::span<std::byte> secured);

// Whether it is as long as a signed message says it is. Whose it is, a Verifier knows.
[[nodiscard]] bool is_signed(std::span<const std::byte> datagram);

// The message as it was before it was signed. message.size() + kTrailerBytes == secured.size().
void strip(std::span<const std::byte> secured, std::span<std::byte> message);

// What becomes of a message. All but the first are drops: nothing changes but the counts.
enum class Verdict : std::uint8_t {
  kAuthentic,
  kUnsigned,  // no message with a MAC: too short, too long, or its lengths are those of another one
  kReplayed,  // its counter is not above that of the last authentic message
  kForged,    // its MAC is wrong: of another key, run or kind, or something of it was changed
};
inline constexpr std::size_t kVerdictCount = 4;

// What a target says of the messages that it has taken, so that the signer knows what comes next
// and that the target says so: the first 64 bits of the CMAC of the data id, the run, and these
// counters, big endian.
[[nodiscard]] std::array<std::uint32_t, 2> mac_of_counters(const CmacKey& key,
                                                           std::uint16_t data_id, std::uint32_t run,
                                                           std::span<const std::uint32_t> counters);

// Messages of one kind that come to a target.
class Verifier {
 public:
  // run: that of the target. The key outlives it.
  Verifier(const CmacKey& key, std::uint16_t data_id, std::uint32_t run)
      : key_(&key), data_id_(data_id), run_(run) {}

  // Any datagram may come. One without a hope is dropped before the MAC is computed.
  [[nodiscard]] Verdict verify(std::span<const std::byte> datagram);

  // The counter of the last authentic message; 0: there was none.
  [[nodiscard]] std::uint32_t counter() const { return std::max(counter_, ~not_counter_); }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, key_, data_id_, run_);
  }

 private:
  const CmacKey* key_;
  std::uint16_t data_id_;
  std::uint32_t run_;
  // Stored twice: a flipped bit admits no old message, it only rejects some new ones.
  std::uint32_t counter_ = 0;
  std::uint32_t not_counter_ = ~std::uint32_t{0};
};

}  // namespace iog::authentication
