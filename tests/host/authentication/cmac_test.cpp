// CMAC against the examples of NIST SP 800-38B and RFC 4493, and all short lengths against OpenSSL.
#include "authentication/cmac.hpp"

#include <gtest/gtest.h>
#include <string_view>

#include "blocks.hpp"

namespace iog::authentication {
namespace {

using testing::block_from;
using testing::from_hex;

constexpr std::string_view kExampleMessage =
    "6bc1bee22e409f96e93d7e117393172a ae2d8a571e03ac9c9eb76fac45af8e51"
    "30c81c46a35ce411e5fbc1191a0a52ef f69f2445df4f9b17ad2b417be66c3710";

Block cmac_of(std::span<const std::byte> message) {
  const CmacKey key(testing::example_key());
  Cmac cmac(key);
  cmac.add(message);
  return cmac.finish();
}

// RFC 4493, section 4, has those of 0, 16, 40 and 64 bytes; SP 800-38B (as updated in 2016), D.1,
// those of 0, 16, 20 and 64.
TEST(Cmac, IsThatOfSp80038BAndRfc4493) {
  const std::vector<std::byte> message = from_hex(kExampleMessage);
  const auto of_first = [&](std::size_t bytes) { return cmac_of(std::span(message).first(bytes)); };
  EXPECT_EQ(of_first(0), block_from("bb1d6929e95937287fa37d129b756746"));
  EXPECT_EQ(of_first(16), block_from("070a16b46b4d4144f79bdd9dd04a287c"));
  EXPECT_EQ(of_first(20), block_from("7d85449ea6ea19c823a7bf78837dfade"));
  EXPECT_EQ(of_first(40), block_from("dfa66747de9ae63030ca32611497c827"));
  EXPECT_EQ(of_first(64), block_from("51f0bebf7e3b9d92fc49741779363cfe"));
}

// The MAC of n bytes begins the message of n + 1; the last one is OpenSSL 3.0's (openssl mac).
TEST(Cmac, EachLengthIsAsOpenSslHasIt) {
  Block chain{};
  for (unsigned bytes = 0; bytes <= 64; ++bytes) {
    std::vector<std::byte> message(chain.begin(), chain.end());
    for (unsigned i = 0; i < bytes; ++i) {
      message.push_back(static_cast<std::byte>(i));
    }
    chain = cmac_of(message);
  }
  EXPECT_EQ(chain, block_from("4c12b9f81744cef6835dd55dc7ab655c"));
}

TEST(Cmac, PiecesAreOneMessage) {
  const std::vector<std::byte> message = from_hex(kExampleMessage);
  const Block whole = cmac_of(message);
  const CmacKey key(testing::example_key());
  for (std::size_t first = 0; first <= message.size(); ++first) {
    for (std::size_t second = first; second <= message.size(); second += 5) {
      Cmac cmac(key);
      cmac.add(std::span(message).first(first));
      cmac.add(std::span(message).subspan(first, second - first));
      cmac.add(std::span(message).subspan(second));
      EXPECT_EQ(cmac.finish(), whole) << first << " " << second;
    }
  }
}

TEST(Cmac, BytesAreEqualIfAllAre) {
  const Block one = testing::example_key();
  EXPECT_TRUE(are_equal(one, one));
  EXPECT_FALSE(are_equal(one, std::span(one).first<15>()));
  for (std::size_t at = 0; at < kBlockBytes; ++at) {
    Block other = one;
    other.at(at) ^= std::byte{0x80};
    EXPECT_FALSE(are_equal(one, other)) << at;
  }
}

}  // namespace
}  // namespace iog::authentication
