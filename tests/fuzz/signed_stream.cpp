// A receiver that has its target's key (tools/frames/signed_stream.hpp) on a series of steps: bytes
// of any kind, messages that its target signs, and signatures with something changed. Laws: what is
// believed was signed, and is believed no more often than it was signed; every message is believed
// or counted.
#include "tools/frames/signed_stream.hpp"

#include <map>
#include <vector>

#include "law.hpp"
#include "stream/channel.hpp"
#include "wire/byte_reader.hpp"

namespace iog::fuzz {
namespace {

class Drive {
 public:
  explicit Drive(wire::ByteReader in) : in_(in) {}

  void run() {
    while (in_.remaining() > 0) {
      const std::uint8_t what = in_.u8();
      const auto piece = next_piece(in_);
      switch (what % 4) {
        case 0:
          take(piece);
          break;
        case 1:
          send(piece, what);
          break;
        default:
          sign(what);
      }
    }
    stream_.finish();
    law(believed_ + stream_.unsigned_messages() + stream_.signatures() +
                stream_.forged_signatures() ==
            taken_,
        "every datagram is counted once");
  }

 private:
  void take(std::span<const std::byte> datagram) {
    ++taken_;
    stream_.take(datagram, [this](std::span<const std::byte> message) {
      ++believed_;
      std::uint32_t& left = signed_[{message.begin(), message.end()}];
      law(left > 0, "what is believed was signed");
      --left;
    });
  }

  // A message of the target, which may come before or after its signature, or not at all.
  void send(std::span<const std::byte> message, std::uint8_t what) {
    if (signer_.is_full()) {
      return;
    }
    signer_.add(message);
    has_more_ = true;
    ++waiting_[{message.begin(), message.end()}];
    if (what % 8 == 1) {
      take(message);
    }
  }

  void sign(std::uint8_t what) {
    if (!has_more_) {
      return;
    }
    has_more_ = false;
    const std::span<const std::byte> signature = signer_.sign();
    std::vector<std::byte> sent(signature.begin(), signature.end());
    if (what % 4 == 2) {
      sent[8 + what % (sent.size() - 8)] ^= std::byte{1};
    } else {
      for (const auto& [message, times] : waiting_) {
        signed_[message] += times;
      }
    }
    waiting_.clear();
    take(sent);
  }

  static constexpr authentication::Key kKey{std::byte{7}};

  wire::ByteReader in_;
  authentication::CmacKey key_{kKey};
  authentication::StreamSigner signer_{key_, stream::kSignatureChannel, 77};
  tools::SignedStream stream_{kKey};
  std::map<std::vector<std::byte>, std::uint32_t> waiting_;  // to be signed
  std::map<std::vector<std::byte>, std::uint32_t> signed_;   // and not believed yet
  bool has_more_ = false;
  std::uint64_t taken_ = 0;
  std::uint64_t believed_ = 0;
};

}  // namespace

void check(std::span<const std::byte> input) { Drive(wire::ByteReader(input)).run(); }

}  // namespace iog::fuzz
