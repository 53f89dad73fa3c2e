// How well things with a speed are told on simulated drives in which everything moves.
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "lab/experiments/experiments.hpp"
#include "lab/experiments/objects/object_frame.hpp"
#include "tools/formats/capture/made_capture.hpp"

namespace iog::lab {
namespace {

constexpr std::array kDefaultRule{PerceptionRule{"default"}};

struct ScoredObjects {
  ObjectScorer scorer{};
  std::uint64_t tracks = 0;  // of all frames
  std::uint64_t most_tracks = 0;
  objects::FrameCounts left{};  // likewise; it is added up
};

ScoredObjects score_objects(const PerceivedDrive& drive) {
  ScoredObjects scored;
  LocalToWorld to_world;
  perceive_drive(drive, kDefaultRule, [&](const PerceivedFrame& frame) {
    const FrameTruth truth(frame, to_world);
    to_world = truth.last().to_world;
    const objects::Tracker& tracker = *frame.objects.front();
    if (frame.end->slice_count > 0) {
      scored.scorer.add(object_frame(frame, truth, tracker));
    }
    const auto tracks = static_cast<std::uint64_t>(
        std::ranges::count_if(tracker.tracks(), &objects::Track::is_there));
    scored.tracks += tracks;
    scored.most_tracks = std::max(scored.most_tracks, tracks);
    scored.left.hits.beyond += frame.engine->object_counts().hits.beyond;
    scored.left.tracks_refused += frame.engine->object_counts().tracks_refused;
  });
  return scored;
}

// The least of these that an error is below: steps of 1 cm/s up to 1 m/s, of 10 up to 10 m/s, of
// 1 m/s from there on. In cm/s.
std::uint32_t bound_of(double metres_a_second) {
  const double exact = 100 * metres_a_second;
  const std::uint32_t step = exact < 100 ? 1 : exact < 1000 ? 10 : 100;
  return (static_cast<std::uint32_t>(exact) / step + 1) * step;
}

std::int64_t in_ms(std::uint64_t us) { return static_cast<std::int64_t>(us / 1000); }

class ObjectTables {
 public:
  explicit ObjectTables(const std::string& name)
      : drives_(name + "_drives", {"scene", "seed", "frames", "movers", "reported", "wrong",
                                   "gospa_place_m", "gospa_missed", "gospa_wrong", "tracks",
                                   "most_tracks", "hits_left", "tracks_refused"}),
        views_(name + "_views",
               {"scene", "seed", "thing", "what", "first_ms", "lasted_ms", "seen_ms", "frames",
                "told_frames", "late_frames", "late_told_frames", "delay_ms", "other_ids",
                "velocities", "squared_errors_m2_s2", "within_two_deviations"}),
        errors_(name + "_errors", {"scene", "seed", "what", "below_cm_s", "velocities"}) {}

  void add(const PerceivedDrive& drive, const ScoredObjects& scored) {
    const ObjectTotals& totals = scored.scorer.totals();
    drives_.row(drive.scene, drive.seed, totals.frames, totals.movers, totals.reported,
                totals.wrong, totals.gospa.place_m, totals.gospa.missed, totals.gospa.wrong,
                scored.tracks, scored.most_tracks, scored.left.hits.beyond,
                scored.left.tracks_refused);
    std::map<std::pair<bool, std::uint32_t>, std::uint64_t> errors;
    for (const View& view : scored.scorer.views()) {
      add_view(drive, view);
      for (const VelocityError& error : view.errors) {
        ++errors[{view.is_person, bound_of(error.metres_a_second)}];
      }
    }
    for (const auto& [key, count] : errors) {
      errors_.row(drive.scene, drive.seed, what(key.first), key.second, count);
    }
  }

  [[nodiscard]] Tables take() {
    return {std::move(drives_), std::move(views_), std::move(errors_)};
  }

 private:
  static std::string_view what(bool is_person) { return is_person ? "person" : "car"; }

  void add_view(const PerceivedDrive& drive, const View& view) {
    double squared = 0;
    std::size_t within = 0;
    for (const VelocityError& error : view.errors) {
      squared += error.metres_a_second * error.metres_a_second;
      within += error.is_within_two_deviations ? 1U : 0U;
    }
    views_.row(drive.scene, drive.seed, view.thing, what(view.is_person),
               in_ms(view.first_us - tools::kDriveStartUs), in_ms(view.last_us - view.first_us),
               in_ms(view.seen_us), view.frames, view.told, view.late_frames, view.late_told,
               view.delay_us ? in_ms(*view.delay_us) : -1, view.other_ids, view.errors.size(),
               squared, within);
  }

  Table drives_;
  Table views_;
  Table errors_;
};

Tables score_scenes(const std::string& name, std::span<const std::string_view> scenes,
                    std::uint32_t seconds) {
  ObjectTables tables(name);
  for (const std::string_view scene : scenes) {
    for (const std::uint64_t seed : kCleanSeeds) {
      const PerceivedDrive drive{
          .scene = scene, .seed = seed, .seconds = seconds, .has_evidence = false};
      tables.add(drive, score_objects(drive));
    }
  }
  return tables.take();
}

}  // namespace

Tables objects_roads(const Input& /*input*/) {
  return score_scenes("objects", std::array<std::string_view, 2>{"city", "ring_road"},
                      kRoadSeconds);
}

Tables objects_street(const Input& /*input*/) {
  return score_scenes("objects_street", std::array<std::string_view, 1>{"street"}, kStreetSeconds);
}

}  // namespace iog::lab
