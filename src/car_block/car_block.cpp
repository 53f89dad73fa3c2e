#include "car_block/car_block.hpp"

#include <algorithm>

#include "car_block/content.hpp"
#include "car_block/limits.hpp"
#include "geometry/grid.hpp"
#include "vehicle/derived.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::car_block {
namespace {

wire::ByteWriter content_of(WritableBlock block, const RecordPlace& place) {
  return wire::ByteWriter(
      block.subspan(place.offset + kRecordHeaderBytes, place.capacity - kRecordHeaderBytes));
}

void write_firmware(const Firmware& firmware, WritableBlock block) {
  wire::ByteWriter out = content_of(block, kFirmwareRecord);
  out.u16_be(firmware.cell_mm);
  out.u16_be(firmware.cells_per_side);
  out.u16_be(firmware.resolution);
  out.u8(static_cast<std::uint8_t>(firmware.grids));
  out.zeros(1);
  frame_record(block, kFirmwareRecord, out.written().size());
}

void write_network(const net::Config& network, WritableBlock block, const RecordPlace& place) {
  wire::ByteWriter out = content_of(block, place);
  for (const std::uint8_t octet : network.mac.octets) {
    out.u8(octet);
  }
  out.u8(network.prefix_bits);
  out.u8(network.service_instance);
  out.u32_be(network.address.value);
  out.u32_be(network.peer.value);
  out.u16_be(network.peer_port);
  out.u16_be(network.source_port);
  frame_record(block, place, out.written().size());
}

std::optional<net::Config> read_network(Block block, const RecordPlace& place) {
  const Record record = read_record(block, place);
  wire::ByteReader in(record.content);
  net::Config network{};
  for (std::uint8_t& octet : network.mac.octets) {
    octet = in.u8();
  }
  network.prefix_bits = in.u8();
  network.service_instance = in.u8();
  network.address.value = in.u32_be();
  network.peer.value = in.u32_be();
  network.peer_port = in.u16_be();
  network.source_port = in.u16_be();
  return in.ok() && net::is_valid(network) ? std::optional(network) : std::nullopt;
}

std::span<const std::byte> bytes_of(Block block, const RecordPlace& place) {
  return block.subspan(place.offset, place.capacity);
}

// A block without a key, as older builds wrote it, has zeros here.
Refusal refusal_of_key(Block block) {
  const auto is_zero = [](std::byte byte) { return byte == std::byte{0}; };
  if (std::ranges::all_of(bytes_of(block, kKeyRecord), is_zero)) {
    return Refusal::kNone;
  }
  const Record record = read_record(block, kKeyRecord);
  const bool has_key = record.content.size() == authentication::kBlockBytes;
  return record.refusal == Refusal::kNone && !has_key ? Refusal::kWrongLength : record.refusal;
}

// Requires a car within its limits.
void derive(vehicle::Vehicle& car, SensorMemory& memory) {
  vehicle::derive_rules(car.sensors, car.window, car.grid.cell_mm);
  if (car.window.tables != nullptr) {
    ageing::Tables& its = memory.tables;
    its.gains = ageing::make_gains_table(its.accumulation, its.free, its.hit_mass);
  }
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    vehicle::derive_limits(car.footprint, car.z_min, car.z_max, memory.sensors[i]);
  }
}

std::string_view name_of(Part part) {
  switch (part) {
    case Part::kCar:
      return "description: ";
    case Part::kNetwork:
      return "network: ";
    case Part::kKey:
      return "authentication: ";
  }
  return "unknown: ";
}

std::string_view text_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "nothing is wrong";
    case Refusal::kNoRecord:
      return "it is not there";
    case Refusal::kWrongVersion:
      return "it is of another version";
    case Refusal::kWrongLength:
      return "it is longer than its place";
    case Refusal::kDamaged:
      return "it is damaged";
    case Refusal::kNotACar:
      return "its bytes are no description";
    case Refusal::kOtherGrid:
      return "its tables are for another cell or grid size";
    case Refusal::kOtherGrids:
      return "it asks for grids that this firmware has not";
    case Refusal::kLimit:
      return "it breaks a limit: ";
  }
  return "unknown";
}

}  // namespace

void write_key(const authentication::Key& key, WritableBlock block) {
  wire::ByteWriter out = content_of(block, kKeyRecord);
  out.bytes(key);
  frame_record(block, kKeyRecord, out.written().size());
}

std::optional<authentication::Key> read_key(Block block) {
  const Record record = read_record(block, kKeyRecord);
  authentication::Key key{};
  if (record.content.size() != key.size()) {
    return std::nullopt;
  }
  std::ranges::copy(record.content, key.begin());
  return key;
}

Firmware firmware_of(vehicle::Grids grids) {
  return {.cell_mm = geometry::kCellMm,
          .cells_per_side = geometry::kCellsPerSide,
          .resolution = geometry::kResolution,
          .grids = grids};
}

void write_block_without_car(vehicle::Grids grids, const net::Config& network,
                             WritableBlock block) {
  std::ranges::fill(block, std::byte{0});
  write_firmware(firmware_of(grids), block);
  write_network(network, block, kNetworkRecord);
  write_network(network, block, kNetworkCopy);
}

void write_block(const vehicle::Vehicle& vehicle, const net::Config& network, WritableBlock block) {
  write_block_without_car(vehicle.grids, network, block);
  wire::ByteWriter out = content_of(block, kCarRecord);
  write_content(vehicle, [&out](std::uint8_t byte) { out.u8(byte); });
  frame_record(block, kCarRecord, out.written().size());
}

std::optional<Firmware> read_firmware(Block block) {
  const Record record = read_record(block, kFirmwareRecord);
  wire::ByteReader in(record.content);
  Firmware firmware;
  firmware.cell_mm = in.u16_be();
  firmware.cells_per_side = in.u16_be();
  firmware.resolution = in.u16_be();
  firmware.grids = static_cast<vehicle::Grids>(in.u8());
  return in.ok() && firmware.grids <= vehicle::Grids::kBoth ? std::optional(firmware)
                                                            : std::nullopt;
}

std::optional<net::Config> read_network(Block block) {
  const std::optional<net::Config> network = read_network(block, kNetworkRecord);
  return network ? network : read_network(block, kNetworkCopy);
}

Verdict read_car(Block block, vehicle::Grids grids, SensorMemory& memory,
                 vehicle::Vehicle& vehicle) {
  const std::optional<net::Config> network = read_network(block);
  if (!network) {
    return {.refusal = Refusal::kDamaged, .part = Part::kNetwork};
  }
  if (const Refusal refusal = refusal_of_key(block); refusal != Refusal::kNone) {
    return {.refusal = refusal, .part = Part::kKey};
  }
  const Record record = read_record(block, kCarRecord);
  if (record.refusal != Refusal::kNone) {
    return {.refusal = record.refusal};
  }
  if (const Refusal refusal = read_vehicle(record.content, memory, vehicle);
      refusal != Refusal::kNone) {
    return {.refusal = refusal};
  }
  if (vehicle.grids != grids) {
    return {.refusal = Refusal::kOtherGrids};
  }
  if (const vehicle::Fault fault = fault_of(vehicle, *network); !fault.field.empty()) {
    return {.refusal = Refusal::kLimit, .fault = fault};
  }
  derive(vehicle, memory);
  vehicle.id = record.crc;
  return {};
}

Words::Words(const Verdict& verdict) {
  add(name_of(verdict.part));
  add(text_of(verdict.refusal));
  if (verdict.refusal != Refusal::kLimit) {
    return;
  }
  if (verdict.fault.sensor != vehicle::Fault::kCar) {
    add("sensors[");
    add_number(static_cast<std::uint32_t>(verdict.fault.sensor));
    add("].");
  }
  add(verdict.fault.field);
  add(": allowed is ");
  if (verdict.fault.least > 0) {
    add("at least ");
    add_number(verdict.fault.least);
    add(": ");
  }
  add(verdict.fault.allowed);
}

void Words::add(std::string_view text) {
  const std::size_t length = std::min(text.size(), letters_.size() - length_);
  std::copy_n(text.begin(), length, letters_.begin() + static_cast<std::ptrdiff_t>(length_));
  length_ += length;
}

void Words::add_number(std::uint32_t number) {
  std::array<char, 10> digits{};
  std::size_t first = digits.size();
  do {
    digits[--first] = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number > 0);
  add(std::string_view(digits.data(), digits.size()).substr(first));
}

}  // namespace iog::car_block
