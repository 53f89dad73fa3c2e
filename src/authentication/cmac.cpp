#include "authentication/cmac.hpp"

#include <algorithm>

namespace iog::authentication {
namespace {

constexpr void add_to(Block& block, const Block& other) {
  for (std::size_t i = 0; i < kBlockBytes; ++i) {
    block[i] ^= other[i];
  }
}

// SP 800-38B, section 6.1: multiplies by x in GF(2^128). The first byte's top bit is the highest
// power.
constexpr Block doubled(const Block& block) {
  Block twice{};
  unsigned carry = 0;
  for (std::size_t i = kBlockBytes; i-- > 0;) {
    const unsigned byte = std::to_integer<unsigned>(block[i]);
    twice[i] = static_cast<std::byte>(byte << 1 | carry);
    carry = byte >> 7;
  }
  twice[kBlockBytes - 1] ^= static_cast<std::byte>(carry * 0x87);
  return twice;
}

}  // namespace

CmacKey::CmacKey(const Key& key)
    : cipher_(key), k1_(doubled(cipher_.encrypt(Block{}))), k2_(doubled(k1_)) {}

void Cmac::absorb(const Block& last) {
  add_to(chain_, last);
  chain_ = key_->cipher_.encrypt(chain_);
}

// A full block is kept until more data comes, because the last block is masked.
void Cmac::add(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    if (waiting_bytes_ == kBlockBytes) {
      absorb(waiting_);
      waiting_bytes_ = 0;
    }
    const std::size_t count = std::min(bytes.size(), kBlockBytes - waiting_bytes_);
    std::copy_n(bytes.begin(), count,
                waiting_.begin() + static_cast<std::ptrdiff_t>(waiting_bytes_));
    waiting_bytes_ += count;
    bytes = bytes.subspan(count);
  }
}

Block Cmac::finish() {
  if (waiting_bytes_ == kBlockBytes) {
    add_to(waiting_, key_->k1_);
  } else {
    waiting_[waiting_bytes_] = std::byte{0x80};
    std::fill(waiting_.begin() + static_cast<std::ptrdiff_t>(waiting_bytes_) + 1, waiting_.end(),
              std::byte{0});
    add_to(waiting_, key_->k2_);
  }
  absorb(waiting_);
  return chain_;
}

bool are_equal(std::span<const std::byte> a, std::span<const std::byte> b) {
  std::byte differ{0};
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    differ |= a[i] ^ b[i];
  }
  return a.size() == b.size() && differ == std::byte{0};
}

}  // namespace iog::authentication
