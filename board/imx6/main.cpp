// The firmware: the board, the network it lives in, the vehicle it was built for, and the loop.
#include "app/loop.hpp"
#include "board.hpp"
#include "net/config.hpp"
#include "selected_vehicle.hpp"

namespace {

// The addresses of this box. As they stand they are those of QEMU's user network, whose gateway is
// the PC; give each box of a real network its own. The peer is the only destination that the
// firmware ever sends messages to, and it may replay recordings in the name of the sensors.
constexpr iog::net::Config kNetwork{
    .mac = {{0x02, 0x69, 0x6F, 0x67, 0x00, 0x01}},  // locally administered
    .address = iog::net::ipv4(10, 0, 2, 15),
    .prefix_bits = 24,
    .peer = iog::net::ipv4(10, 0, 2, 2),
    .peer_port = 15'000,
    .source_port = 15'001,
};
static_assert(iog::net::is_valid(kNetwork));

using Platform = iog::app::MachinePlatform<iog::imx6::Board>;
using Pipeline = iog::app::MachinePipeline<iog::imx6::Board>;

}  // namespace

int main() {
  // Static: together they are 6 MB, and the stack is small.
  static iog::imx6::Board board(kNetwork.mac.octets);
  static Platform platform(board, kNetwork);
  static iog::app::SerialSink serial;
  static Pipeline pipeline(iog::vehicles::kVehicle, kNetwork.peer.value, platform,
                           board.clock().now_us(), serial);
  board.print_banner();
  iog::app::run(board, platform, serial, pipeline);
}
