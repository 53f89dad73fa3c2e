// AES-128 against the examples of NIST, and a chain against OpenSSL.
#include "authentication/aes128.hpp"

#include <gtest/gtest.h>
#include <string_view>

#include "blocks.hpp"

namespace iog::authentication {
namespace {

using testing::block_from;

struct Example {
  std::string_view key;
  std::string_view plain;
  std::string_view cipher;
};

TEST(Aes128, IsThatOfFips197) {
  constexpr std::array kExamples{
      // appendix B
      Example{"2b7e151628aed2a6abf7158809cf4f3c", "3243f6a8885a308d313198a2e0370734",
              "3925841d02dc09fbdc118597196a0b32"},
      // appendix C.1
      Example{"000102030405060708090a0b0c0d0e0f", "00112233445566778899aabbccddeeff",
              "69c4e0d86a7b0430d8cdb78070b4c55a"},
  };
  for (const Example& example : kExamples) {
    EXPECT_EQ(Aes128(block_from(example.key)).encrypt(block_from(example.plain)),
              block_from(example.cipher));
  }
}

// Section F.1.1, ECB-AES128.Encrypt.
TEST(Aes128, IsThatOfSp80038A) {
  constexpr std::array<std::array<std::string_view, 2>, 4> kBlocks{{
      {"6bc1bee22e409f96e93d7e117393172a", "3ad77bb40d7a3660a89ecaf32466ef97"},
      {"ae2d8a571e03ac9c9eb76fac45af8e51", "f5d3d58503b9699de785895a96fdbaaf"},
      {"30c81c46a35ce411e5fbc1191a0a52ef", "43b1cd7f598ece23881b00e3ed030688"},
      {"f69f2445df4f9b17ad2b417be66c3710", "7b0c785e27e8ad3f8223207104725dd4"},
  }};
  const Aes128 cipher(testing::example_key());
  for (const auto& [plain, expected] : kBlocks) {
    EXPECT_EQ(cipher.encrypt(block_from(plain)), block_from(expected));
  }
}

// Each result is the next block, and changes the next key, as in NIST's Monte Carlo test. The last
// one is OpenSSL 3.0's, by python3-cryptography.
TEST(Aes128, AThousandKeysAreAsOpenSslHasThem) {
  Key key{};
  Block block{};
  for (int i = 0; i < 1'000; ++i) {
    block = Aes128(key).encrypt(block);
    for (std::size_t at = 0; at < kBlockBytes; ++at) {
      key.at(at) ^= block.at(at);
    }
  }
  EXPECT_EQ(block, block_from("c03b462451b8ec9fa674a2d1e9c0555e"));
}

}  // namespace
}  // namespace iog::authentication
