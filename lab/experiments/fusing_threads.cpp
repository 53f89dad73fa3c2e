#include "lab/experiments/fusing_threads.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "grid/frame_tiles.hpp"
#include "grid/joined_grid.hpp"
#include "intake/packet.hpp"
#include "lab/experiments/target_drive.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "work/round.hpp"

namespace iog::lab {
namespace {

constexpr std::size_t kThreads = 2;
constexpr std::uint32_t kFrames = 10;
constexpr std::size_t kTimedRounds = 7;

using Frame = std::vector<tools::CapturedDatagram>;

// A thread that does items of rounds until it ends.
class Helper {
 public:
  explicit Helper(work::Round& round) : thread_([this, &round] { help(round); }) {}
  Helper(const Helper&) = delete;
  Helper& operator=(const Helper&) = delete;
  ~Helper() {
    is_ending_ = true;
    thread_.join();
  }

 private:
  void help(work::Round& round) {
    while (!is_ending_) {
      round.help(1, done_);
      std::this_thread::yield();
    }
  }

  std::atomic<bool> is_ending_ = false;
  std::atomic<std::uint32_t> done_ = 0;
  std::thread thread_;  // begins when all else is there
};

class SharedFrames {
 public:
  explicit SharedFrames(std::string_view scene) : car_(tools::find_vehicle("reference_car")) {
    for (auto& fusion : fusions_) {
      fusion = std::make_unique<grid::FrameFusion>(*car_.vehicle);
    }
    tools::Drive drive(car_, kTargetSeed, kTargetSeconds, tools::find_scene(scene));
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
      frames_.push_back(drive.datagrams(frame));
      while (tiles_.size() < frames_.back().size()) {
        tiles_.push_back(std::make_unique<grid::FrameTiles>());
      }
    }
  }

  // All frames, by this thread and a helper, if it is there.
  void fuse() {
    for (const Frame& frame : frames_) {
      auto fuse_one = [&](std::size_t item, std::size_t core) { fuse_packet(frame, item, core); };
      do_all(frame.size(), work::work_of(fuse_one));
      auto join_one = [&](std::size_t row, std::size_t /*core*/) { join_row(frame.size(), row); };
      do_all(geometry::kTilesPerSide, work::work_of(join_one));
    }
  }

  [[nodiscard]] work::Round& round() { return round_; }

 private:
  void do_all(std::size_t items, work::Work work) {
    round_.open(items, work);
    round_.help(0, done_);
    while (!round_.is_done()) {
      std::this_thread::yield();
    }
  }

  void fuse_packet(const Frame& frame, std::size_t item, std::size_t core) {
    grid::FrameFusion& fusion = *fusions_[core];
    const vehicle::Sensor& sensor =
        car_.vehicle->sensors[tools::sensor_of_port(car_, frame[item].destination.port)];
    intake::Packet::decode(sensor.format, frame[item].payload)
        .for_each_point([&](const lidar::ScanPoint& point) { fusion.add(sensor, point); });
    fusion.finish();
    tiles_[item]->take(fusion);
  }

  void join_row(std::size_t packets, std::size_t row) {
    for (std::size_t column = 0; column < geometry::kTilesPerSide; ++column) {
      const std::size_t tile = row * geometry::kTilesPerSide + column;
      grid_->forget(tile);
      for (std::size_t packet = 0; packet < packets; ++packet) {
        if (tiles_[packet]->is_known(tile)) {
          grid_->add(tile, tiles_[packet]->tile(tile));
        }
      }
    }
  }

  const tools::CatalogueEntry& car_;
  std::vector<Frame> frames_;
  std::array<std::unique_ptr<grid::FrameFusion>, kThreads> fusions_;
  std::vector<std::unique_ptr<grid::FrameTiles>> tiles_;
  std::unique_ptr<grid::JoinedGrid> grid_ = std::make_unique<grid::JoinedGrid>();
  work::Round round_;
  std::atomic<std::uint32_t> done_ = 0;
};

double seconds_of(SharedFrames& frames) {
  const auto start = std::chrono::steady_clock::now();
  frames.fuse();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

double time_ratio_of_two_threads(std::string_view scene) {
  const auto frames = std::make_unique<SharedFrames>(scene);
  std::vector<double> ratios;
  for (std::size_t round = 0; round < kTimedRounds; ++round) {
    const double alone_s = seconds_of(*frames);
    const Helper helper(frames->round());
    ratios.push_back(alone_s / seconds_of(*frames));
  }
  std::ranges::sort(ratios);
  return ratios[kTimedRounds / 2];
}

}  // namespace iog::lab
