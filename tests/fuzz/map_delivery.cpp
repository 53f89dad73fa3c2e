// The delivery of maps (map/delivery.hpp) on a series of steps: chunks whose CRC is right and whose
// fields are the input's, those of a sound block, bytes of any kind, and frames. Laws: every
// datagram is counted once; nothing that is dropped changes what is on its way; what is in use is
// sound.
#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

#include "fakes/reference_block.hpp"
#include "law.hpp"
#include "map/delivery.hpp"

namespace iog::fuzz {
namespace {

constexpr std::uint32_t kSender = 7;

class Delivering {
 public:
  explicit Delivering(wire::ByteReader in) : in_{in} {}

  void run() {
    while (in_.remaining() > 0 && steps_ < 2'000) {
      ++steps_;
      step(in_.u8() % 8);
      const auto& fates = delivery_->report().fates;
      law(std::accumulate(fates.begin(), fates.end(), 0U) == datagrams_, "a datagram has one fate");
      check_use();
    }
  }

 private:
  void step(int what) {
    switch (what) {
      case 0:  // anything
        receive(kSender, next_piece(in_));
        break;
      case 1: {  // any fields
        const auto piece = next_piece(in_);
        send({.block = {.crc = in_.u8() % 4U, .bytes = in_.u32_be() % 8'000},
              .offset = in_.u8() * map::kChunkBytes / 2,
              .bytes = piece.first(std::min<std::size_t>(piece.size(), map::kChunkBytes))});
        break;
      }
      case 2:  // a block of a name, and any bytes
        send_of(std::as_bytes(std::span(sound_)), in_.u8());
        break;
      case 3:
        now_us_ += in_.u16_be() * 64ULL;
        break;
      case 4:
        delivery_->work();
        break;
      default:
        send_of(std::as_bytes(std::span(sound_)), tests::crc_of(sound_));
    }
  }

  void send_of(std::span<const std::byte> block, std::uint32_t crc) {
    const std::size_t chunks = (block.size() + map::kChunkBytes - 1) / map::kChunkBytes;
    send(map::chunk_of(crc, block, in_.u8() % chunks));
  }

  void send(const map::Chunk& chunk) { receive(kSender, encoder_.encode(chunk)); }

  void receive(std::uint32_t from, std::span<const std::byte> datagram) {
    ++datagrams_;
    const map::DeliveryReport before = delivery_->report();
    const map::Fate fate = delivery_->receive(from, datagram, now_us_);
    const map::DeliveryReport& after = delivery_->report();
    if (fate != map::Fate::kTaken) {
      law(before.state == after.state, "a drop changes nothing");
      law(before.chunks_there == after.chunks_there, "nor how much is there");
    }
  }

  void check_use() {
    const map::Block* const block = delivery_->in_use();
    if (block == nullptr) {
      return;
    }
    std::uint32_t features = 0;
    block->for_each_feature_in(block->extent(), [&](const map::Feature&) { ++features; });
    law(features == block->feature_count(), "what is in use can be read");
    law(block->crc() == tests::crc_of(sound_), "and is the sound one");
  }

  wire::ByteReader in_;
  std::unique_ptr<map::Delivery> delivery_ =
      std::make_unique<map::Delivery>(map::SourceDescription{.source_ipv4 = kSender});
  map::ChunkEncoder encoder_;
  std::vector<std::uint8_t> sound_ =
      tests::ReferenceBlock{
          .extent = tests::box_around({0, 0}, 20'000),
          .features = {{map::Kind::kBuilding, {tests::rectangle({{5, 7}, {905, 37}})}},
                       {map::Kind::kRoad, {tests::rectangle({{-900, 0}, {2'100, 500}})}}}}
          .bytes();
  std::uint64_t now_us_ = 0;
  std::uint32_t datagrams_ = 0;
  int steps_ = 0;
};

}  // namespace

void check(std::span<const std::byte> input) { Delivering(wire::ByteReader(input)).run(); }

}  // namespace iog::fuzz
