// A receiver of protected messages at the end of a link that loses, repeats, exchanges and spoils
// them, or sends something of its own. The input says what the link does.
#include <algorithm>
#include <vector>

#include "law.hpp"
#include "protection/protected_message.hpp"
#include "tools/frames/supervision.hpp"

namespace iog::fuzz {
namespace {

using protection::CheckStatus;
using protection::kProtectionBytes;
using protection::Received;
using protection::SomeIpStatus;
using Bytes = std::vector<std::byte>;

constexpr protection::Channel kChannel{
    .event = {.service_id = 0x1234, .event_id = 0x8001, .interface_version = 1},
    .data_id = 0x0A0B0C0D,
    .max_delta_counter = 8};
constexpr protection::Supervision kSupervision{.window = 8,
                                               .init = {.min_ok = 2, .max_errors = 2},
                                               .valid = {.min_ok = 1, .max_errors = 4},
                                               .invalid = {.min_ok = 4, .max_errors = 0}};
static_assert(kSupervision.is_valid());

class Link {
 public:
  explicit Link(wire::ByteReader in) : in_{in} {}

  void run() {
    while (in_.remaining() > 0 && sent_.size() < 512) {
      step(in_.u8() % 6);
    }
  }

 private:
  void step(int what) {
    switch (what) {
      case 0:  // sent and received
        send();
        receive(sent_.back(), sent_.size() - 1);
        break;
      case 1:  // lost
        send();
        break;
      case 2:  // an old one, or a repeated one
        if (!sent_.empty()) {
          const std::size_t which = sent_.size() - 1 - in_.u8() % sent_.size();
          receive(sent_[which], which);
        }
        break;
      case 3:
        send();
        receive_spoilt(sent_.back());
        break;
      case 4:
        receive_strange(next_piece(in_));
        break;
      default:
        supervisor_.update(CheckStatus::kNoNewData);
    }
  }

  void send() {
    Bytes message(kProtectionBytes + 4 + in_.u8() % 64U);
    std::ranges::fill(message, static_cast<std::byte>(in_.u8()));
    sender_.protect(message);
    sent_.push_back(std::move(message));
  }

  // Message `number` of the sender, as it was sent.
  void receive(const Bytes& message, std::size_t number) {
    const Received received = receiver_.receive(message);
    law(received.header == SomeIpStatus::kOk, "a message of ours has its header");
    law(received.check == expected_check(number), "a check says what the counters say");
    law(std::ranges::equal(received.content, std::span(message).subspan(kProtectionBytes)),
        "the content is what was sent");
    last_ = number;
    supervisor_.update(received.check);
  }

  [[nodiscard]] CheckStatus expected_check(std::size_t number) const {
    const std::size_t expected = last_ == kNone ? 0 : last_ + 1;
    if (last_ != kNone && number == last_) {
      return CheckStatus::kRepeated;
    }
    if (number < expected || number - expected + 1 > kChannel.max_delta_counter) {
      return CheckStatus::kWrongSequence;
    }
    return number == expected ? CheckStatus::kOk : CheckStatus::kOkSomeLost;
  }

  // Up to four flipped bits, which the CRC always sees (a fifth of the same place may undo one).
  void receive_spoilt(Bytes message) {
    const Bytes whole = message;
    for (int flips = in_.u8() % 4 + 1; flips > 0; --flips) {
      message[in_.u16_be() % message.size()] ^= std::byte{1} << (in_.u8() % 8);
    }
    if (message != whole) {
      receive_strange(message);
    }
  }

  void receive_strange(std::span<const std::byte> datagram) {
    const bool is_ours = std::ranges::any_of(
        sent_, [&](const Bytes& message) { return std::ranges::equal(message, datagram); });
    if (is_ours) {
      return;
    }
    const Received received = receiver_.receive(datagram);
    law(received.header != SomeIpStatus::kOk || received.check == CheckStatus::kError,
        "nothing passes that was not sent");
    law(received.content.empty() && received.delta_counter == 0, "and nothing of it");
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  wire::ByteReader in_;
  protection::Sender sender_{kChannel};
  protection::Receiver receiver_{kChannel};
  protection::Supervisor supervisor_{kSupervision};
  std::vector<Bytes> sent_;
  std::size_t last_ = kNone;
};

}  // namespace

void check(std::span<const std::byte> input) { Link(wire::ByteReader(input)).run(); }

}  // namespace iog::fuzz
