#include "stage_pass.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "lab/a9_model/marker.hpp"
#include "require/require.hpp"
#include "wire/byte_order.hpp"

namespace iog::lab {

void Spread::add(std::uint32_t value) {
  sum += value;
  smallest = std::min(smallest, value);
  largest = std::max(largest, value);
}

void StagePass::take(const vehicle::Sensor& /*sensor*/, const intake::Datagram& datagram,
                     std::uint32_t received, std::uint64_t now_us) {
  received_ += received;
  pipeline_->take(datagram, now_us);
  collect();
}

void StagePass::tick(std::uint64_t now_us) {
  pipeline_->tick(now_us);
  collect();
}

void StagePass::renew(std::uint64_t now_us) {
  a9_model::pause();
  pipeline_.emplace(vehicle_, kReplayer, platform_, coding_);
  pipeline_->start(now_us);
  a9_model::resume();
}

void StagePass::collect() {
  platform_.for_each_closed([this](std::span<const std::byte> message) { add_end(message); });
}

// A frame's end tells its own fusing and marking, and the publishing of the frame before.
void StagePass::add_end(std::span<const std::byte> message) {
  stream::Header header;
  stream::FrameEnd end;
  std::span<const std::byte> body;
  require(stream::read_header(message.subspan(protection::kProtectionBytes), header, body) ==
          stream::ReadStatus::kOk);
  require(header.type == stream::MessageType::kFrameEnd);
  require(stream::read_frame_end(body, header.sensor_count, end) == stream::ReadStatus::kOk);
  if (before_.has_evidence) {
    receive_.add(before_.receive);
    fuse_.add(before_.fuse);
    mark_.add(before_.mark);
    publish_.add(end.ticks.publish);
    whole_.add(before_.receive + before_.fuse + before_.mark + end.ticks.publish);
  }
  before_ = {.has_evidence = header.has_evidence(),
             .receive = std::exchange(received_, 0U),
             .fuse = end.ticks.fuse,
             .mark = end.ticks.mark};
  if (header.has_evidence()) {
    ++frames_;
    packets_ += header.packets_fused;
    points_ += header.points_used + header.points_other;
    points_used_ += header.points_used;
    tiles_ += end.tiles_sent;
    std::array<std::byte, 4> crc{};
    wire::store_be32(crc, end.grid_crc);
    run_hash_.update(crc);
  }
}

}  // namespace iog::lab
