// What a grid says of a simulated drive, held against the truth, whatever the size of its cells:
// echoes, and points of the ground half a metre apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "decision/decision.hpp"
#include "lab/experiments/evidential/scene.hpp"
#include "lab/experiments/experiment.hpp"

namespace iog::lab {

// What a grid can say. The thesis names single classes; ours has words for what is not told apart.
enum class Word : std::uint8_t {
  kUnknown,
  kDrivable,
  kNonDrivable,
  kMapped,
  kMoving,
  kStopped,
  kUnmapped,
  kFree,      // on a border of the map
  kStanding,  // stopped or unmapped
  kOpen,      // occupied, not yet known by what
};
inline constexpr std::size_t kWordCount = 10;

// A decision of the thesis: one class, or none. Ours, in any place that the map has a name for.
[[nodiscard]] Word word_of(reference::evidential::Set decision);
[[nodiscard]] Word word_of(decision::Class of, reference::evidential::Set map_classes);

struct TruePoint {
  LocalToWorld::Point at;
  On on = On::kNothing;
  reference::evidential::Set map_classes = 0;
};

// Of a scan that is scored: the truth at the time of each lidar's sweep for echoes, and at the
// scan's end for the ground, of which points of the region within 45 m of the car count, unless
// they are outside of a thing and within 0.2 m of it.
struct TrueScan {
  std::vector<TruePoint> echoes;
  std::vector<TruePoint> ground;
};

[[nodiscard]] TrueScan truth_of(const DriveScan& scan, const tools::Scene& scene,
                                const SceneMap& map, const Region& region);

using WordCounts = std::array<std::array<std::uint64_t, kWordCount>, kOnCount>;
using Speaker = std::function<Word(const TruePoint&)>;

struct Scores {
  WordCounts echoes{};
  WordCounts ground{};

  void add(const TrueScan& truth, const Speaker& say);
};

// `name`_echoes and `name`_ground: what is said of them, by what they are on.
class WordTables {
 public:
  explicit WordTables(const std::string& name);

  void add(const std::string& grid, const Scores& scores) {
    add_rows(grid, scores.echoes, echoes_);
    add_rows(grid, scores.ground, ground_);
  }

  // What was added to it, echoes first.
  [[nodiscard]] Tables take();

 private:
  static constexpr std::array<std::string_view, kOnCount> kOnNames{
      "nothing", "house", "stopped", "beside", "moving car", "moving person", "settling"};

  static void add_rows(const std::string& grid, const WordCounts& counts, Table& table) {
    for (std::size_t on = 0; on < kOnCount; ++on) {
      const auto& of = counts[on];
      table.row(grid, kOnNames[on], of[0], of[1], of[2], of[3], of[4], of[5], of[6], of[7], of[8],
                of[9]);
    }
  }

  Table echoes_;
  Table ground_;
};

}  // namespace iog::lab
