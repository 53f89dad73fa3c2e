// What the page shows in words and charts, as JSON.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "tools/frames/frame_assembler.hpp"
#include "tools/frames/live_classes.hpp"
#include "tools/frames/live_grid.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "tools/view/recorder.hpp"
#include "tools/view/stream_health.hpp"

namespace iog::tools::view {

using SlicesByCause = std::array<std::uint32_t, pose::kCauseCount>;

// Of the classes of the frame that is shown.
struct ClassFacts {
  stream::ClassWindow window{};
  std::optional<stream::ClassEnd> end{};
  SlicesByCause not_placed{};  // slices since the frame before that had no place; kNone: 0
  bool is_whole = false;
  bool is_damaged = false;
  std::size_t missing_tiles = 0;
  std::size_t stale_tiles = 0;
  std::size_t known_tiles = 0;
  std::uint16_t cell_mm = geometry::kCellMm;
  window::Extent extent{};
};

// before: the facts of the frame before, null if there was none.
[[nodiscard]] ClassFacts class_facts_of(const ClassGrid& frame, const LiveClasses& classes,
                                        const ClassFacts* before);

// Of the objects of the frame that is shown: what had no room since the frame before.
struct ObjectFacts {
  std::uint16_t tracks_refused = 0;
  std::uint16_t hits_left = 0;
};

// Of the frame that is shown.
struct FrameFacts {
  std::uint32_t number = 0;
  std::uint64_t message_bytes = 0;  // that came since the frame before was complete
  bool is_whole = false;            // everything has arrived
  bool is_damaged = false;          // and it is not the grid that the target has hashed
  std::size_t missing_tiles = 0;
  std::size_t stale_tiles = 0;
  std::size_t known_tiles = 0;
  geometry::Grid grid{};
  stream::Header header{};
  std::optional<stream::FrameEnd> end{};
  std::optional<ClassFacts> classes{};
  std::optional<ObjectFacts> objects{};  // if its list has come
};

[[nodiscard]] FrameFacts facts_of(const GridFrame& frame, const LiveGrid& grid,
                                  std::uint64_t message_bytes);

// How far a recording has been played.
struct Playback {
  std::uint64_t place_ms = 0;
  std::uint64_t span_ms = 0;
};

// What there is to say at one moment. Whatever it refers to lives that long.
struct StatusParts {
  const StreamHealth* health;
  const FrameAssembler* assembler;
  const Recorder* recorder;
  const std::optional<FrameFacts>* frame;
  std::string source;                  // such as "UDP 127.0.0.1:15000"
  std::string kind;                    // Source::kind()
  std::string block;                   // of the map of this PC, its CRC; empty: none
  std::string problem;                 // of the last request of the page; empty: none
  std::optional<Playback> playback{};  // of a recording
  std::uint64_t overflow = 0;          // messages that this PC dropped
  std::int64_t now_ms = 0;
};

[[nodiscard]] std::string status_json(const StatusParts& parts);

// Mounts, fields of view, footprint. Of a car that is not known: its name says so, and nothing is
// in it.
[[nodiscard]] std::string vehicle_json(std::uint32_t vehicle_id, std::optional<double> epsilon);

}  // namespace iog::tools::view
