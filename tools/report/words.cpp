#include "tools/report/words.hpp"

#include <cmath>
#include <cstdlib>

namespace iog::tools {
namespace {

constexpr unsigned kSectors = 64;

// In -180 ... 180, of the direction in which a sector begins.
std::string degrees_of(unsigned sector) {
  const unsigned within = sector % kSectors;
  const double turn = within < kSectors / 2 ? 0 : 360;
  return std::to_string(std::lround(360.0 * within / kSectors - turn));
}

}  // namespace

std::string words_of_temperature(std::int16_t dc) {
  return (dc < 0 ? "-" : "") + std::to_string(std::abs(dc) / 10) + "." +
         std::to_string(std::abs(dc) % 10) + " degrees Celsius";
}

std::string words_of_sectors(std::uint64_t sectors) {
  const auto is_set = [=](unsigned i) { return (sectors >> i % kSectors & 1U) != 0; };
  if (sectors == 0) {
    return "none";
  }
  if (sectors == ~std::uint64_t{0}) {
    return "all around";
  }
  // From a sector that is watched, once around.
  unsigned begin = 0;
  while (is_set(begin)) {
    ++begin;
  }
  std::string words;
  for (unsigned i = begin; i < begin + kSectors; ++i) {
    if (is_set(i) && !is_set(i + kSectors - 1)) {
      words += (words.empty() ? "" : ", ") + degrees_of(i) + " to ";
    }
    if (is_set(i) && !is_set(i + 1)) {
      words += degrees_of(i + 1);
    }
  }
  return words + " degrees";
}

}  // namespace iog::tools
