// make_car_block [--grids GRIDS] [CAR.toml] BLOCK: the block of an image with this car, which must
// ask for these grids, or without a car. A part of the build.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "car_block/car_block.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/vehicles/car_file.hpp"
#include "tools/vehicles/car_words.hpp"

namespace iog::tools {
namespace {

struct Request {
  std::optional<vehicle::Grids> grids{};
  std::vector<std::string> paths{};  // of the car, if there is one, and of the block
};

vehicle::Grids grids_of(std::string_view word) {
  const auto* const grids = std::ranges::find(kGridsWords, word, &GridsWord::word);
  if (grids == kGridsWords.end()) {
    throw UsageError("no grids '" + std::string(word) + "'");
  }
  return grids->value;
}

Request request_of(std::span<char* const> words) {
  Request request;
  if (words.size() > 2 && words[0] == std::string_view("--grids")) {
    request.grids = grids_of(words[1]);
    words = words.subspan(2);
  }
  request.paths.assign(words.begin(), words.end());
  const bool has_car = request.paths.size() == 2;
  if (!has_car && !(request.grids && request.paths.size() == 1)) {
    throw UsageError("expected [--grids GRIDS] [CAR.toml] BLOCK");
  }
  return request;
}

void fill(const Request& request, car_block::WritableBlock block) {
  if (request.paths.size() == 1) {
    car_block::write_block_without_car(*request.grids, kUsualNetwork, block);
    return;
  }
  const Car car = read_car(request.paths[0]);
  if (std::filesystem::path(request.paths[0]).stem() != car.description.name) {
    throw UsageError(request.paths[0] +
                     ": `name` must be the file's name, by which the build finds the car");
  }
  if (request.grids && *request.grids != car.vehicle.grids) {
    throw UsageError(request.paths[0] + ": its grids are not " +
                     std::string(word_of(*request.grids)));
  }
  if (!car.key_file.empty()) {
    throw UsageError(request.paths[0] +
                     ": a key is no part of a build; `iog image` puts the car into an image");
  }
  car_block::write_block(car.vehicle, car.network, block);
}

void make(const Request& request) {
  std::string block(car_block::kBlockBytes, '\0');
  fill(request, std::as_writable_bytes(std::span(block)).first<car_block::kBlockBytes>());
  std::ofstream out(request.paths.back(), std::ios::binary);
  out << block;
  out.close();
  if (!out) {
    throw UsageError(request.paths.back() + ": cannot be written");
  }
}

}  // namespace
}  // namespace iog::tools

int main(int argc, char** argv) {
  try {
    iog::tools::make(
        iog::tools::request_of(std::span(argv, static_cast<std::size_t>(argc)).subspan(1)));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return iog::tools::kWrongUse;
  }
  return iog::tools::kDone;
}
