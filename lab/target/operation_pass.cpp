#include "operation_pass.hpp"

#include <array>

#include "traversal/walk.hpp"
#include "vehicle/beam.hpp"

namespace iog::lab {

template <typename Work>
auto OperationPass::measured(std::uint64_t& sum, Work&& work) {
  const std::uint32_t start = counter_.now();
  auto result = work();
  sum += counter_.now() - start - counter_.of_nothing();
  return result;
}

void OperationPass::take(const vehicle::Sensor& sensor, const intake::Datagram& datagram,
                         std::uint32_t /*received*/, std::uint64_t now_us) {
  using Outcome = app::Frame::Outcome;
  const auto packet = measured(cost_.inspect, [&] { return frame_.receive(datagram); });
  const auto classify = [&] {
    return measured(cost_.inspect, [&] { return frame_.classify(*packet); });
  };
  Outcome outcome = packet ? classify() : Outcome::kDropped;
  if (outcome == Outcome::kNextFrame) {
    close_frame(now_us);
    outcome = classify();
  }
  if (outcome == Outcome::kThisFrame) {
    measured(cost_.fuse, [&] {
      frame_.fuse(*packet, now_us, work::Crew());
      return true;
    });
    take_apart(sensor, datagram.payload);
  }
  if (frame_.is_complete()) {
    close_frame(now_us);
  }
}

void OperationPass::tick(std::uint64_t now_us) {
  if (frame_.is_overdue(now_us)) {
    close_frame(now_us);
  }
}

void OperationPass::close_frame(std::uint64_t now_us) {
  frame_.finish(work::Crew(), [](auto /*stage*/) {});
  stream::GridHash hash;
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    take_tile_apart(tile, hash);
  }
  frame_.start_next(now_us);
}

void OperationPass::take_tile_apart(std::size_t tile, stream::GridHash& hash) {
  const grid::BlockGrid& view = frame_.fusion().own().view();
  if (!measured(cost_.find, [&] { return view.is_touched(tile); })) {
    return;
  }
  // What it takes to copy a tile and clear it, less what it takes to copy it.
  std::array<grid::OccupancyIndex, tile_coding::kTileBytes> cells;
  std::uint64_t copied = 0;
  std::uint64_t taken = 0;
  static_cast<void>(measured(copied, [&] { return view.copy_tile(tile, cells); }));
  const bool is_known =
      measured(taken, [&] { return frame_.fusion().own().take_tile(tile, cells); });
  cost_.hash += copied;
  cost_.clear += taken - copied;
  measured(cost_.hash, [&] {
    if (is_known) {
      hash.add(tile, std::as_bytes(std::span(cells)));
    }
    return is_known;
  });
}

void OperationPass::take_apart(const vehicle::Sensor& sensor, std::span<const std::byte> payload) {
  const auto each = [&](const lidar::ScanPoint& point) { take_apart(sensor, point); };
  measured(cost_.decode, [&] {
    return intake::Packet::decode(sensor.format, payload, sensor.unit());
  }).for_each_point(each);
}

void OperationPass::take_apart(const vehicle::Sensor& sensor, const lidar::ScanPoint& point) {
  const vehicle::Beam beam =
      measured(cost_.aim, [&] { return vehicle::aim(sensor, point.layer, point.azimuth_ticks); });
  const vehicle::BeamRanges ranges =
      measured(cost_.aim, [&] { return vehicle::ranges_of(sensor, beam); });
  static_cast<void>(
      measured(cost_.judge, [&] { return vehicle::classify(sensor, ranges, point); }));
  ++cost_.points;
  cost_.cells += carved_cells(sensor, beam, point);
}

// Fuses the point alone into a grid of zeros, then looks along its line for cells that are not zero
// and sets them back. Its marks wait in a list that nobody applies.
std::uint32_t OperationPass::carved_cells(const vehicle::Sensor& sensor, const vehicle::Beam& beam,
                                          const lidar::ScanPoint& point) {
  static_cast<void>(single_.add(sensor, point));
  single_.carve_waiting();
  const auto inside = beam.line.clip(geometry::kGridArea);
  if (!inside) {
    return 0;
  }
  std::uint32_t carved = 0;
  traversal::Walk walk(beam.line, inside->first, geometry::kCellsPerSide);
  walk.until(inside->last.crossed() + 1, [&](std::size_t number) {
    carved += single_.view().at(geometry::cell_of(number)) != index::kUnknown ? 1U : 0U;
  });
  single_.clear();
  return carved;
}

}  // namespace iog::lab
