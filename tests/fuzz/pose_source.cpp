// The source of the poses (pose/source.hpp) on a series of steps: messages whose CRC is right and
// whose fields are the input's, the same once more, bytes of any kind, the passing of time, and
// slices that ask for their pose. Laws: nothing that is dropped changes anything; a pose has a
// message near its time, whose sigma allows it; every datagram and every slice is counted once.
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "law.hpp"
#include "pose/limits.hpp"
#include "pose/source.hpp"

namespace iog::fuzz {
namespace {

using pose::Fate;
using pose::Message;
using pose::Placed;

constexpr std::uint32_t kSender = 7;

std::uint64_t distance(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : b - a; }

class Drive {
 public:
  explicit Drive(wire::ByteReader in) : in_{in} {}

  void run() {
    while (in_.remaining() > 0 && steps_ < 2'000) {
      ++steps_;
      step(in_.u8() % 8);
      law(sum(source_.fates()) == datagrams_, "a datagram has one fate");
      law(sum(source_.slices()) == slices_, "a slice has one cause");
    }
  }

 private:
  template <std::size_t kCount>
  [[nodiscard]] static std::uint32_t sum(const std::array<std::uint32_t, kCount>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint32_t{0});
  }

  void step(int what) {
    switch (what) {
      case 0:  // anything
        receive(kSender, next_piece(in_));
        break;
      case 1:  // once more, or from elsewhere
        receive(in_.u8(), last_);
        break;
      case 2:  // any fields
        send(any_message());
        break;
      case 3:
        source_.pass(clock_us_ + in_.u32_be());
        break;
      case 4:  // any time
        ask(in_.u64_be());
        break;
      case 5:
        ask(clock_us_ + in_.u16_be() * 16ULL - 900'000);
        break;
      default:  // driving on
        send(next_message());
    }
  }

  Message any_message() {
    Message message;
    message.run = in_.u8() % 4;
    message.age_us = in_.u32_be() % 250'000;
    message.clock_us = in_.u64_be();
    message.pose = {in_.i32_be(), in_.i32_be(), in_.u32_be()};
    message.sigma = {in_.u16_be(), in_.u16_be()};
    message.speed_mm_per_s = in_.i32_be();
    message.yaw_urad_per_s = in_.i32_be();
    if (in_.u8() % 2 == 0) {
      message.map = pose::MapTransform{in_.u64_be(), {in_.i32_be(), 0, 0}, {in_.u16_be(), 1}};
    }
    return message;
  }

  Message next_message() {
    clock_us_ += in_.u16_be() * 4ULL;
    const std::uint8_t off = in_.u8();
    Message message{.run = off % 16U == 0 ? 2U : 1U, .clock_us = clock_us_};
    message.pose.x_mm = off % 8 == 0 ? off * 5 : 0;
    message.sigma = {static_cast<std::uint16_t>(off), 200};
    return message;
  }

  void send(const Message& message) {
    const auto bytes = encoder_.encode(message);
    const pose::Decoded decoded = pose::decode(bytes);
    law(decoded.fate != Fate::kUsed || decoded.message == message, "what was sent is read");
    last_.assign(bytes.begin(), bytes.end());
    const Fate fate = receive(kSender, bytes);
    law(fate != Fate::kUsed || decoded.fate == Fate::kUsed, "only what is sound is used");
    if (decoded.fate == Fate::kUsed) {
      sound_.push_back(message);
    }
  }

  Fate receive(std::uint32_t from, std::span<const std::byte> datagram) {
    ++datagrams_;
    const pose::Source before = source_;
    const Fate fate = source_.receive(from, datagram, clock_us_ + 1'000);
    law(from == kSender || fate == Fate::kStranger, "strangers are told apart");
    if (fate >= Fate::kUnconfirmed) {
      law(source_.epoch() == before.epoch(), "what is not used breaks nothing");
      law(source_.newest() == before.newest(), "nor is it the newest");
    }
    return fate;
  }

  void ask(std::uint64_t time_us) {
    ++slices_;
    const pose::Slice slice = source_.slice_of(time_us);
    const std::uint32_t epoch = source_.epoch();
    const Placed placed = source_.place(slice);
    law(source_.epoch() == epoch, "asking breaks nothing");
    law(source_.place(slice) == placed, "and changes no answer");
    ++slices_;
    if (placed.has_pose()) {
      check_pose(placed, slice.middle_us);
    }
  }

  void check_pose(const Placed& placed, std::uint64_t time_us) {
    law(placed.sigma.position_mm <= 150 && placed.sigma.heading_10urad <= 300, "precise");
    const Message newest = source_.newest().value_or(Message{});
    const auto is_near = [&](const Message& message) {
      return message.run == newest.run && message.clock_us <= newest.clock_us &&
             distance(message.clock_us, time_us) <= pose::kLateUs;
    };
    law(std::ranges::any_of(sound_, is_near), "a message is near");
    constexpr std::int64_t kFarthest = std::int64_t{pose::kMaxCoordinateMm} + 10'001;
    law(std::abs(std::int64_t{placed.pose.x_mm}) <= kFarthest &&
            std::abs(std::int64_t{placed.pose.y_mm}) <= kFarthest,
        "a pose is where a message can be, or a tenth of a second farther");
  }

  wire::ByteReader in_;
  pose::Source source_{{.source_ipv4 = kSender}};
  pose::Encoder encoder_;
  std::uint64_t clock_us_ = 3'000'000;
  std::vector<std::byte> last_;
  std::vector<Message> sound_;
  std::uint32_t datagrams_ = 0;
  std::uint32_t slices_ = 0;
  int steps_ = 0;
};

}  // namespace

void check(std::span<const std::byte> input) { Drive(wire::ByteReader(input)).run(); }

}  // namespace iog::fuzz
