#include "tools/fuse/offline_target.hpp"

#include <chrono>
#include <string>

#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

void demand_fit_for_classes(const vehicle::Vehicle& vehicle) {
  switch (app::unfit_for_perception(vehicle)) {
    case app::Unfit::kNone:
      break;
    case app::Unfit::kFusionRule:
      throw UsageError(std::string(vehicle.name) +
                       " has no class grid: its fusion rule is bayes, and slices of a frame join "
                       "only by hits_win");
    case app::Unfit::kQuantisation:
      throw UsageError(std::string(vehicle.name) +
                       " has no class grid: its quantisation is nearest, which calls cells behind "
                       "a hit occupied, too; it needs blurring");
  }
}

}  // namespace

OfflineTarget::OfflineTarget(const vehicle::Vehicle& vehicle, MessageHandler on_message,
                             Stopwatch stopwatch, std::uint32_t run_number, app::Coding coding)
    : vehicle_(&vehicle),
      platform_(std::move(on_message), stopwatch, run_number),
      pipeline_(pipeline_of(vehicle, coding)) {}

OfflineTarget::AnyPipeline OfflineTarget::pipeline_of(const vehicle::Vehicle& vehicle,
                                                      app::Coding coding) {
  if (!vehicle::have_classes(vehicle.grids)) {
    return make_large<Indexes>(vehicle, kReplayer, platform_, coding);
  }
  demand_fit_for_classes(vehicle);
  return make_large<Classes>(vehicle, kReplayer, platform_, coding);
}

void OfflineTarget::begin_with_map(std::vector<std::uint8_t> block) {
  if (!vehicle::have_classes(vehicle_->grids)) {
    throw UsageError("--map: " + std::string(vehicle_->name) +
                     " has no classes, so it has no use for one");
  }
  map_ = std::move(block);
  std::visit([this](auto& pipeline) { pipeline->begin_with_map(map_); }, pipeline_);
}

std::uint64_t OfflineTarget::deadline_us() const {
  return std::visit([](const auto& pipeline) { return pipeline->deadline_us(); }, pipeline_);
}

void OfflineTarget::close_overdue() {
  std::visit([](auto& pipeline) { pipeline->tick(pipeline->deadline_us()); }, pipeline_);
}

intake::Datagram OfflineTarget::datagram_of(const CapturedDatagram& captured) {
  return {.source_ipv4 = kReplayer,
          .destination_port = captured.destination.port,
          .payload = captured.payload};
}

OfflineTarget::Closed OfflineTarget::take(const CapturedDatagram& datagram) {
  Closed closed;
  const std::uint64_t now_us = clock_.move_to(datagram.time_us);
  while (deadline_us() <= now_us) {
    close_overdue();
  }
  closed.before = platform_.take_evidence_frames();
  const intake::Datagram its = datagram_of(datagram);
  std::visit([&](auto& pipeline) { pipeline->take(its, now_us); }, pipeline_);
  // A frame that is open and one period old at most has begun with this datagram, so the frame that
  // was closed just now had been closed before it. Otherwise the datagram completed it.
  const bool has_opened = deadline_us() == now_us + vehicle_->frame_period_us;
  const unsigned by_datagram = platform_.take_evidence_frames();
  const bool began_next = by_datagram == 2 || (by_datagram == 1 && has_opened);
  closed.before += began_next ? 1U : 0U;
  closed.after = by_datagram - (began_next ? 1U : 0U);
  is_open_ = closed.after == 0;
  return closed;
}

void OfflineTarget::start(std::uint64_t now_us) {
  std::visit([now_us](auto& pipeline) { pipeline->start(now_us); }, pipeline_);
}

void OfflineTarget::take_at(const CapturedDatagram& datagram, std::uint64_t now_us, bool is_left) {
  const intake::Datagram its = datagram_of(datagram);
  std::visit(
      [&](auto& pipeline) { is_left ? pipeline->leave(its, now_us) : pipeline->take(its, now_us); },
      pipeline_);
}

void OfflineTarget::pass(std::uint64_t now_us) {
  std::visit([now_us](auto& pipeline) { pipeline->tick(now_us); }, pipeline_);
}

void OfflineTarget::finish() {
  if (is_open_) {
    close_overdue();
    is_open_ = false;
  }
}

bool OfflinePlatform::send_message(std::span<const std::byte> message) {
  stream::Header header;
  std::span<const std::byte> body;
  const std::span content = message.subspan(protection::kProtectionBytes);
  if (stream::read_header(content, header, body) == stream::ReadStatus::kOk &&
      header.type == stream::MessageType::kFrameEnd) {
    ++frames_ended_;
    evidence_frames_ += header.has_evidence() ? 1U : 0U;
  }
  on_message_(message);
  return true;
}

std::uint32_t OfflinePlatform::ticks() const {
  using std::chrono::microseconds;
  if (stopwatch_ == Stopwatch::kStands) {
    return 0;
  }
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<std::uint32_t>(std::chrono::duration_cast<microseconds>(now).count());
}

}  // namespace iog::tools
