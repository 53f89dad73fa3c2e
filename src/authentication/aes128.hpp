// Implements AES-128 encryption (FIPS 197). Decryption is not implemented. No table lookup, branch
// or address depends on the key or the data.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "authentication/key.hpp"
#include "authentication/planes.hpp"

namespace iog::authentication {

class Aes128 {
 public:
  explicit Aes128(const Key& key);

  [[nodiscard]] Block encrypt(std::span<const std::byte, kBlockBytes> block) const;

 private:
  static constexpr std::size_t kRounds = 10;

  std::array<Planes, kRounds + 1> round_keys_;
};

}  // namespace iog::authentication
