// What it takes to send a grid: bytes, and what a bad link or a slow one leaves of it.
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lab/experiments/experiments.hpp"
#include "lab/experiments/fused_drive.hpp"
#include "lab/experiments/stream/serial_rounds.hpp"
#include "lab/experiments/stream/stream_bytes.hpp"
#include "lab/scenarios/lossy_link.hpp"
#include "stream/references.hpp"
#include "tools/simulate/scenes/scene_catalogue.hpp"

namespace iog::lab {
namespace {

using tile_coding::Encoding;

constexpr std::array kEncodings{std::pair(Encoding::kRaw, "raw"),
                                std::pair(Encoding::kRunStarts, "run_starts"),
                                std::pair(Encoding::kRunStartsSince, "run_starts_since")};

constexpr std::uint32_t kSerialBytesPerSecond = 11'520;  // 115,200 baud
constexpr std::uint32_t kQuietFrames = 12;               // at the end of the drive over a bad link
constexpr std::uint64_t kLinkSeeds = 3;

const tools::CatalogueEntry& reference_car() { return tools::find_vehicle(tools::kDefaultVehicle); }

Feed feed_of(std::string_view scene, const Input& input) {
  return feed_of_drive(reference_car(), scene, input.seed, input.seconds);
}

// Sums over frames: what does not depend on how a tile is sent, with what all would take if none
// had a reference, and what was sent by which encoding.
class Weights {
 public:
  // of: what the rows are told apart by, a scene or a recording; suffix: of the tables' names.
  Weights(const std::string& of, const std::string& suffix)
      : frames_("stream_frames" + suffix,
                {of, "frames", "known_tiles", "alone_bytes", "messages", "message_bytes"}),
        sent_("stream_sent" + suffix, {of, "encoding", "tiles", "payload_bytes"}) {}

  void add(const std::string& name, const StreamBytes& bytes) {
    frames_.row(name, bytes.frames, bytes.tiles, bytes.bytes_alone, bytes.messages, bytes.bytes);
    for (const auto& [encoding, words] : kEncodings) {
      sent_.row(name, words, of_encoding(bytes.sent_tiles, encoding),
                of_encoding(bytes.sent_bytes, encoding));
    }
  }

  void move_to(Tables& tables) {
    tables.push_back(std::move(frames_));
    tables.push_back(std::move(sent_));
  }

 private:
  static std::uint64_t of_encoding(
      const std::array<std::uint64_t, tile_coding::kEncodingCount>& values, Encoding encoding) {
    return values.at(static_cast<std::size_t>(encoding));
  }

  Table frames_;
  Table sent_;
};

void weigh_drives(const Input& input, Tables& tables) {
  Weights weights("scene", "");
  for (const char* scene : kDrives) {
    weights.add(scene, weigh_stream(reference_car(), feed_of(scene, input)));
  }
  weights.move_to(tables);
}

void weigh_recordings(const std::vector<Recording>& recordings, Tables& tables) {
  Weights weights("recording", "_recordings");
  for (const Recording& recording : recordings) {
    weights.add(
        std::filesystem::path(recording.pcap).filename().string(),
        weigh_stream(tools::find_vehicle(recording.vehicle), feed_of_recording(recording.pcap)));
  }
  weights.move_to(tables);
}

// The default scene over each kind of link, some times with other chances.
Table bad_link(const Input& input) {
  Table table("stream_bad_link",
              {"harm", "seed", "quiet_from_frame", "max_reference_age_frames", "frames",
               "whole_frames", "shown_tiles", "fresh_tiles", "wrong_tiles",
               "damaged_messages_found", "incomplete_quiet_frames"});
  const SentStream sent =
      sent_stream(messages_of(reference_car(), feed_of(tools::kDefaultScene, input)));
  const std::uint32_t quiet_from = static_cast<std::uint32_t>(sent.frames.size()) - kQuietFrames;
  for (const Harm& harm : kHarms) {
    for (std::uint64_t seed = 1; seed <= kLinkSeeds; ++seed) {
      const LinkTrial trial = try_link(sent, harm, quiet_from, seed);
      table.row(harm.name, seed, quiet_from, stream::kMaxReferenceAge, trial.frames,
                trial.whole_frames, trial.tiles, trial.fresh_tiles, trial.wrong_tiles,
                trial.corrupt_found, trial.incomplete_after);
    }
  }
  return table;
}

std::vector<tools::GridFrame> frames_of(std::string_view scene, const Input& input) {
  return sent_stream(messages_of(reference_car(), feed_of(scene, input))).frames;
}

// Rounds over the whole grid, by the side of the cells that the serial link sends.
Table serial_line(const Input& input) {
  Table table("stream_serial_line",
              {"scene", "cell_mm", "line_bytes_per_second", "rounds", "bytes", "time_us"});
  for (const char* scene : kDrives) {
    for (const auto& [cell_mm, rounds] :
         serial_rounds(frames_of(scene, input), kSerialBytesPerSecond)) {
      table.row(scene, cell_mm, kSerialBytesPerSecond, rounds.rounds, rounds.bytes,
                rounds.last_us - rounds.first_us);
    }
  }
  return table;
}

}  // namespace

Tables stream_of_tiles(const Input& input) {
  Tables tables;
  weigh_drives(input, tables);
  tables.push_back(bad_link(input));
  tables.push_back(serial_line(input));
  if (!input.recordings.empty()) {
    weigh_recordings(input.recordings, tables);
  }
  return tables;
}

}  // namespace iog::lab
