#include "tools/map/refusal_text.hpp"

#include <array>
#include <cstddef>

namespace iog::tools {
namespace {

// In the order of map::Refusal.
constexpr std::array<const char*, map::kRefusalCount> kTexts{
    "sound",
    "shorter than a header",
    "longer than 4 MiB",
    "not a map block",
    "of another version",
    "not as long as it says",
    "damaged: its CRC is wrong",
    "something is not zero that has to be",
    "no such source, or a belief of 0",
    "its origin is not on earth",
    "its extent is empty or too large",
    "its accuracy is 0 or too large",
    "its attribution is missing, too long, or controls a terminal",
    "its tables do not fit in it",
    "its features do not lie end to end",
    "a feature is neither building nor road",
    "a feature has more than 65,535 vertices",
    "a ring is too short, or rings do not fill their feature",
    "a feature has a wrong box",
    "a feature reaches beyond the extent",
    "a feature is missing in its buckets, or stands in others"};

}  // namespace

const char* refusal_text(map::Refusal refusal) {
  return kTexts.at(static_cast<std::size_t>(refusal));
}

}  // namespace iog::tools
