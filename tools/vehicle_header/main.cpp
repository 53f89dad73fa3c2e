// vehicle_header CAR.toml HEADER [BLOCK]: the car as a header of constants, and as the block of an
// image. A part of the build.
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <span>

#include "car_block/car_block.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/vehicle_header/header_text.hpp"

namespace {

void write_file(const std::string& path, std::string_view content) {
  std::ofstream out(path, std::ios::binary);
  out << content;
  out.close();
  if (!out) {
    throw iog::tools::UsageError(path + ": cannot be written");
  }
}

std::string block_of(const iog::tools::Car& car) {
  std::string block(iog::car_block::kBlockBytes, '\0');
  iog::car_block::write_block(
      car.vehicle, car.network,
      std::as_writable_bytes(std::span(block)).first<iog::car_block::kBlockBytes>());
  return block;
}

void write_files(const std::string& source, std::span<char* const> targets) {
  const iog::tools::Car car = iog::tools::read_car(source);
  write_file(targets[0], iog::tools::header_of(car, std::filesystem::path(source).filename()));
  if (targets.size() > 1) {
    write_file(targets[1], block_of(car));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::cerr << "vehicle_header: expected a car's file, a header and perhaps a block\n";
    return iog::tools::kWrongUse;
  }
  try {
    write_files(argv[1], std::span(argv, static_cast<std::size_t>(argc)).subspan(2));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return iog::tools::kWrongUse;
  }
  return iog::tools::kDone;
}
