// vehicle_header CAR.toml HEADER [BLOCK]: the car as a header of constants, and as the block of an
// image. vehicle_header --grids GRIDS BLOCK: a block without a car. A part of the build.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <span>

#include "car_block/car_block.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/vehicle_header/header_text.hpp"
#include "tools/vehicles/car_words.hpp"

namespace {

void write_file(const std::string& path, std::string_view content) {
  std::ofstream out(path, std::ios::binary);
  out << content;
  out.close();
  if (!out) {
    throw iog::tools::UsageError(path + ": cannot be written");
  }
}

void write_block(const std::string& path, auto&& write) {
  std::string block(iog::car_block::kBlockBytes, '\0');
  write(std::as_writable_bytes(std::span<char>(block)).first<iog::car_block::kBlockBytes>());
  write_file(path, block);
}

void write_block_without_car(std::string_view word, const std::string& path) {
  using iog::tools::kGridsWords;
  const auto* const grids = std::ranges::find(kGridsWords, word, &iog::tools::GridsWord::word);
  if (grids == kGridsWords.end()) {
    throw iog::tools::UsageError("no grids '" + std::string(word) + "'");
  }
  write_block(path, [&](iog::car_block::WritableBlock block) {
    iog::car_block::write_block_without_car(grids->value, iog::tools::kUsualNetwork, block);
  });
}

void write_files(const std::string& source, std::span<char* const> targets) {
  const iog::tools::Car car = iog::tools::read_car(source);
  write_file(targets[0], iog::tools::header_of(car, std::filesystem::path(source).filename()));
  if (targets.size() > 1) {
    write_block(targets[1], [&](iog::car_block::WritableBlock block) {
      iog::car_block::write_block(car.vehicle, car.network, block);
    });
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::cerr << "vehicle_header: expected a car's file, a header and perhaps a block\n";
    return iog::tools::kWrongUse;
  }
  try {
    const auto targets = std::span(argv, static_cast<std::size_t>(argc)).subspan(2);
    if (argv[1] == std::string_view("--grids") && targets.size() == 2) {
      write_block_without_car(targets[0], targets[1]);
    } else {
      write_files(argv[1], targets);
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return iog::tools::kWrongUse;
  }
  return iog::tools::kDone;
}
