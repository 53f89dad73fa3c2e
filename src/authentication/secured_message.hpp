// A message with a MAC: AUTOSAR's Secured I-PDU (PRS_SecOcProtocol). A trailer follows the message.
// The SOME/IP length counts it, the E2E length does not.
//
//    n - 12  u32 counter: the freshness value, truncated to its low half
//    n -  8  8 bytes of MAC: the first 64 bits of a CMAC with AES-128
//
// The MAC covers the data id, u16; the message from byte 8 without the trailer; and the complete
// freshness value, which is the number of the target's run, u32, and the counter. As with E2E,
// bytes 0 to 7 are not covered: the data id and the E2E length stand for them.
//
// Commands do not contain the target's run: the signer has to know it. A message of another run is
// therefore never accepted, even after a reset, and neither end stores anything between runs.
// Within a run the counter of each kind of message increases.
//
// The MAC has 64 bits because NIST SP 800-38B, appendix A.2, requires them if guesses are not
// limited. The 24 and 28 bits of SecOC's profiles 1 and 3 are made for the 8 bytes of a CAN frame.
// On a link that carries 70,000 poses a second, 2^23 guesses take two minutes.
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
  std::uint32_t run = 0;      // number of the target's run
  std::uint32_t counter = 0;  // 1 for the first message of its kind; does not wrap
};

// Signs a protected message (protection/protected_message.hpp). `secured` is the message with
// kTrailerBytes of room after it: kLeastSecuredBytes <= secured.size() <= kMostSecuredBytes.
void sign(const CmacKey& key, std::uint16_t data_id, Freshness freshness,
          std::span<std::byte> secured);

// True if its length fields are those of a signed message. Only a Verifier checks the MAC.
[[nodiscard]] bool is_signed(std::span<const std::byte> datagram);

// Restores the message before signing. message.size() + kTrailerBytes == secured.size().
void strip(std::span<const std::byte> secured, std::span<std::byte> message);

// The result of verifying a message. All but kAuthentic are drops and change only counters.
enum class Verdict : std::uint8_t {
  kAuthentic,
  kUnsigned,  // not a signed message: too short, too long, or wrong length fields
  kReplayed,  // its counter is not above that of the last authentic message
  kForged,    // wrong MAC: another key, run or kind, or a changed message
};
inline constexpr std::size_t kVerdictCount = 4;

// Signs the counters of received messages, from which the signer learns the next counter: the first
// 64 bits of the CMAC over the data id, the run and these counters, big endian.
[[nodiscard]] std::array<std::uint32_t, 2> mac_of_counters(const CmacKey& key,
                                                           std::uint16_t data_id, std::uint32_t run,
                                                           std::span<const std::uint32_t> counters);

// Verifies the messages of one kind that a target receives.
class Verifier {
 public:
  // run: that of the target. The key must outlive this object.
  Verifier(const CmacKey& key, std::uint16_t data_id, std::uint32_t run)
      : key_(&key), data_id_(data_id), run_(run) {}

  // Accepts any datagram. Unsigned and replayed ones are dropped before the MAC is computed.
  [[nodiscard]] Verdict verify(std::span<const std::byte> datagram);

  // The counter of the last authentic message, or 0 if there was none.
  [[nodiscard]] std::uint32_t counter() const { return std::max(counter_, ~not_counter_); }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, key_, data_id_, run_);
  }

 private:
  const CmacKey* key_;
  std::uint16_t data_id_;
  std::uint32_t run_;
  // Stored twice, so that a flipped bit can never admit an old message. It may only reject new
  // ones.
  std::uint32_t counter_ = 0;
  std::uint32_t not_counter_ = ~std::uint32_t{0};
};

}  // namespace iog::authentication
