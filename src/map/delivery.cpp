#include "map/delivery.hpp"

#include <cstring>

#include "protection/believed.hpp"
#include "require/require.hpp"

namespace iog::map {

Delivery::Delivery(const SourceDescription& description, std::uint32_t replayer_ipv4)
    : description_{description}, replayer_ipv4_{replayer_ipv4} {
  require(description.is_valid());
}

Fate Delivery::receive(std::uint32_t source_ipv4, std::span<const std::byte> payload,
                       std::uint64_t arrival_us) {
  Fate fate = Fate::kStranger;
  if (protection::may_send(source_ipv4, description_.source_ipv4, replayer_ipv4_)) {
    const DecodedChunk decoded = decode_chunk(payload);
    fate = decoded.fate == Fate::kTaken ? accept(decoded.chunk, arrival_us) : decoded.fate;
  }
  ++report_.fates[static_cast<std::size_t>(fate)];
  return fate;
}

bool Delivery::is_in_use(const BlockName& block) const {
  return in_use_ && in_use_->crc() == block.crc && in_use_->size_bytes() == block.bytes;
}

Fate Delivery::accept(const Chunk& chunk, std::uint64_t arrival_us) {
  if (is_in_use(chunk.block)) {
    return Fate::kInUse;
  }
  const bool is_idle = report_.state == DeliveryState::kIdle;
  if (is_idle || chunk.block != report_.incoming) {
    const bool has_stopped =
        report_.state == DeliveryState::kReceiving && arrival_us - taken_us_ >= kPatienceUs;
    if (!is_idle && !has_stopped) {
      return Fate::kOtherBlock;
    }
    begin(chunk.block);
  }
  if (there_[chunk.number()]) {
    return Fate::kRepeated;
  }
  put(chunk);
  taken_us_ = arrival_us;
  return Fate::kTaken;
}

void Delivery::begin(const BlockName& block) {
  report_.state = DeliveryState::kReceiving;
  report_.incoming = block;
  report_.chunks_there = 0;
  there_.reset();
}

void Delivery::put(const Chunk& chunk) {
  std::memcpy(buffers_[idle_].data() + chunk.offset, chunk.bytes.data(), chunk.bytes.size());
  there_[chunk.number()] = true;  // set() could throw
  ++report_.chunks_there;
  if (report_.chunks_there == chunk_count(report_.incoming)) {
    report_.state = DeliveryState::kChecking;
  }
}

std::span<const std::uint8_t> Delivery::incoming() const {
  return std::span(buffers_[idle_]).first(report_.incoming.bytes);
}

void Delivery::begin_with(std::span<const std::uint8_t> block) {
  const Refusal refusal = map::check(block);
  if (refusal == Refusal::kNone) {
    in_use_.emplace(block);
  } else {
    refuse(refusal);
  }
}

void Delivery::work() {
  if (report_.state != DeliveryState::kChecking) {
    return;
  }
  if (!check_) {
    check_.emplace(incoming());
  }
  if (!check_->advance(kCheckBytesPerFrame)) {
    return;
  }
  const Refusal refusal = verdict();
  if (refusal == Refusal::kNone) {
    in_use_.emplace(incoming());
    idle_ = 1 - idle_;
  } else {
    refuse(refusal);
  }
  check_.reset();
  report_.state = DeliveryState::kIdle;
  report_.incoming = {};
  report_.chunks_there = 0;
}

// Refuses a valid block under another name, which would otherwise be delivered again and again.
Refusal Delivery::verdict() const {
  const Refusal refusal = check_->verdict();
  const bool has_its_name =
      refusal != Refusal::kNone || Block(incoming()).crc() == report_.incoming.crc;
  return has_its_name ? refusal : Refusal::kDamaged;
}

void Delivery::refuse(Refusal refusal) {
  ++report_.blocks_refused;
  report_.last_refusal = refusal;
}

}  // namespace iog::map
