// The reader of cars' files: TOML that anybody may have written.
#include "tools/vehicles/car_file.hpp"

#include <string>
#include <string_view>

#include "law.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::fuzz {
namespace {

// The file's name, whose stem is the car's.
constexpr const char* kPath = "car.toml";

// What is wrong with it; empty if nothing is.
std::string words_of(std::string_view text) {
  try {
    const tools::Car car = tools::parse_car(text, kPath);
    law(!car.sensors.empty() && car.tables.size() == car.sensors.size(),
        "a car has sensors, each with its tables");
    law(car.vehicle.id != 0, "a car has an identity");
    return {};
  } catch (const tools::UsageError& error) {
    return error.what();
  }
}

}  // namespace

void check(std::span<const std::byte> input) {
  const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
  const std::string words = words_of(text);
  law(words.empty() || words.starts_with(kPath), "a mistake is told with its file");
  law(words == words_of(text), "a file is judged alike twice");
}

}  // namespace iog::fuzz
