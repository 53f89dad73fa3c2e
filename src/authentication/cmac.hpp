// The message authentication code CMAC with AES-128 (NIST SP 800-38B, 2005; RFC 4493).
#pragma once

#include <cstddef>
#include <span>

#include "authentication/aes128.hpp"
#include "authentication/key.hpp"

namespace iog::authentication {

// A key, ready for use: its rounds, and both subkeys.
class CmacKey {
 public:
  explicit CmacKey(const Key& key);

 private:
  friend class Cmac;

  Aes128 cipher_;
  Block k1_;  // for a message that ends with a whole block
  Block k2_;  // for any other
};

// One message, piece by piece.
class Cmac {
 public:
  // The key outlives it.
  explicit Cmac(const CmacKey& key) : key_(&key) {}

  void add(std::span<const std::byte> bytes);

  // All 128 bits, once: nothing can be added after it.
  [[nodiscard]] Block finish();

 private:
  void absorb(const Block& last);

  const CmacKey* key_;
  Block chain_{};
  Block waiting_{};  // what may be the last block
  std::size_t waiting_bytes_ = 0;
};

// Whether both are the same, in a time that does not tell where they differ.
[[nodiscard]] bool are_equal(std::span<const std::byte> a, std::span<const std::byte> b);

}  // namespace iog::authentication
