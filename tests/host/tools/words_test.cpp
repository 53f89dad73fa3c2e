// What the programs of the PC say when something is wrong: words that say what to do about it.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "drive_sample.hpp"
#include "fakes/from_hex.hpp"
#include "fakes/real_velodyne_packets.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/formats/mcap/writer.hpp"
#include "tools/formats/picture/canvas.hpp"
#include "tools/identity/capture_identity.hpp"
#include "tools/info/file_summary.hpp"
#include "tools/program/file.hpp"
#include "tools/program/progress.hpp"
#include "tools/program/word_distance.hpp"
#include "tools/receive/run_statistics.hpp"
#include "tools/receive/udp_receiver.hpp"

namespace iog::tools {
namespace {

// What the action complains of; empty: nothing.
template <typename Action>
std::string complaint_of(Action&& action) {
  try {
    action();
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(Words, AgreeWithTheirNumber) {
  constexpr std::string_view kWords = "point|points, which is|are behind it|them: not sent";
  EXPECT_EQ(counted(1, kWords), "1 point, which is behind it: not sent");
  EXPECT_EQ(counted(0, kWords), "0 points, which are behind them: not sent");
  EXPECT_EQ(counted(2, "cloud|clouds"), "2 clouds");
  EXPECT_EQ(counted(1, "of 2 in "), "1 of 2 in ");
}

// Counted by hand.
TEST(WordDistance, CountsLettersThatHaveToChange) {
  EXPECT_EQ(word_distance("record", "record"), 0U);
  EXPECT_EQ(word_distance("recrod", "record"), 1U);  // exchanged
  EXPECT_EQ(word_distance("recor", "record"), 1U);
  EXPECT_EQ(word_distance("records", "record"), 1U);
  EXPECT_EQ(word_distance("rekord", "record"), 1U);
  EXPECT_EQ(word_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(word_distance("", "abc"), 3U);
  EXPECT_EQ(word_distance("abc", ""), 3U);
}

TEST(WordDistance, OnlyWhatIsNearIsMeant) {
  const std::vector<std::string> known{"simulate", "fuse", "receive", "record", "view"};
  using Words = std::vector<std::string>;
  EXPECT_EQ(nearest_words("recrod", known), Words{"record"});
  EXPECT_EQ(nearest_words("sim", known), Words{"simulate"});
  EXPECT_EQ(nearest_words("rec", known), (Words{"receive", "record"}));
  EXPECT_EQ(nearest_words("fsue", known), Words{"fuse"});
  EXPECT_EQ(nearest_words("nonsense", known), Words{});
  EXPECT_EQ(nearest_words("", known), Words{});
}

TEST(VehicleFit, NamesNoVehicleWhereNothingIsKnown) {
  const tests::TemporaryFolder folder;
  const CatalogueEntry& car = find_vehicle("reference_car");
  const std::string empty = folder / "empty.pcap";
  PcapWriter(empty).finish();
  EXPECT_TRUE(
      contains(complaint_of([&] { demand_fit({empty}, car); }), "it holds no whole UDP packet"));
  const std::string strange = folder / "strange.pcap";
  PcapWriter capture(strange);
  capture.write({.time_us = 1, .source = {1, 1}, .destination = {2, 5000}, .payload = {}});
  capture.finish();
  EXPECT_TRUE(contains(complaint_of([&] { demand_fit({strange}, car); }),
                       "its packets go to port 5000, of no lidar that iog knows"));
  const std::string poses = folder / "poses.pcap";
  PcapWriter of_poses(poses);
  of_poses.write({.time_us = 1, .source = {1, 1}, .destination = {2, 15010}, .payload = {}});
  of_poses.finish();
  EXPECT_TRUE(
      contains(complaint_of([&] { demand_fit({poses}, car); }), "all its whole packets are poses"));
}

TEST(VehicleFit, ACaptureOfTheVehicleFitsAndThatOfAnotherIsNamed) {
  const tests::TemporaryFolder folder;
  const CatalogueEntry& car = find_vehicle("reference_car");
  const std::string path = folder / "drive.pcap";
  PcapWriter capture(path);
  for (const CapturedDatagram& datagram : sample_drive(car, 1, 1)) {
    capture.write(datagram);
  }
  capture.finish();
  EXPECT_EQ(complaint_of([&] { demand_fit({path}, car); }), "");
  EXPECT_TRUE(contains(
      complaint_of([&] { demand_fit({path}, find_vehicle("roof_vlp16")); }),
      path + ": no packet is for a sensor of roof_vlp16 (Velodyne VLP-16; UDP port 2368); UDP "
             "port 12002 receives an ibeo LUX"));
  EXPECT_TRUE(complaint_of([&] {
                demand_fit({path}, find_vehicle("roof_vlp16"));
              }).ends_with("try --vehicle reference_car"));
}

// Packets of a real HDL-32E to the port that roof_vlp16 has, too.
TEST(VehicleFit, AnotherUnitIsNamedAndSoIsADoubt) {
  const tests::TemporaryFolder folder;
  const auto written = [&](const std::string& name, const std::vector<std::string_view>& packets) {
    PcapWriter capture(folder / name);
    for (const std::string_view hex : packets) {
      capture.write({.time_us = 1,
                     .source = {1, 2'368},
                     .destination = {2, 2'368},
                     .payload = tests::from_hex(hex)});
    }
    capture.finish();
    return folder / name;
  };
  const std::string two = written("two.pcap", {tests::kHdl32eFirst, tests::kHdl32eSecond});
  EXPECT_EQ(complaint_of([&] { demand_fit({two}, find_vehicle("roof_hdl32e")); }), "");
  EXPECT_EQ(complaint_of([&] { demand_fit({two}, find_vehicle("roof_vlp16")); }),
            two +
                ": UDP port 2368 receives a Velodyne HDL-32E, but sensor roof of "
                "roof_vlp16 is a Velodyne VLP-16: try --vehicle roof_hdl32e");
  const std::string one = written("one.pcap", {tests::kHdl32eFirst});
  for (const char* const car : {"roof_hdl32e", "roof_vlp16"}) {
    EXPECT_TRUE(contains(complaint_of([&] { demand_fit({one}, find_vehicle(car)); }),
                         "receives a Velodyne HDL-32E or Velodyne VLP-16, but sensor roof of"));
  }
  EXPECT_TRUE(contains(summary_of_capture(two), "Velodyne HDL-32E        2 "));
  EXPECT_TRUE(contains(summary_of_capture(one), "Velodyne HDL-32E or Velodyne VLP-16"));
}

// The system's words, which are those of strerror().
TEST(File, SaysWhyItCannotBeReadOrWritten) {
  const std::string nowhere = "/nowhere/file";
  const std::string reason = ": No such file or directory";
  EXPECT_EQ(complaint_of([&] { static_cast<void>(read_file(nowhere)); }),
            nowhere + ": cannot be read" + reason);
  EXPECT_EQ(complaint_of([&] { static_cast<void>(read_lines(nowhere)); }),
            nowhere + ": cannot be read" + reason);
  EXPECT_EQ(complaint_of([&] { OutputFile{nowhere}; }), nowhere + ": cannot be written" + reason);
  EXPECT_EQ(complaint_of([&] { mcap::Writer(nowhere, "", mcap::Compression::kNone); }),
            nowhere + ": cannot be written" + reason);
  const tests::TemporaryFolder folder;
  EXPECT_EQ(complaint_of([&] { static_cast<void>(read_file(folder.path())); }),
            folder.path() + ": cannot be read: it is a folder");
}

// Also through a link, which stays.
TEST(File, AnUnfinishedOneLeavesWhatWasThere) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "out.txt";
  const std::string link = folder / "link.txt";
  const auto write = [](const std::string& name, bool finishes) {
    OutputFile file(name);
    file.write(finishes ? "whole" : "half");
    if (finishes) {
      file.finish();
    }
  };
  write(path, true);
  std::filesystem::create_symlink(path, link);
  for (const std::string& name : {path, link, folder / "new.txt"}) {
    write(name, false);
    EXPECT_EQ(read_lines(path), std::vector<std::string>{"whole"});
    const std::filesystem::directory_iterator all(std::filesystem::path(path).parent_path());
    EXPECT_EQ(std::distance(begin(all), end(all)), 2) << name;
  }
  write(link, true);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

// libpng itself would remove what it cannot write to: of root, the device.
TEST(File, APictureDoesNotRemoveWhereItCannotBeWritten) {
  const tests::TemporaryFolder folder;
  const std::string link = folder / "full.png";
  std::filesystem::create_symlink("/dev/full", link);
  EXPECT_TRUE(contains(complaint_of([&] {
                         Canvas(2, 2, {0, 0, 0}).write_png(link);
                       }),
                       "full.png: not written completely: No space left on device"));
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

TEST(File, SaysThatTheDiskIsFull) {
  const std::string full = "/dev/full";
  const std::string reason = "No space left on device";
  EXPECT_TRUE(contains(complaint_of([&] {
                         OutputFile file(full);
                         file.write("words");
                         file.finish();
                       }),
                       reason));
  EXPECT_TRUE(contains(complaint_of([&] {
                         PcapWriter file(full);
                         file.finish();
                       }),
                       reason));
  EXPECT_TRUE(contains(complaint_of([&] {
                         mcap::Writer file(full, "", mcap::Compression::kNone);
                         file.finish("", {});
                       }),
                       reason));
}

TEST(RunTable, SaysHowMuchIsGroundOnceAnythingIs) {
  GridFrame frame;
  frame.has_end = true;
  const auto set = [&](vehicle::Fate fate, std::uint32_t count) {
    frame.end.fates[static_cast<std::size_t>(fate)] = count;
  };
  set(vehicle::Fate::kUsed, 300);
  set(vehicle::Fate::kNoReturn, 5'000);
  RunStatistics flat;
  flat.add(frame);
  EXPECT_EQ(flat.table(false).find("over the ground"), std::string::npos);
  set(vehicle::Fate::kGround, 600);
  set(vehicle::Fate::kOverhang, 98);
  set(vehicle::Fate::kUnderGround, 2);
  RunStatistics following;
  following.add(frame);
  EXPECT_NE(following.table(false).find("60.0 % ground, 9.8 % overhang, 0.2 % under the ground\n"),
            std::string::npos);
  EXPECT_EQ(following.table(false).find("MOUNT?"), std::string::npos);
  // Of a VLP-16 that looks down by 12 degrees and by its car's file up, 7.7 % were.
  set(vehicle::Fate::kUnderGround, 30);
  RunStatistics wrong;
  wrong.add(frame);
  EXPECT_NE(wrong.table(false).find("MOUNT?"), std::string::npos);
}

TEST(RunTable, SaysTheGridIfItIsNotTheUsualOne) {
  const auto table_of = [](const geometry::Grid& grid, std::uint16_t class_cell_mm) {
    GridFrame frame;
    frame.header.complete_sensors = 1;
    frame.shape = grid;
    frame.classes.emplace().cell_mm = class_cell_mm;
    RunStatistics statistics;
    statistics.add(frame);
    return statistics.table(false);
  };
  const std::string ahead = table_of(
      {.cell_mm = 50, .columns = 512, .rows = 320, .origin_column = 64, .origin_row = 160}, 500);
  EXPECT_TRUE(contains(ahead,
                       "grid                  512 x 320 cells of 0.05 m: 22.4 m ahead, 3.2 m "
                       "behind, 8 m left, 8 m right\n"))
      << ahead;
  EXPECT_TRUE(contains(ahead, "class window          1024 x 1024 cells of 50 cm\n")) << ahead;
  GridFrame frame;
  frame.classes.emplace().extent = {.columns = 12, .rows = 20};
  RunStatistics statistics;
  statistics.add(frame);
  EXPECT_TRUE(
      contains(statistics.table(false), "class window          384 x 640 cells of 10 cm\n"));
  const std::string usual = table_of({}, 100);
  EXPECT_FALSE(contains(usual, "\ngrid ") || contains(usual, "class window")) << usual;
}

// The frames that a target closes behind the last scan of a capture have no packets. Silence is
// longer.
TEST(Statistics, EmptyFramesAtTheEndAreNoBlindness) {
  GridFrame frame;
  frame.has_end = true;
  RunStatistics statistics;
  const auto add = [&](std::uint64_t unwatched) {
    frame.end.unwatched = unwatched;
    statistics.add(frame);
    return statistics.table(false);
  };
  constexpr std::uint64_t kAhead = 0xF000'0000'0000'000F;
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  EXPECT_NE(add(kAll).find("unwatched at the end  all around\n"), std::string::npos);
  frame.header.complete_sensors = 1;
  EXPECT_NE(add(kAhead).find("unwatched at the end  -23 to 23 degrees\n"), std::string::npos);
  EXPECT_NE(add(kAhead).find("unwatched at the end  -23 to 23 degrees\n"), std::string::npos);
  frame.header.complete_sensors = 0;
  for (int i = 0; i < 4; ++i) {
    EXPECT_NE(add(kAll).find("unwatched at the end  -23 to 23 degrees\n"), std::string::npos) << i;
  }
  EXPECT_NE(add(kAll).find("unwatched at the end  -23 to 23 degrees\n"), std::string::npos);
  EXPECT_NE(add(kAll).find("unwatched at the end  all around\n"), std::string::npos);
}

TEST(Silence, SaysWhatWasWaitedForAndWhatToLookAt) {
  const std::string here = words_of_silence("127.0.0.1", 15000, std::chrono::seconds(3));
  EXPECT_TRUE(here.starts_with("nothing came to UDP 127.0.0.1:15000 in 3.0 s. Does")) << here;
  EXPECT_TRUE(contains(here, "--bind 0.0.0.0")) << here;
  const std::string all =
      words_of_silence("0.0.0.0", 15000, std::chrono::seconds(3), ", and nothing is written");
  EXPECT_TRUE(contains(all, "in 3.0 s, and nothing is written. Does")) << all;
  EXPECT_FALSE(contains(all, "--bind")) << all;
}

// What is left takes as long as what was done: 10 s for a quarter are 30 s for the rest.
TEST(Progress, SaysHowMuchAndForHowLong) {
  using std::chrono::seconds;
  const auto line = [](std::uint64_t total, std::optional<double> part, int s) {
    return progress_line("packets", 250, total, part, seconds(s));
  };
  EXPECT_EQ(line(0, std::nullopt, 10), "packets 250");
  EXPECT_EQ(line(1000, std::nullopt, 10),
            "packets 250 of 1000 [#####...............] 25 %, 0:30 left");
  EXPECT_EQ(line(0, 0.5, 3725), "packets 250 [##########..........] 50 %, 1:02:05 left");
  EXPECT_EQ(line(0, 0.5, 1), "packets 250 [##########..........] 50 %");
  EXPECT_EQ(line(0, 0.0, 10), "packets 250 [....................] 0 %");
  EXPECT_EQ(line(0, 1.5, 10), "packets 250 [####################] 100 %, 0:00 left");
}

}  // namespace
}  // namespace iog::tools
