// SHA-256 against the examples of NIST and, for all short lengths, Python's hashlib.
#include "authentication/sha256.hpp"

#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

#include "blocks.hpp"

namespace iog::authentication {
namespace {

using testing::from_hex;

std::vector<std::byte> hash_of(std::span<const std::byte> message) {
  const auto hash = sha256(message);
  return {hash.begin(), hash.end()};
}

std::vector<std::byte> hash_of(std::string_view text) {
  return hash_of(std::as_bytes(std::span(text)));
}

// FIPS 180-2, appendix B, and the empty message of NIST's short message vectors (SHAVS).
TEST(Sha256, IsThatOfNistsExamples) {
  EXPECT_EQ(hash_of(""),
            from_hex("e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"));
  EXPECT_EQ(hash_of("abc"),
            from_hex("ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"));
  EXPECT_EQ(hash_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            from_hex("248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"));
  EXPECT_EQ(hash_of(std::string(1'000'000, 'a')),
            from_hex("cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"));
}

// The hash of n bytes begins the message of n + 1; the last one is hashlib's.
TEST(Sha256, EachLengthIsAsHashlibHasIt) {
  std::vector<std::byte> chain;
  for (unsigned bytes = 0; bytes <= 200; ++bytes) {
    std::vector<std::byte> message = chain;
    for (unsigned i = 0; i < bytes; ++i) {
      message.push_back(static_cast<std::byte>(i));
    }
    chain = hash_of(message);
  }
  EXPECT_EQ(chain, from_hex("9d966d58fce175d1da74200b8f2b9498b0a7fabc7cd39bb65f82fae11fd8812c"));
}

}  // namespace
}  // namespace iog::authentication
