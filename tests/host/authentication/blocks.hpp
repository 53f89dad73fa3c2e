// Blocks and keys as NIST prints them.
#pragma once

#include <algorithm>
#include <string_view>

#include "authentication/key.hpp"
#include "fakes/from_hex.hpp"

namespace iog::authentication::testing {

using tests::from_hex;

inline Block block_from(std::string_view hex) {
  Block block{};
  std::ranges::copy(from_hex(hex), block.begin());
  return block;
}

// The key of the examples in FIPS 197 (appendix B), SP 800-38A, SP 800-38B and RFC 4493.
inline Key example_key() { return block_from("2b7e1516 28aed2a6 abf71588 09cf4f3c"); }

}  // namespace iog::authentication::testing
