#include "authentication/secured_message.hpp"

#include "require/require.hpp"
#include "wire/byte_order.hpp"

namespace iog::authentication {
namespace {

using protection::kSomeIpHeaderBytes;
using protection::kSomeIpLengthOffset;

constexpr std::size_t kSomeIpLengthAt = kSomeIpLengthOffset - 4;
constexpr std::size_t kE2eLengthAt = kSomeIpHeaderBytes;

std::uint32_t some_ip_length(std::span<const std::byte> message) {
  return wire::load_be32(message.subspan<kSomeIpLengthAt, 4>());
}

void set_some_ip_length(std::span<std::byte> message) {
  wire::store_be32(message.subspan<kSomeIpLengthAt, 4>(),
                   static_cast<std::uint32_t>(message.size() - kSomeIpLengthOffset));
}

std::span<const std::byte> trailer_of(std::span<const std::byte> secured) {
  return secured.last(kTrailerBytes);
}

Block cmac_of(const CmacKey& key, std::uint16_t data_id, Freshness freshness,
              std::span<const std::byte> secured) {
  std::array<std::byte, 2> id{};
  wire::store_be16(id, data_id);
  std::array<std::byte, 8> complete{};
  const std::span<std::byte, 8> value(complete);
  wire::store_be32(value.first<4>(), freshness.run);
  wire::store_be32(value.last<4>(), freshness.counter);
  Cmac cmac(key);
  cmac.add(id);
  cmac.add(secured.first(secured.size() - kTrailerBytes).subspan(kSomeIpLengthOffset));
  cmac.add(complete);
  return cmac.finish();
}

}  // namespace

// True if both length fields are right and differ by the trailer.
bool is_signed(std::span<const std::byte> datagram) {
  if (datagram.size() < kLeastSecuredBytes || datagram.size() > kMostSecuredBytes) {
    return false;
  }
  const std::size_t length = datagram.size() - kSomeIpLengthOffset;
  return some_ip_length(datagram) == length &&
         wire::load_be16(datagram.subspan<kE2eLengthAt, 2>()) + kTrailerBytes == length;
}

void sign(const CmacKey& key, std::uint16_t data_id, Freshness freshness,
          std::span<std::byte> secured) {
  require(secured.size() >= kLeastSecuredBytes && secured.size() <= kMostSecuredBytes);
  set_some_ip_length(secured);
  const Block mac = cmac_of(key, data_id, freshness, secured);
  const std::span<std::byte> trailer = secured.last(kTrailerBytes);
  wire::store_be32(trailer.first<kCounterBytes>(), freshness.counter);
  std::copy_n(mac.begin(), kMacBytes, trailer.subspan(kCounterBytes).begin());
}

void strip(std::span<const std::byte> secured, std::span<std::byte> message) {
  require(message.size() >= protection::kProtectionBytes &&
          message.size() + kTrailerBytes == secured.size());
  std::ranges::copy(secured.first(message.size()), message.begin());
  set_some_ip_length(message);
}

std::array<std::uint32_t, 2> mac_of_counters(const CmacKey& key, std::uint16_t data_id,
                                             std::uint32_t run,
                                             std::span<const std::uint32_t> counters) {
  Cmac cmac(key);
  std::array<std::byte, 4> bytes{};
  wire::store_be16(std::span(bytes).first<2>(), data_id);
  cmac.add(std::span(bytes).first<2>());
  wire::store_be32(bytes, run);
  cmac.add(bytes);
  for (const std::uint32_t counter : counters) {
    wire::store_be32(bytes, counter);
    cmac.add(bytes);
  }
  const Block mac = cmac.finish();
  return {wire::load_be32(std::span(mac).subspan<0, 4>()),
          wire::load_be32(std::span(mac).subspan<4, 4>())};
}

Verdict Verifier::verify(std::span<const std::byte> datagram) {
  if (!is_signed(datagram)) {
    return Verdict::kUnsigned;
  }
  const std::span<const std::byte> trailer = trailer_of(datagram);
  const std::uint32_t counter = wire::load_be32(trailer.first<kCounterBytes>());
  if (counter <= this->counter()) {
    return Verdict::kReplayed;
  }
  const Block mac = cmac_of(*key_, data_id_, {.run = run_, .counter = counter}, datagram);
  if (!are_equal(std::span(mac).first<kMacBytes>(), trailer.subspan(kCounterBytes))) {
    return Verdict::kForged;
  }
  counter_ = counter;
  not_counter_ = ~counter;
  return Verdict::kAuthentic;
}

}  // namespace iog::authentication
