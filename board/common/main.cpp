// The firmware: the board, the car of its image with the network it lives in, and the loop.
#include "app/fragment_senders.hpp"
#include "app/loop.hpp"
#include "app/refused_car.hpp"
#include "baked_map.hpp"
#include "board.hpp"
#include "car_block/car_block.hpp"
#include "car_of_image.hpp"
#include "constant_memory.hpp"
#include "core_count.hpp"
#include "firmware_grids.hpp"
#include "health/guard.hpp"
#include "health/memory_check.hpp"
#include "net/config.hpp"
#include "text_line.hpp"

namespace {

namespace car_block = iog::car_block;
using iog::board::Board;
using iog::board::kGrids;
using iog::board::TextLine;
using Platform = iog::app::MachinePlatform<Board>;
using Pipeline = iog::app::MachinePipeline<Board, kGrids>;

// The fuses' address, if there is one, in the place of the description's.
iog::net::Config with_mac(iog::net::Config network, const iog::board::MacAddress& address) {
  network.mac.octets = address;
  return network;
}

void print_car(Board& board, const iog::vehicle::Vehicle& car, const iog::net::Config& network) {
  TextLine line;
  line.text("car ").text(car.name).text(" ").hex(car.id).text(", ");
  for (int shift = 24; shift >= 0; shift -= 8) {
    line.decimal(network.address.value >> shift & 0xFFU).text(shift > 0 ? "." : "\n");
  }
  board.console().write(line.view());
}

// No grid without a car. The peer is told, if the network at least is known.
[[noreturn]] void refuse(Board& board, const std::optional<iog::net::Config>& network,
                         const car_block::Verdict& verdict) {
  static const car_block::Words words(verdict);
  TextLine line;
  line.text("CAR REFUSED: ").text(words.view()).text("\n");
  board.console().write(line.view());
  if (!network) {
    iog::app::run_mute(board);
  }
  static Platform platform(board, with_mac(*network, board.mac_address()));
  iog::app::run_refused(
      board, platform,
      {.reason = static_cast<std::uint8_t>(verdict.refusal), .words = words.view()});
}

// Of a car that has a key.
std::optional<iog::app::SignedCommands> signed_commands(Board& board, car_block::Block block,
                                                        const iog::vehicle::Vehicle& car,
                                                        const iog::net::Config& network) {
  const auto key = car_block::read_key(block);
  if (!key) {
    return std::nullopt;
  }
  board.console().write("poses and maps have to be signed\n");
  return iog::app::SignedCommands{
      .key = *key, .vehicle = &car, .replayer_ipv4 = network.peer.value};
}

// All of it once, before anything is made with it. Memory that is not what it should be ends the
// run: what is wrong with it may be wrong with anything.
void look_at_all(Board& board, const iog::board::ConstantMemory& memory) {
  if (const auto changed = iog::health::MemoryCheck(memory.regions()).look_at_all()) {
    board.end_run(
        {.cause = iog::hal::EndCause::kMemory, .detail = static_cast<std::uint32_t>(*changed)},
        memory.regions()[*changed].name);
  }
}

}  // namespace

int main() {
  // Static: together they are up to 131 MB, and the stack is small.
  static car_block::SensorMemory sensors;
  static iog::vehicle::Vehicle car;
  const car_block::Block block = iog::board::car_of_image();
  const std::optional<iog::net::Config> network = car_block::read_network(block);
  const car_block::Verdict verdict = car_block::read_car(block, kGrids, sensors, car);
  static Board board(network ? network->mac.octets : iog::board::MacAddress{});
  board.print_banner();
  static iog::board::ConstantMemory constants(board.translation_tables(), board.ring_guards());
  constants.add("the car's sensors", std::as_bytes(std::span(&sensors, 1)));
  constants.add("the car", std::as_bytes(std::span(&car, 1)));
  look_at_all(board, constants);
  if (verdict.refusal != car_block::Refusal::kNone) {
    refuse(board, network, verdict);
  }
  print_car(board, car, *network);
  if (network->service_instance != 0) {
    board.ethernet().join(iog::net::kDiscoveryGroupMac.octets);
  }
  static Platform platform(board, with_mac(*network, board.mac_address()), iog::board::kCores,
                           signed_commands(board, block, car, *network));
  static iog::net::Reassembly fragments(iog::app::fragment_senders(car, network->peer));
  platform.host().join_fragments(fragments);
  static iog::serial::GridSender serial;
  serial.describe(car.grid);
  // The peer is the only destination that the firmware ever sends messages to, and it may replay
  // recordings in the name of the sensors.
  static Pipeline pipeline(car, network->peer.value, platform, serial);
  if (const auto map = iog::board::map_of_image(); !map.empty()) {
    pipeline.begin_with_map(map);
  }
  pipeline.for_each_guard(
      [](iog::health::Guard& guard) { constants.add("a guard of the grids", guard); });
  const auto add_setting = [](std::span<const std::byte> bytes) {
    constants.add("a setting of the program", bytes);
  };
  platform.for_each_constant(add_setting);
  pipeline.for_each_constant(add_setting);
  static iog::health::MemoryCheck check(constants.regions());
  iog::app::run(board, platform, serial, check, pipeline);
}
