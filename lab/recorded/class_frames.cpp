// The class grids of a capture, frame by frame as the target would send them, for
// lab/recorded/evaluate.py.
//
//   class_frames CAPTURE CAR.toml OUT
//
// Of each frame that has a place, little endian: when its last slice ended (us since 1970, by the
// poses' clock), the window's corner in tiles (a, b) and the car's place (x, y in mm) as five
// int64, then 1024 x 1024 class bytes row by row from the corner. Then, on the terminal, what the
// target says of the run.
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/receive/run_statistics.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "wire/byte_order.hpp"

namespace iog::lab {
namespace {

using tools::UsageError;

void write(const tools::ClassGrid& classes, tools::OutputFile& out) {
  const stream::ClassWindow& window = classes.window;
  for (const std::int64_t word :
       {static_cast<std::int64_t>(window.slices_end_us), std::int64_t{window.slice_ms},
        std::int64_t{window.corner_a}, std::int64_t{window.corner_b},
        std::int64_t{window.pose.x_mm}, std::int64_t{window.pose.y_mm}}) {
    std::array<std::byte, 8> bytes{};
    wire::store_le64(bytes, static_cast<std::uint64_t>(word));
    out.write(bytes);
  }
  out.write(std::as_bytes(std::span(classes.cells)));
}

void run(const std::string& capture_path, const std::string& car_path,
         const std::string& out_path) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::add_vehicle_file(car_path));
  tools::PcapReader capture(capture_path);
  tools::OutputFile out(out_path);
  tools::RunStatistics statistics;
  tools::FrameAssembler assembler([&](tools::GridFrame&& frame) {
    statistics.add(frame);
    if (frame.classes && frame.classes->is_whole() && frame.classes->window.has_place()) {
      write(*frame.classes, out);
    }
  });
  const auto target = std::make_unique<tools::OfflineTarget>(
      *car.vehicle, [&](std::span<const std::byte> message) { assembler.take(message); },
      tools::Stopwatch::kStands);
  while (const std::optional<tools::CapturedDatagram> datagram = capture.next()) {
    if (tools::takes_port(car, datagram->destination.port)) {
      static_cast<void>(target->take(*datagram));
    }
  }
  target->finish();
  assembler.finish();
  out.finish();
  std::cout << statistics.table(false);
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "class_frames: expected a capture, a car's file and a file to write\n";
    return iog::tools::kWrongUse;
  }
  try {
    iog::lab::run(argv[1], argv[2], argv[3]);
  } catch (const iog::tools::UsageError& error) {
    std::cerr << "class_frames: " << error.what() << '\n';
    return iog::tools::kWrongUse;
  }
  return iog::tools::kDone;
}
