#include "authentication/stream_signer.hpp"

#include "authentication/sha256.hpp"
#include "require/require.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::authentication {

MessageName name_of(std::span<const std::byte> message) {
  const std::array<std::byte, kSha256Bytes> hash = sha256(message);
  MessageName name;
  std::copy_n(hash.begin(), name.size(), name.begin());
  return name;
}

void StreamSigner::add(std::span<const std::byte> message) {
  require(!is_full());
  names_[count_++] = name_of(message);
}

std::span<const std::byte> StreamSigner::sign() {
  require(count_ > 0);
  const std::size_t bytes =
      protection::kProtectionBytes + kNamesHeaderBytes + count_ * sizeof(MessageName);
  const std::span<std::byte> plain = std::span(message_).first(bytes);
  wire::ByteWriter out(plain.subspan(protection::kProtectionBytes));
  out.u16_be(kNamesHeaderBytes);
  out.u16_be(sizeof(MessageName));
  out.u32_be(run_);
  out.u16_be(static_cast<std::uint16_t>(count_));
  out.u16_be(0);
  for (const MessageName& name : std::span(names_).first(count_)) {
    out.bytes(name);
  }
  sender_.protect(plain);
  const std::span<std::byte> secured = std::span(message_).first(bytes + kTrailerBytes);
  authentication::sign(*key_, data_id_, {.run = run_, .counter = ++signatures_}, secured);
  count_ = 0;
  return secured;
}

std::optional<Names> read_names(std::span<const std::byte> secured) {
  if (secured.size() < kLeastSecuredBytes) {
    return std::nullopt;
  }
  const std::span<const std::byte> content =
      secured.first(secured.size() - kTrailerBytes).subspan(protection::kProtectionBytes);
  wire::ByteReader in(content);
  const std::size_t header_bytes = in.u16_be();
  const std::size_t name_bytes = in.u16_be();
  const std::uint32_t run = in.u32_be();
  const std::size_t count = in.u16_be();
  if (!in.ok() || header_bytes < kNamesHeaderBytes || name_bytes != sizeof(MessageName) ||
      content.size() != header_bytes + count * name_bytes) {
    return std::nullopt;
  }
  return Names{.run = run, .bytes = content.subspan(header_bytes)};
}

}  // namespace iog::authentication
