// A message with a MAC, which AUTOSAR calls a Secured I-PDU (PRS_SecOcProtocol). A trailer follows
// the message. The SOME/IP length includes the trailer, but the E2E length does not.
//
//    n - 12  u32 counter: the freshness value, truncated to its low half
//    n -  8  8 bytes of MAC: the first 64 bits of a CMAC with AES-128
//
// The MAC covers the u16 data ID, the message from byte 8 (without the trailer), and the complete
// freshness value. The freshness value consists of the u32 run number of the target and the
// counter. As in E2E, the MAC does not cover bytes 0 to 7, because the data ID and the E2E length
// protect them indirectly.
//
// Commands do not contain the target's run number, so the signer must know it. A message from
// another run is therefore never accepted, even after a reset, and neither side stores anything
// between runs. Within a run, the counter of each kind of message increases.
//
// The MAC has 64 bits because NIST SP 800-38B, appendix A.2, requires this length if the number of
// guesses is not limited. SecOC's profiles 1 and 3 have only 24 and 28 bits because they are
// designed for the 8 bytes of a CAN frame. On a link that carries 70,000 poses per second, 2^23
// guesses take only two minutes.
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
  std::uint32_t run = 0;      // run number of the target
  std::uint32_t counter = 0;  // 1 for the first message of its kind; does not wrap
};

// Signs a protected message (protection/protected_message.hpp). `secured` contains the message
// followed by kTrailerBytes of free space. Requires kLeastSecuredBytes <= secured.size() <=
// kMostSecuredBytes.
void sign(const CmacKey& key, std::uint16_t data_id, Freshness freshness,
          std::span<std::byte> secured);

// Returns true if the datagram's length fields indicate a signed message. The MAC is checked only
// by a Verifier.
[[nodiscard]] bool is_signed(std::span<const std::byte> datagram);

// Restores the unsigned message. Requires message.size() + kTrailerBytes == secured.size().
void strip(std::span<const std::byte> secured, std::span<std::byte> message);

// The result of verifying a message. If the result is not kAuthentic, the message is dropped and
// only counters change.
enum class Verdict : std::uint8_t {
  kAuthentic,
  kUnsigned,  // not a signed message: too short, too long, or wrong length fields
  kReplayed,  // its counter is not above the counter of the last authentic message
  kForged,    // wrong MAC: different key, run or kind of message, or a changed message
};
inline constexpr std::size_t kVerdictCount = 4;

// Signs the counters of the received messages. The sender of the messages uses these counters to
// determine the counter of its next message. The result is the first 64 bits of the CMAC over the
// data ID, the run number and these counters, in big-endian order.
[[nodiscard]] std::array<std::uint32_t, 2> mac_of_counters(const CmacKey& key,
                                                           std::uint16_t data_id, std::uint32_t run,
                                                           std::span<const std::uint32_t> counters);

// Verifies the received messages of one kind.
class Verifier {
 public:
  // `run` is the target's run number. The key must outlive this object.
  Verifier(const CmacKey& key, std::uint16_t data_id, std::uint32_t run)
      : key_(&key), data_id_(data_id), run_(run) {}

  // Verifies a datagram, which may contain any bytes. Unsigned and replayed messages are dropped
  // before the MAC is computed.
  [[nodiscard]] Verdict verify(std::span<const std::byte> datagram);

  // Returns the counter of the last authentic message, or 0 if there was none.
  [[nodiscard]] std::uint32_t counter() const { return std::max(counter_, ~not_counter_); }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, key_, data_id_, run_);
  }

 private:
  const CmacKey* key_;
  std::uint16_t data_id_;
  std::uint32_t run_;
  // The counter is stored twice so that a flipped bit can never cause an old message to be
  // accepted. A flipped bit can only cause new messages to be rejected.
  std::uint32_t counter_ = 0;
  std::uint32_t not_counter_ = ~std::uint32_t{0};
};

}  // namespace iog::authentication
