// The class grids of a capture, frame by frame as the target would send them, for
// lab/recorded/evaluate.py.
//
//   class_frames CAPTURE CAR.toml OUT [MOVING.csv]
//
// Of each frame that has a place, little endian: when its last slice ended (us since 1970, by the
// poses' clock), the window's corner in tiles (a, b) and the car's place (x, y in mm) as five
// int64, then 1024 x 1024 class bytes row by row from the corner. Into MOVING.csv goes a line for
// each object of a frame that moves: its place and velocity. Then, on the terminal, what the target
// says of the run.
#include <array>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

#include "stream/objects.hpp"
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

void write_moving(const stream::ObjectList& list, tools::OutputFile& out) {
  for (const stream::ObjectRecord& object : list.all()) {
    if (object.state == stream::ObjectState::kMoves) {
      std::ostringstream line;
      line << list.time_us << ',' << object.id << ',' << object.x_mm << ',' << object.y_mm << ','
           << object.vx_cm_s << ',' << object.vy_cm_s << '\n';
      out.write(std::string_view(line.str()));
    }
  }
}

void run(const std::string& capture_path, const std::string& car_path, const std::string& out_path,
         const char* moving_path) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::add_vehicle_file(car_path));
  if (car.vehicle->grid.cell_mm != geometry::kUsualCellMm) {
    throw UsageError(car_path + ": grid.cell_m: recorded drives are scored in cells of 0.1 m");
  }
  tools::PcapReader capture(capture_path);
  tools::OutputFile out(out_path);
  std::optional<tools::OutputFile> moving;
  if (moving_path != nullptr) {
    moving.emplace(moving_path);
    moving->write(std::string_view("time_us,id,x_mm,y_mm,vx_cm_s,vy_cm_s\n"));
  }
  tools::RunStatistics statistics;
  tools::FrameAssembler assembler([&](tools::GridFrame&& frame) {
    statistics.add(frame);
    if (frame.classes && frame.classes->is_whole() && frame.classes->window.has_place()) {
      write(*frame.classes, out);
    }
    if (moving && frame.knows_objects()) {
      write_moving(*frame.objects, *moving);
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
  if (moving) {
    moving->finish();
  }
  std::cout << statistics.table(false);
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    std::cerr << "class_frames: expected a capture, a car's file and one or two files to write\n";
    return iog::tools::kWrongUse;
  }
  try {
    iog::lab::run(argv[1], argv[2], argv[3], argc == 5 ? argv[4] : nullptr);
  } catch (const iog::tools::UsageError& error) {
    std::cerr << "class_frames: " << error.what() << '\n';
    return iog::tools::kWrongUse;
  }
  return iog::tools::kDone;
}
