// What it takes to send a grid: bytes, cycles, and what a bad link leaves of it. The thesis sends
// none; its conclusion asks for a smaller grid.
#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "lab/experiments/a9_cycles.hpp"
#include "lab/experiments/sections.hpp"
#include "lab/experiments/serial_rounds.hpp"
#include "lab/experiments/stream_bytes.hpp"
#include "lab/scenarios/lossy_link.hpp"
#include "stream/references.hpp"
#include "tools/simulate/scene_catalogue.hpp"

namespace iog::lab {
namespace {

using tile_coding::Encoding;

// The drives, by the scenes of `iog simulate`, and their names on the page.
constexpr std::array kDrives{std::pair("city", "city"), std::pair("ring_road", "ring road")};

constexpr double kFramesASecond = 25;
constexpr double kPeriodCycles = 1e9 / kFramesASecond;

double of_encoding(const std::array<std::uint64_t, tile_coding::kEncodingCount>& values,
                   Encoding encoding) {
  return static_cast<double>(values.at(static_cast<std::size_t>(encoding)));
}

struct Weighed {
  std::string name;
  StreamBytes bytes;

  [[nodiscard]] double a_frame(double sum) const { return sum / static_cast<double>(bytes.frames); }
  [[nodiscard]] std::string kilobytes(double sum) const { return fixed(a_frame(sum) / 1000, 1); }
};

std::vector<std::string> row_of(const Weighed& weighed) {
  const StreamBytes& bytes = weighed.bytes;
  const double raw = of_encoding(bytes.bytes_by, Encoding::kRaw);
  const auto sent = static_cast<double>(bytes.payload_bytes());
  return {weighed.name,
          grouped(static_cast<double>(bytes.frames)),
          grouped(weighed.a_frame(static_cast<double>(bytes.tiles))),
          weighed.kilobytes(raw),
          weighed.kilobytes(of_encoding(bytes.bytes_by, Encoding::kRunLength)),
          weighed.kilobytes(of_encoding(bytes.bytes_by, Encoding::kQuadtree)),
          weighed.kilobytes(static_cast<double>(bytes.bytes_alone)),
          weighed.kilobytes(sent),
          fixed(raw / sent, 1),
          weighed.kilobytes(static_cast<double>(bytes.bytes)),
          grouped(weighed.a_frame(static_cast<double>(bytes.messages)))};
}

void print_bytes(const std::vector<Weighed>& all, Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(all.size());
  for (const Weighed& weighed : all) {
    rows.push_back(row_of(weighed));
  }
  body.table({"", "frames", "known tiles", "raw, KB", "run length, KB", "quadtree, KB",
              "shortest alone, KB", "as sent, KB", "times below raw", "messages, KB", "messages"},
             rows);
}

void print_choices(const std::vector<Weighed>& all, Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  for (const Weighed& weighed : all) {
    std::vector<std::string> row{weighed.name};
    for (const Encoding encoding :
         {Encoding::kRaw, Encoding::kRunLength, Encoding::kQuadtree, Encoding::kChangedSince}) {
      row.push_back(percent(of_encoding(weighed.bytes.sent_tiles, encoding) /
                                static_cast<double>(weighed.bytes.tiles),
                            1));
    }
    rows.push_back(row);
  }
  body.table({"tiles sent as", "raw", "run length", "quadtree", "changed since"}, rows);
}

std::vector<Weighed> weigh_drives(const TablesInput& input) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  std::vector<Weighed> all;
  all.reserve(kDrives.size());
  for (const auto& [scene, name] : kDrives) {
    all.push_back({name, weigh_stream(car, feed_of_drive(car, scene, input.seed, input.seconds))});
  }
  return all;
}

void describe_bytes(const TablesInput& input, Markdown& body) {
  const std::vector<Weighed> drives = weigh_drives(input);
  body.subheading("Bytes a frame");
  body.paragraph(
      "Mean frames of the simulated drives, by the firmware's code. Payloads of the known tiles if "
      "all were sent by one encoding, by the shortest that stands by itself, and **as sent**: by "
      "the shortest of all, with a reference at most " +
      std::to_string(stream::kMaxReferenceAge) +
      " frames old (docs/spec.md 3.4). *Messages* are whole: SOME/IP, E2E protection, headers and "
      "the frame's end included; UDP, IP and Ethernet are not. A raw grid of all 1,024 tiles is "
      "1,048.6 KB.");
  print_bytes(drives, body);
  print_choices(drives, body);
  const double largest =
      drives.back().a_frame(static_cast<double>(drives.back().bytes.bytes)) * 8 * kFramesASecond;
  body.paragraph(
      "At 25 frames a second the messages of the ring road are " + fixed(largest / 1e6, 1) +
      " Mbit/s, where raw tiles would not fit a link of 100 Mbit/s. No payload is longer "
      "than a raw tile, whatever is in it.");
}

void describe_cycles(Markdown& body) {
  body.subheading("What sending costs");
  body.paragraph(
      "Publishing a mean frame (finding, hashing, encoding, protecting, wrapping and clearing the "
      "known tiles) and the whole frame from its packets on, four LUX, modelled "
      "([a9_model.md](a9_model.md)). *Raw* is what the other sections mean by a whole frame; the "
      "firmware as it is built sends the *shortest*. A CRC-32 over every cell names the grid, a "
      "second one over every message protects it.");
  std::vector<std::vector<std::string>> rows;
  for (const auto& [scene, name] : kDrives) {
    const A9Cycles raw = a9_cycles(scene, 4);
    const A9Cycles shortest = a9_shortest(scene);
    for (const auto* cycles : {&raw, &shortest}) {
      rows.push_back({std::string(name) + (cycles == &raw ? ", raw" : ", shortest"),
                      grouped(cycles->publish.instructions),
                      banded(cycles->publish.cycles * 1e-6, 2) + " ms",
                      banded(hz_of(cycles->whole.cycles), 0) + " Hz",
                      percent(1 - cycles->whole.cycles.nominal / kPeriodCycles, 0)});
    }
  }
  body.table(
      {"", "publish, instructions", "publish", "whole frames a second", "left of 40 ms, nominal"},
      rows);
}

std::vector<tools::GridFrame> frames_of(const TablesInput& input, std::string_view scene) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  SentStream sent =
      sent_stream(messages_of(car, feed_of_drive(car, scene, input.seed, input.seconds)));
  std::vector<tools::GridFrame> frames;
  for (auto& [number, frame] : sent.frames) {
    frames.push_back(std::move(frame));
  }
  return frames;
}

void describe_serial_line(const TablesInput& input, Markdown& body) {
  constexpr std::uint32_t kBytesPerSecond = 11'520;
  body.subheading("The serial line");
  body.paragraph(
      "115,200 baud carry " + grouped(kBytesPerSecond) +
      " bytes a second, far fewer than the frames above have. The line sends three grids side by "
      "side, always of the newest frame (docs/spec.md 3.8): a rough one, of which each cell has "
      "the highest index of 32 by 32, a fine one, of 8 by 8, and the cells themselves. A *round* "
      "is once over the whole grid: nothing that a receiver has of it is older. The frames of the "
      "drive, again and again for a minute:");
  std::vector<std::vector<std::string>> rows;
  for (const auto& [scene, name] : kDrives) {
    for (const auto& [cell_mm, rounds] : serial_rounds(frames_of(input, scene), kBytesPerSecond)) {
      rows.push_back({std::string(name) + ", cells of " + fixed(cell_mm / 1000.0, 1) + " m",
                      grouped(static_cast<double>(rounds.bytes) / rounds.rounds),
                      fixed(rounds.seconds_a_round(), 2)});
    }
  }
  body.table({"", "bytes a round", "seconds a round"}, rows);
}

std::vector<std::string> row_of(const Harm& harm, const SentStream& sent,
                                std::uint32_t quiet_from) {
  constexpr std::uint64_t kSeeds = 3;
  LinkTrial sum;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const LinkTrial trial = try_link(sent, harm, quiet_from, seed);
    sum.frames += trial.frames;
    sum.whole_frames += trial.whole_frames;
    sum.tiles += trial.tiles;
    sum.fresh_tiles += trial.fresh_tiles;
    sum.wrong_tiles += trial.wrong_tiles;
    sum.corrupt_found += trial.corrupt_found;
    sum.incomplete_after = std::max(sum.incomplete_after, trial.incomplete_after);
  }
  return {harm.name,
          percent(static_cast<double>(sum.whole_frames) / static_cast<double>(sum.frames), 0),
          percent(static_cast<double>(sum.fresh_tiles) / static_cast<double>(sum.tiles), 1),
          grouped(static_cast<double>(sum.corrupt_found)),
          grouped(static_cast<double>(sum.wrong_tiles)),
          std::to_string(sum.incomplete_after + 1)};
}

void describe_links(const TablesInput& input, Markdown& body) {
  constexpr std::uint32_t kAfter = 12;  // frames without harm at the end
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  const SentStream sent = sent_stream(
      messages_of(car, feed_of_drive(car, tools::kDefaultScene, input.seed, input.seconds)));
  const std::uint32_t quiet_from = static_cast<std::uint32_t>(sent.frames.size()) - kAfter;
  body.subheading("A bad link");
  body.paragraph(
      "The city drive over a link that does harm to its messages up to frame " +
      std::to_string(quiet_from) +
      " and none from then on, three times with other chances. *Fresh* is the mean share of the "
      "grid that is of the frame shown; the receiver knows how old each other tile is. *Wrong* are "
      "tiles shown that are not those of the frame that they are said to be of, of all frames. "
      "*Complete in* is the first undisturbed frame from which on all are whole, the worst of "
      "three; docs/spec.md promises the eighth.");
  std::vector<std::vector<std::string>> rows;
  rows.reserve(kHarms.size());
  for (const Harm& harm : kHarms) {
    rows.push_back(row_of(harm, sent, quiet_from));
  }
  body.table({"harm to messages", "frames whole", "fresh", "found damaged", "wrong tiles",
              "complete in frame"},
             rows);
}

void describe_recordings(const TablesInput& input, Markdown& body) {
  std::vector<Weighed> all;
  for (const Recording& recording : input.recordings) {
    const std::string name = std::filesystem::path(recording.pcap).filename().string();
    all.push_back({name, weigh_stream(tools::find_vehicle(recording.vehicle),
                                      feed_of_recording(recording.pcap))});
  }
  body.subheading("Bytes a frame of the recordings");
  print_bytes(all, body);
  print_choices(all, body);
}

}  // namespace

Section stream_of_tiles(const TablesInput& input) {
  Section section;
  section.body.heading("The stream: bytes, cycles and bad links");
  section.body.paragraph(
      "A grid leaves the board as tiles of 32 by 32 cells in protected messages (docs/spec.md 3). "
      "The papers send none.");
  describe_bytes(input, section.body);
  describe_cycles(section.body);
  describe_links(input, section.body);
  describe_serial_line(input, section.body);
  if (!input.recordings.empty()) {
    describe_recordings(input, section.body);
  }
  return section;
}

}  // namespace iog::lab
