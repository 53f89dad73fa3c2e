#include "tools/identity/car_capture.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "gtest/gtest.h"

#include "drive_sample.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

using Datagrams = std::vector<CapturedDatagram>;

const CatalogueEntry& car() { return find_vehicle("reference_car"); }

// Six frames, whose scanners have the time of day, and a pose each 10 ms that is sent 2 ms later,
// all in their order. Poses are by a clock that is so much behind; are_beside: and come so much
// earlier, as if a log had been merged with the packets.
Datagrams drive(std::int64_t behind_us, bool are_beside) {
  Datagrams datagrams = sample_drive(car(), 1, 6);
  pose::Encoder encoder;
  const std::uint64_t begin_us = datagrams.front().time_us - 60'000;
  const auto behind = static_cast<std::uint64_t>(behind_us);
  for (std::uint64_t time_us = begin_us; time_us < begin_us + 350'000; time_us += 10'000) {
    const auto bytes = encoder.encode({.run = 1,
                                       .age_us = 2'000,
                                       .clock_us = time_us - behind,
                                       .sigma = {.position_mm = 10, .heading_10urad = 10}});
    datagrams.push_back({.time_us = time_us + 2'000 - (are_beside ? behind : 0),
                         .source = datagrams.front().source,
                         .destination = {.ipv4 = 0x0A00020F, .port = pose::kPosePort},
                         .payload = {bytes.begin(), bytes.end()}});
  }
  std::ranges::stable_sort(datagrams, {}, &CapturedDatagram::time_us);
  return datagrams;
}

struct Read {
  std::vector<std::tuple<std::uint64_t, std::uint16_t, std::vector<std::byte>>> datagrams;
  std::string words;
};

Read read(const Datagrams& datagrams, double offset_s) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "drive.pcap";
  PcapWriter writer(path);
  for (const CapturedDatagram& datagram : datagrams) {
    writer.write(datagram);
  }
  writer.finish();
  CarCapture capture(path, car(), offset_s);
  Read read;
  while (const auto datagram = capture.next()) {
    read.datagrams.emplace_back(datagram->time_us, datagram->destination.port, datagram->payload);
  }
  read.words = capture.clock_words();
  return read;
}

TEST(CarCapture, ClocksThatAgreeAreLeftAlone) {
  const Datagrams datagrams = drive(0, false);
  const Read its = read(datagrams, 0);
  EXPECT_EQ(its.words, "");
  ASSERT_EQ(its.datagrams.size(), datagrams.size());
  for (std::size_t i = 0; i < datagrams.size(); ++i) {
    EXPECT_EQ(std::get<2>(its.datagrams[i]), datagrams[i].payload);
  }
}

struct Offset {
  std::int64_t seconds;
  std::string words;
};

// TAI and UTC, GPS and UTC, a time zone, a year.
const std::vector<Offset> kOffsets{
    {37, "the packets are 37.000 s ahead of the poses: --clock-offset 37 adds it to these"},
    {-18, "the packets are 18.000 s behind the poses: --clock-offset -18 adds it to these"},
    {3'600, "the packets are 3600.000 s ahead of the poses: --clock-offset 3600 adds it to these"},
    {-31'536'000,
     "the packets are 31536000.000 s behind the poses: --clock-offset -31536000 adds it to these"}};

TEST(CarCapture, ClocksThatDifferAreToldAndMended) {
  const Read right = read(drive(0, false), 0);
  for (const Offset& offset : kOffsets) {
    const Datagrams datagrams = drive(offset.seconds * 1'000'000, false);
    EXPECT_EQ(read(datagrams, 0).words, offset.words);
    const Read mended = read(datagrams, static_cast<double>(offset.seconds));
    EXPECT_EQ(mended.words, "");
    EXPECT_EQ(mended.datagrams, right.datagrams) << offset.seconds;
  }
}

// Poses of a log come in one piece before the packets or behind them.
TEST(CarCapture, PosesOfALogAreToldAndMended) {
  const Read right = read(drive(0, false), 0);
  for (const Offset& offset : kOffsets) {
    const Datagrams datagrams = drive(offset.seconds * 1'000'000, true);
    EXPECT_EQ(read(datagrams, 0).words,
              "the packets and the poses have no time in common: if they begin together, " +
                  offset.words);
    const Read mended = read(datagrams, static_cast<double>(offset.seconds));
    EXPECT_EQ(mended.words, "");
    EXPECT_EQ(mended.datagrams, right.datagrams) << offset.seconds;
  }
}

}  // namespace
}  // namespace iog::tools
