#include "tools/image/car_of_image.hpp"

#include <algorithm>
#include <memory>
#include <span>

#include "authentication/cmac.hpp"
#include "car_block/car_block.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/program/printable.hpp"
#include "tools/program/table.hpp"
#include "tools/vehicles/car_words.hpp"
#include "tools/vehicles/grid_words.hpp"
#include "tools/vehicles/key_file.hpp"
#include "tools/vehicles/network_words.hpp"

namespace iog::tools {
namespace {

// A car as the firmware would have it.
struct ReadCar {
  std::unique_ptr<car_block::SensorMemory> memory = std::make_unique<car_block::SensorMemory>();
  vehicle::Vehicle vehicle;
  car_block::Verdict verdict;

  explicit ReadCar(car_block::Block block) {
    const std::optional<car_block::Firmware> firmware = car_block::read_firmware(block);
    const vehicle::Grids grids = firmware ? firmware->grids : vehicle::Grids::kIndexes;
    verdict = car_block::read_car(block, grids, *memory, vehicle);
  }
};

std::string_view words_of_grids(vehicle::Grids grids) {
  switch (grids) {
    case vehicle::Grids::kIndexes:
      return "indexes";
    case vehicle::Grids::kClasses:
      return "classes";
    case vehicle::Grids::kBoth:
      return "indexes and classes";
  }
  return "other grids";
}

std::string words_of_firmware(const car_block::Firmware& firmware) {
  const std::string side = std::to_string(firmware.cells_per_side);
  return side + " x " + side + " cells, in " + std::to_string(firmware.resolution) + " subcells; " +
         std::string(words_of_grids(firmware.grids));
}

// What to build, or what to change in the car.
std::string words_of_way_out(car_block::Firmware firmware, const car_block::Firmware& needed) {
  const std::string grids(word_of(needed.grids));
  const std::string others(word_of(firmware.grids));
  firmware.grids = needed.grids;
  if (firmware != needed) {
    return ". Build image and iog of the same sources";
  }
  return ".\nIts image is build/imx6/board/imx6/images/" + grids +
         "/iogrid.img, made by `cmake --build --preset imx6 --target images-" + grids +
         "`; or let its file say grids = \"" + others + "\"";
}

std::string words_of_network(const net::Config& network) {
  return words_of(network.mac) + ", " + dotted(network.address.value) + "/" +
         std::to_string(network.prefix_bits) + ", to " + dotted(network.peer.value) + ":" +
         std::to_string(network.peer_port) + " from port " + std::to_string(network.source_port) +
         (network.service_instance == 0
              ? ""
              : ", offered as instance " + std::to_string(network.service_instance));
}

// That of ANSI X9.24-1: the first five bytes of the CMAC of a block of zeros. It tells keys apart
// and nothing else about them.
std::string check_value(const authentication::Key& key) {
  const authentication::CmacKey ready(key);
  authentication::Cmac cmac(ready);
  cmac.add(authentication::Block{});
  const authentication::Block whole = cmac.finish();
  std::string words;
  for (const std::byte byte : std::span(whole).first<5>()) {
    words += hex(std::to_integer<std::uint8_t>(byte), 2);
  }
  return words;
}

// As the build makes images for cars of one's own.
bool has_no_car_yet(car_block::Block block) {
  return std::ranges::all_of(
      block.subspan(car_block::kCarRecord.offset, car_block::kRecordHeaderBytes),
      [](std::byte byte) { return byte == std::byte{0}; });
}

std::string words_of_sensor(const vehicle::Sensor& sensor) {
  std::string words(lidar::name_of(sensor.format));
  words += ", UDP " + std::to_string(sensor.udp_port);
  words += sensor.source_ipv4 == 0 ? " from anybody" : " from " + dotted(sensor.source_ipv4);
  words += sensor.is_calibrated ? ", calibrated" : "";
  return row("  " + std::string(sensor.name), words);
}

}  // namespace

void put_car(const CatalogueEntry& car, FirmwareImage& image) {
  const std::optional<car_block::Firmware> firmware = car_block::read_firmware(image.block());
  const car_block::Firmware needed = car_block::firmware_of(car.vehicle->grids);
  if (!firmware) {
    throw UsageError("the image does not say what its firmware takes; build it anew");
  }
  if (*firmware != needed) {
    throw UsageError("the firmware is of another kind than " + std::string(car.vehicle->name) +
                     ": " + words_of_firmware(*firmware) + "; the car needs " +
                     words_of_firmware(needed) + words_of_way_out(*firmware, needed));
  }
  std::vector<std::byte> block(car_block::kBlockBytes);
  const auto bytes = std::span(block).first<car_block::kBlockBytes>();
  car_block::write_block(*car.vehicle, *car.network, bytes);
  if (!car.key_file.empty()) {
    car_block::write_key(read_key_file(std::string(car.key_file)), bytes);
  }
  image.set_block(bytes);
  demand_accepted(image);
}

std::string words_of_image(const FirmwareImage& image) {
  std::string words =
      row("image", std::string(image.kind()) + (image.board().empty() ? "" : " for the ") +
                       std::string(image.board()) + ", block at byte " +
                       std::to_string(image.block_offset()));
  const car_block::Block block = image.block();
  if (const auto firmware = car_block::read_firmware(block)) {
    words += row("firmware", words_of_firmware(*firmware));
  }
  if (const auto network = car_block::read_network(block)) {
    words += row("network", words_of_network(*network));
  }
  if (const auto key = car_block::read_key(block)) {
    words += row("commands", "signed, check value of the key " + check_value(*key));
  }
  const ReadCar car(block);
  if (car.verdict.refusal != car_block::Refusal::kNone) {
    return words;
  }
  words += row("car", std::string(car.vehicle.name) + ", in a stream " + hex(car.vehicle.id));
  words += row_if(car.vehicle.grid != geometry::Grid{}, "  grid", words_of_grid(car.vehicle.grid));
  const window::Extent window = car.vehicle.window.extent;
  words += row_if(window != window::Extent{}, "  window",
                  words_of_window(window, car.vehicle.grid.cell_mm));
  for (const vehicle::Sensor& sensor : car.vehicle.sensors) {
    words += words_of_sensor(sensor);
  }
  return words;
}

void demand_accepted(const FirmwareImage& image) {
  const ReadCar car(image.block());
  if (car.verdict.refusal == car_block::Refusal::kNoRecord && has_no_car_yet(image.block())) {
    const auto firmware = car_block::read_firmware(image.block());
    throw CheckFailed(
        "there is no car in the image yet; `iog image FILE --vehicle-file my_car.toml` puts one "
        "there" +
        (firmware ? ", whose file says grids = \"" + std::string(word_of(firmware->grids)) + '"'
                  : std::string()));
  }
  if (car.verdict.refusal != car_block::Refusal::kNone) {
    throw CheckFailed("the firmware refuses the car: " +
                      printable(std::string(car_block::Words(car.verdict).view())));
  }
}

}  // namespace iog::tools
