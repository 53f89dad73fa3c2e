// The verifier of signed messages (authentication/secured_message.hpp) on a series of steps: bytes
// of any kind, messages that are signed with its key, and the same with something changed. Laws:
// what is authentic was signed with its key and is newer than all before it; nothing else moves its
// counter; and what is stripped is what was signed.
#include "authentication/secured_message.hpp"

#include <algorithm>
#include <vector>

#include "law.hpp"
#include "wire/byte_order.hpp"

namespace iog::fuzz {
namespace {

using authentication::Verdict;

constexpr std::uint16_t kKind = 0x8003;
constexpr std::uint32_t kRun = 77;
constexpr std::size_t kMostBytes = 2'000;

class Drive {
 public:
  explicit Drive(wire::ByteReader in) : in_(in) {}

  void run() {
    while (in_.remaining() > 0) {
      const std::uint8_t what = in_.u8();
      what % 4 == 0 ? take_anything() : take_signed(what);
    }
  }

 private:
  void take_anything() {
    const auto piece = next_piece(in_);
    const std::uint32_t before = verifier_.counter();
    const Verdict verdict = verifier_.verify(piece.first(std::min(piece.size(), kMostBytes)));
    law(verdict != Verdict::kAuthentic, "nobody guesses 64 bits");
    law(verifier_.counter() == before, "what is dropped changes nothing");
  }

  // Of a message whose lengths are right, as whoever signs has it.
  void take_signed(std::uint8_t what) {
    const auto content = next_piece(in_);
    std::vector<std::byte> plain(protection::kProtectionBytes);
    plain.insert(plain.end(), content.begin(), content.end());
    plain.resize(std::min(plain.size(), protection::kMaxMessageBytes));
    const std::span<std::byte> bytes(plain);
    wire::store_be32(bytes.subspan<4, 4>(), static_cast<std::uint32_t>(plain.size() - 8));
    wire::store_be16(bytes.subspan<16, 2>(), static_cast<std::uint16_t>(plain.size() - 8));
    std::vector<std::byte> secured = plain;
    secured.resize(plain.size() + authentication::kTrailerBytes);
    const std::uint32_t counter = in_.u16_be();
    authentication::sign(key_, kKind, {.run = kRun, .counter = counter}, secured);
    if (what % 4 == 1) {
      change(secured);
      return;
    }
    const bool is_newer = counter > verifier_.counter();
    const Verdict verdict = verifier_.verify(secured);
    law(verdict == (is_newer ? Verdict::kAuthentic : Verdict::kReplayed), "each once, in order");
    std::vector<std::byte> stripped(plain.size());
    authentication::strip(secured, stripped);
    law(stripped == plain, "what is stripped is what was signed");
  }

  // A bit behind the message id, on its way.
  void change(std::vector<std::byte>& secured) {
    const std::size_t bit = 32 + in_.u16_be() % (8 * secured.size() - 32);
    secured[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    const std::uint32_t before = verifier_.counter();
    law(verifier_.verify(secured) != Verdict::kAuthentic, "what was changed is not believed");
    law(verifier_.counter() == before, "what is dropped changes nothing");
  }

  wire::ByteReader in_;
  authentication::CmacKey key_{authentication::Key{std::byte{3}}};
  authentication::Verifier verifier_{key_, kKind, kRun};
};

}  // namespace

void check(std::span<const std::byte> input) { Drive(wire::ByteReader(input)).run(); }

}  // namespace iog::fuzz
