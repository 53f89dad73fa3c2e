// What a receiver believes that has the key of its target: messages that a signature has named
// (authentication/stream_signer.hpp). A signature comes behind its messages, so they wait for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <span>
#include <vector>

#include "authentication/stream_signer.hpp"

namespace iog::tools {

class SignedStream {
 public:
  // To be called with each message that is authentic, in the order of sending.
  using Pass = std::function<void(std::span<const std::byte>)>;

  explicit SignedStream(const authentication::Key& key) : key_(key) {}
  // Verifiers point to the key.
  SignedStream(const SignedStream&) = delete;
  SignedStream& operator=(const SignedStream&) = delete;

  // Any datagram may come.
  void take(std::span<const std::byte> datagram, const Pass& pass);

  // Of the messages that still wait none is authentic.
  void finish();

  // What comes next is another stream, or this one from its beginning.
  void forget();

  [[nodiscard]] std::uint64_t signatures() const { return signatures_; }
  // Whether the datagram is a signature, or says that it is one.
  [[nodiscard]] static bool claims_to_sign(std::span<const std::byte> datagram);

  // Datagrams that no signature has named: forged, changed, or their signature is lost.
  [[nodiscard]] std::uint64_t unsigned_messages() const { return unsigned_; }
  // Signatures of another key, or of before.
  [[nodiscard]] std::uint64_t forged_signatures() const { return forged_; }

 private:
  // A frame of a wide road is some 480 messages, and may be overtaken.
  static constexpr std::size_t kMostWaiting = 2'048;
  // Messages that come behind their signature are waited for as long as these many follow.
  static constexpr std::size_t kMostNamed = 2'048;
  static constexpr std::size_t kMostRuns = 16;
  // A message is given up when so many signatures have come behind it.
  static constexpr std::uint64_t kPatience = 16;

  struct Waiting {
    authentication::MessageName name;
    std::vector<std::byte> datagram;
    std::uint64_t signatures_before;
  };

  void take_signature(std::span<const std::byte> datagram, const Pass& pass);
  [[nodiscard]] bool is_authentic(std::span<const std::byte> datagram, std::uint32_t run);
  void take_name(const authentication::MessageName& name, const Pass& pass);
  void give_up_oldest();

  authentication::CmacKey key_;
  std::list<Waiting> waiting_;                    // the oldest first
  std::list<authentication::MessageName> named_;  // of which no message has come
  std::map<std::uint32_t, authentication::Verifier> runs_;
  std::list<std::uint32_t> order_of_runs_;
  std::uint64_t signatures_ = 0;
  std::uint64_t unsigned_ = 0;
  std::uint64_t forged_ = 0;
};

}  // namespace iog::tools
