// CMAC, the message authentication code with AES-128 (NIST SP 800-38B, 2005; RFC 4493).
#pragma once

#include <cstddef>
#include <span>

#include "authentication/aes128.hpp"
#include "authentication/key.hpp"

namespace iog::authentication {

// An expanded key, which consists of the round keys and both subkeys.
class CmacKey {
 public:
  explicit CmacKey(const Key& key);

 private:
  friend class Cmac;

  Aes128 cipher_;
  Block k1_;  // used if the message ends with a whole block
  Block k2_;  // used for any other message
};

// Computes the MAC of a message that can be added in several parts.
class Cmac {
 public:
  // The key must outlive this object.
  explicit Cmac(const CmacKey& key) : key_(&key) {}

  void add(std::span<const std::byte> bytes);

  // Returns the complete 128-bit MAC. Call finish() once, after the last add().
  [[nodiscard]] Block finish();

 private:
  void absorb(const Block& last);

  const CmacKey* key_;
  Block chain_{};
  Block waiting_{};  // buffered bytes, because they may be the last block
  std::size_t waiting_bytes_ = 0;
};

// Returns true if `a` and `b` are equal. The run time does not depend on which bytes differ.
[[nodiscard]] bool are_equal(std::span<const std::byte> a, std::span<const std::byte> b);

}  // namespace iog::authentication
