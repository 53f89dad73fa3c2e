// How long the main stages of a frame take on this board: a table on the console, for one core and
// for all. It needs no network: packets of a street are made here (street.hpp), and messages become
// Ethernet frames that go nowhere. docs/porting.md says what the rows are.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "app/pipeline.hpp"
#include "board.hpp"
#include "car_block/car_block.hpp"
#include "car_of_image.hpp"
#include "net/ethernet.hpp"
#include "net/ipv4.hpp"
#include "net/outbound.hpp"
#include "net/udp.hpp"
#include "require/require.hpp"
#include "stream/class_end.hpp"
#include "stream/crc32.hpp"
#include "stream/message.hpp"
#include "street.hpp"
#include "text_line.hpp"
#include "wire/byte_order.hpp"
#include "work/team.hpp"

namespace {

using iog::board::Board;
using iog::tests::Street;
namespace app = iog::app;
namespace net = iog::net;
namespace stream = iog::stream;

constexpr std::uint32_t kWarmUpFrames = 5;
constexpr std::uint32_t kFrames = 20;
constexpr std::uint32_t kPatienceUs = 1'000'000;

struct Row {
  std::string_view name;
  std::uint64_t sum = 0;
  std::uint32_t worst = 0;

  void add(std::uint32_t ticks) {
    sum += ticks;
    worst = std::max(worst, ticks);
  }
};

// app::Platform, on all cores that the team has.
class TimedPlatform {
 public:
  using Team = iog::work::Team<iog::board::Cores>;

  TimedPlatform(Board& board, Team& team, const net::Config& network)
      : board_(board), team_(team), network_(network) {}

  bool send_message(std::span<const std::byte> message) {
    static_cast<void>(net::build_datagram(
        sent_, network_, {.address = network_.peer, .port = network_.peer_port}, 0, message));
    const std::uint32_t begin = board_.stopwatch().ticks();
    add_to_hash(message.subspan(iog::protection::kProtectionBytes));
    apart_ += board_.stopwatch().ticks() - begin;
    return true;
  }
  // Reading what was sent is no part of a stage: the clock stands still meanwhile.
  std::uint32_t ticks() { return board_.stopwatch().ticks() - apart_; }
  std::uint32_t ticks_hz() { return board_.stopwatch().ticks_hz(); }
  std::uint32_t run_number() { return 1; }
  std::size_t cores() const { return team_.cores(); }
  void share(std::size_t items, iog::work::Work work, iog::work::Beside beside = {}) {
    team_.share(items, work, beside);
  }

  // Once for each frame. The time of publishing is that of the frame before.
  const app::Vitals& vitals(const app::FrameTimes& times) {
    if (++closed_ > kWarmUpFrames && closed_ <= kWarmUpFrames + kFrames) {
      const stream::StageTicks& ticks = times.ticks;
      rows_[kReceive].add(received_);
      rows_[kFuse].add(ticks.fuse);
      rows_[kMark].add(ticks.mark);
      rows_[kClasses].add(ticks.perceive);
      rows_[kPublish].add(ticks.publish);
      rows_[kFrame].add(received_ + ticks.fuse + ticks.mark + ticks.perceive + ticks.publish);
    }
    received_ = 0;
    return vitals_;
  }
  void add_received(std::uint32_t ticks) { received_ += ticks; }

  void print() {
    iog::board::TextLine line;
    line.text("ns of a frame: cores ").decimal(static_cast<std::uint32_t>(cores()));
    line.text(", frames ").decimal(kFrames).text(", points ").decimal(points_);
    line.text(", grids ").hex(hash_.value()).text("\n");
    board_.console().write(line.view());
    for (const Row& row : rows_) {
      line = {};
      line.text(row.name).text(" mean ").decimal(ns(row.sum / kFrames));
      line.text(" worst ").decimal(ns(row.worst)).text("\n");
      board_.console().write(line.view());
      board_.watchdog().service();
    }
  }

 private:
  enum Place : std::uint8_t { kReceive, kFuse, kMark, kClasses, kPublish, kFrame };

  std::uint32_t ns(std::uint64_t ticks) {
    return static_cast<std::uint32_t>(ticks * 1'000'000'000 / ticks_hz());
  }

  // What the grids and the classes of all frames are, whatever they took.
  void add_to_hash(std::span<const std::byte> content) {
    stream::Header header;
    std::span<const std::byte> body;
    iog::require(stream::read_header(content, header, body) == stream::ReadStatus::kOk);
    if (header.type == stream::MessageType::kFrameEnd) {
      iog::require(stream::read_frame_end(body, header.sensor_count, end_) ==
                   stream::ReadStatus::kOk);
      add_to_hash(end_.grid_crc);
      points_ += header.points_used;
    }
    if (header.type == stream::MessageType::kClassEnd) {
      iog::require(stream::read_class_end(body, class_end_) == stream::ReadStatus::kOk);
      add_to_hash(class_end_.classes_crc);
    }
  }
  void add_to_hash(std::uint32_t crc) {
    std::array<std::byte, 4> bytes{};
    iog::wire::store_be32(bytes, crc);
    hash_.update(bytes);
  }

  Board& board_;
  Team& team_;
  net::Config network_;
  std::array<Row, 6> rows_{{{"receive"}, {"fuse"}, {"mark"}, {"classes"}, {"publish"}, {"frame"}}};
  std::uint32_t received_ = 0;
  std::uint32_t apart_ = 0;
  std::uint32_t closed_ = 0;
  std::uint32_t points_ = 0;  // of all frames, those before included
  app::Vitals vitals_;
  stream::FrameEnd end_;
  stream::ClassEnd class_end_;
  stream::Crc32 hash_;
  std::array<std::byte, net::kMaxFrameBytes> sent_{};
};

using Pipeline = app::PerceptionPipeline<TimedPlatform>;

// Packets come from the wire: the time of parsing counts.
class Feed {
 public:
  Feed(TimedPlatform& platform, Pipeline& pipeline, const net::Config& network)
      : platform_(platform), pipeline_(pipeline), network_(network) {}

  void take(std::uint16_t port, std::span<const std::byte> payload, std::uint64_t now_us) {
    const std::size_t bytes = net::build_datagram(
        frame_, network_, {.address = network_.address, .port = port}, 0, payload);
    const std::uint32_t begin = platform_.ticks();
    const auto frame = net::parse_ethernet(std::span(frame_).first(bytes));
    iog::require(frame.has_value());
    const net::Ipv4Result ip = net::parse_ipv4(frame->payload);
    iog::require(ip.status == net::Ipv4Status::kOk);
    const net::UdpResult udp = net::parse_udp(ip.packet);
    iog::require(udp.status == net::UdpStatus::kOk);
    platform_.add_received(platform_.ticks() - begin);
    pipeline_.take({.source_ipv4 = network_.peer.value,
                    .destination_port = udp.datagram.destination_port,
                    .payload = udp.datagram.payload},
                   now_us);
  }

 private:
  TimedPlatform& platform_;
  Pipeline& pipeline_;
  const net::Config& network_;
  std::array<std::byte, net::kMaxFrameBytes> frame_{};
};

void time_stages(Board& board, TimedPlatform::Team& team, const iog::vehicle::Vehicle& car,
                 const net::Config& network) {
  // Static: a pipeline is up to 130 MB.
  static std::optional<TimedPlatform> platform;
  static std::optional<Pipeline> pipeline;
  static std::optional<Street> street;
  static std::optional<Feed> feed;
  platform.emplace(board, team, network);
  pipeline.emplace(car, network.peer.value, *platform);
  street.emplace();
  feed.emplace(*platform, *pipeline, network);
  pipeline->start(0);
  for (std::uint32_t frame = 0; frame < kWarmUpFrames + kFrames + 2; ++frame) {
    const std::uint64_t now_us = frame * iog::tests::kFramePeriodUs;
    for (std::uint32_t number = 0; number < Street::kPoses; ++number) {
      feed->take(iog::pose::kPosePort, street->pose(frame, number),
                 now_us + number * Street::kPoseEveryUs);
    }
    for (std::uint32_t message = 0; message < Street::kMessages; ++message) {
      for (std::uint32_t sensor = 0; sensor < Street::kSensors; ++sensor) {
        feed->take(car.sensors[sensor].udp_port, street->scan(frame, sensor, message),
                   now_us + iog::tests::kFramePeriodUs - 5000);
      }
    }
    board.watchdog().service();
  }
  platform->print();
}

}  // namespace

int main() {
  namespace car_block = iog::car_block;
  static car_block::SensorMemory sensors;
  static iog::vehicle::Vehicle car;
  const car_block::Block block = iog::board::car_of_image();
  const std::optional<net::Config> network = car_block::read_network(block);
  const car_block::Verdict verdict =
      car_block::read_car(block, iog::vehicle::Grids::kBoth, sensors, car);
  static Board board({0x02, 0, 0, 0, 0, 1});
  board.print_banner();
  iog::require(network.has_value() && verdict.refusal == car_block::Refusal::kNone);
  static TimedPlatform::Team team(board.cores(), kPatienceUs);
  time_stages(board, team, car, *network);
  team.start(iog::hal::kMaxCores);
  time_stages(board, team, car, *network);
  board.console().write("stages timed\n");
  for (;;) {
    board.watchdog().service();
    board.idle();
  }
}
