#include "tools/identity/car_capture.hpp"

#include <algorithm>
#include <tuple>

#include "gtest/gtest.h"

#include "drive_sample.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/poses/pose_encoder.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

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

std::string write(const Datagrams& datagrams, const std::string& path) {
  PcapWriter writer(path);
  for (const CapturedDatagram& datagram : datagrams) {
    writer.write(datagram);
  }
  writer.finish();
  return path;
}

Read read(const DriveFiles& files) {
  CarCapture capture(files, car());
  Read read;
  while (const auto datagram = capture.next()) {
    read.datagrams.emplace_back(datagram->time_us, datagram->destination.port, datagram->payload);
  }
  read.words = capture.clock_words();
  for (const std::string& remark : capture.remarks()) {
    read.words += '|' + remark;
  }
  return read;
}

Read read(const Datagrams& datagrams, double offset_s) {
  const tests::TemporaryFolder folder;
  return read({.captures = {write(datagrams, folder / "drive.pcap")}, .clock_offset_s = offset_s});
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

// A second unit on the port of a sensor whose address the car's file has.
TEST(CarCapture, StrangersOnAPortOfANamedSenderAreLeftOut) {
  Datagrams datagrams = sample_drive(car(), 1, 6);
  const Read alone = read(datagrams, 0);
  const std::size_t own = datagrams.size();
  for (std::size_t i = 0; i < own; ++i) {
    datagrams.push_back(datagrams[i]);
    datagrams.back().source.ipv4 = 0x0A0002FA;
  }
  std::ranges::stable_sort(datagrams, {}, &CapturedDatagram::time_us);
  const Read both = read(datagrams, 0);
  EXPECT_EQ(both.datagrams, alone.datagrams);
  EXPECT_EQ(both.words,
            std::to_string(own) + " packets of another sender than `source_ipv4` are not used");
  // Who is heard first is used until the named sender is heard, and told.
  std::rotate(datagrams.begin(), datagrams.begin() + 1, datagrams.begin() + 2);
  ASSERT_EQ(datagrams[0].source.ipv4, 0x0A0002FAU);
  EXPECT_EQ(read(datagrams, 0).words,
            std::to_string(own - 1) +
                " packets of another sender than `source_ipv4` are not used; 1 packet of another "
                "sender came before its first one and was used");
  // Of a drive that was recorded elsewhere nothing is lost.
  std::erase_if(datagrams, [](const auto& datagram) { return datagram.source.ipv4 != 0x0A0002FA; });
  const Read elsewhere = read(datagrams, 0);
  EXPECT_EQ(elsewhere.datagrams, alone.datagrams);
  EXPECT_TRUE(elsewhere.words.starts_with(
      "packets to UDP port 12002 come from 10.0.2.250: iog uses them, but a target drops all but "
      "source_ipv4 10.0.2.101 of sensor front_left (check the car file); packets to UDP port 12003 "
      "come from"))
      << elsewhere.words;
}

// If the car's file names no address, all are used, and the user must know.
TEST(CarCapture, ASecondUnitThatStartsLaterIsTold) {
  const CatalogueEntry& roof = find_vehicle("roof_vlp16");
  Datagrams datagrams = sample_drive(roof, 1, 6);
  const std::size_t own = datagrams.size();
  for (std::size_t i = own / 2; i < own; ++i) {
    datagrams.push_back(datagrams[i]);
    datagrams.back().source.ipv4 = 0x0A0002FA;
  }
  std::ranges::stable_sort(datagrams, {}, &CapturedDatagram::time_us);
  const tests::TemporaryFolder folder;
  CarCapture capture({.captures = {write(datagrams, folder / "drive.pcap")}}, roof);
  while (capture.next()) {
  }
  EXPECT_NE(
      capture.words_of_crowd().find("2 units send to UDP port 2368 (10.0.2.100, 10.0.2.250): set "
                                    "source_ipv4 of sensor roof in the car file"),
      std::string::npos)
      << capture.words_of_crowd();
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

// Frames whose capture begins 30 s before the scanners' clocks are set by PTP, and one packet with
// a damaged time.
TEST(CarCapture, AClockThatIsSetInBetweenIsTold) {
  constexpr std::uint64_t kSetUs = 1'714'564'770'000'000;
  Datagrams datagrams = drive(0, false);
  Datagrams later = sample_drive(car(), 1, 80);
  std::erase_if(later, [&](const auto& its) { return its.time_us <= datagrams.back().time_us; });
  for (CapturedDatagram& datagram : datagrams) {
    datagram.time_us -= kSetUs;
  }
  for (CapturedDatagram& datagram : later) {
    datagram.time_us -= kSetUs - 3'600'000'000;
  }
  EXPECT_EQ(read(datagrams, 0).words.find("steps"), std::string::npos);
  datagrams.insert(datagrams.end(), later.begin(), later.end());
  const std::string words = read(datagrams, 0).words;
  EXPECT_TRUE(words.starts_with("the clock of front_left steps by -3600.000 s at 3630.")) << words;
  EXPECT_NE(words.find("no single offset fits. Cut the capture there"), std::string::npos) << words;
}

// A Velodyne's clock counts from the full hour.
TEST(ClockPace, BeginsWithTheFirstPacket) {
  ClockPace pace;
  for (std::uint64_t unit_us = 1'000; unit_us <= 1'001'000; unit_us += 1'000) {
    pace.add(unit_us, 1'714'564'800'000'000);
  }
  EXPECT_TRUE(pace.words("roof").starts_with(
      "the capture's times are wrong: they advance by 0.000 s while the clock of roof advances by "
      "1.000 s"))
      << pace.words("roof");
}

// By the scanners' own clock 15 frames of 40 ms last 14 times that, from the first to the last.
TEST(CarCapture, TimesThatDoNotPassAsTheScannersClockDoesAreTold) {
  struct Wrong {
    std::uint64_t times;  // a microsecond of the recording has become so many
    std::uint64_t divided_by;
    std::string words;
  };
  const auto told = [](const std::string& by_capture) {
    return "the capture's times are wrong: they advance by " + by_capture +
           " s while the clock of front_left advances by 0.560 s; convert or record it again, with "
           "the time at which each packet came";
  };
  const Datagrams right = sample_drive(car(), 1, 15);
  Datagrams whole_s = sample_drive(car(), 1, 80);  // 3.2 s, of which 1 to 2 s have one time
  for (CapturedDatagram& datagram : whole_s) {
    datagram.time_us -= datagram.time_us % 1'000'000;
  }
  EXPECT_EQ(read(whole_s, 0).words,
            "the capture's times are wrong: they stand still while the clock of front_left "
            "advances by 0.960 s; convert or record it again, with the time at which each packet "
            "came");
  for (const auto& [times, divided_by, words] :
       {Wrong{0, 1, told("0.000")}, Wrong{1, 1'000, told("0.001")}, Wrong{1, 1, ""}}) {
    Datagrams datagrams = right;
    for (CapturedDatagram& datagram : datagrams) {
      const std::uint64_t since_us = datagram.time_us - right.front().time_us;
      datagram.time_us = right.front().time_us + since_us * times / divided_by;
    }
    EXPECT_EQ(read(datagrams, 0).words, words);
  }
}

// Poses of a log come in one piece before the packets or behind them.
TEST(CarCapture, PosesOfALogAreToldAndMended) {
  const Read right = read(drive(0, false), 0);
  for (const Offset& offset : kOffsets) {
    const Datagrams datagrams = drive(offset.seconds * 1'000'000, true);
    EXPECT_TRUE(
        read(datagrams, 0)
            .words.ends_with(" have no time in common: if they begin together, " + offset.words));
    const Read mended = read(datagrams, static_cast<double>(offset.seconds));
    EXPECT_EQ(mended.words, "");
    EXPECT_EQ(mended.datagrams, right.datagrams) << offset.seconds;
  }
}

// Six frames, and beside them a log of 100 poses a second whose clock is so much behind.
class BesideALog : public testing::Test {
 protected:
  static constexpr const char* kHead = "time_s,x_m,y_m,heading_deg,sigma_m,sigma_heading_deg\n";

  static std::string rows(double behind_s, int first = 0, int end = 35) {
    std::string text(kHead);
    for (int i = first; i < end; ++i) {
      text += std::to_string(1'714'564'799.94 - behind_s + 0.01 * i) + ",1,0,0,0.02,0.1\n";
    }
    return text;
  }
  DriveFiles log(const std::string& text, std::optional<double> offset_s = {}) const {
    OutputFile file(log_);
    file.write(text);
    file.finish();
    return {.captures = {lidar_}, .poses = log_, .clock_offset_s = offset_s};
  }
  static void expect_error(const DriveFiles& files, const std::string& words) {
    try {
      static_cast<void>(read(files));
      ADD_FAILURE() << "read, not: " << words;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }

  tests::TemporaryFolder folder_;
  std::string log_ = folder_ / "log.csv";
  Datagrams packets_ = sample_drive(car(), 1, 6);
  std::string lidar_ = write(packets_, folder_ / "lidar.pcap");
};

// What `iog pose` makes of the log, merged with the packets: as a capture of its own, and by hand.
TEST_F(BesideALog, PosesAreThoseOfItsCapture) {
  const Read beside = read(log(rows(0)));
  EXPECT_EQ(beside.words, "");
  PoseEncoder encoder;
  Datagrams poses;
  for (const PoseSample& sample : converted(read_pose_log(log_), {}).samples) {
    poses.push_back(encoder.datagram_of(sample));
  }
  ASSERT_EQ(poses.size(), 35U);
  const std::string capture = write(poses, folder_ / "poses.pcap");
  EXPECT_EQ(read({.captures = {capture, lidar_}}).datagrams, beside.datagrams);
  poses.insert(poses.end(), packets_.begin(), packets_.end());
  std::ranges::stable_sort(poses, {}, &CapturedDatagram::time_us);
  const std::string merged = write(poses, folder_ / "merged.pcap");
  EXPECT_EQ(read({.captures = {merged}}).datagrams, beside.datagrams);
  const Read instead = read({.captures = {merged}, .poses = log_});
  EXPECT_EQ(instead.datagrams, beside.datagrams);
  EXPECT_EQ(instead.words, "|35 poses in the captures are not used");
  DriveFiles mounted = log(rows(0));
  mounted.poses_mount = {1, 0.5, 90};
  mounted.poses_sigma = {30, 1.5};
  const auto [fate, pose] = pose::decode(std::get<2>(read(mounted).datagrams[0]));
  EXPECT_EQ(pose.sigma.position_mm, 30);
  EXPECT_EQ(pose.sigma.heading_10urad, 150);
  EXPECT_EQ(pose.pose.heading, 0xC000'0000U);
  EXPECT_EQ(pose.pose.x_mm, 500);  // the mount is 0.5 m and -1 m away
  EXPECT_EQ(pose.pose.y_mm, 1'000);
}

// A second before 0.04 s is row -90, and a second behind 0.242 s row 130.
TEST_F(BesideALog, OfALongOneItTakesWhatTheDriveNeeds) {
  const Read taken = read(log(rows(0, -500, 500)));
  EXPECT_EQ(taken.datagrams.size(), packets_.size() + 221);
  EXPECT_TRUE(taken.datagrams == read(log(rows(0, -90, 131))).datagrams);
}

// Packets by TAI and a capture by UTC, 37 s behind; a log by TAI, or by UTC, too.
TEST_F(BesideALog, AnOffsetBringsItsClockToThatOfThePackets) {
  const Read right = read(log(rows(0)));
  EXPECT_EQ(read(log(rows(100), 100)).datagrams, right.datagrams);
  for (CapturedDatagram& packet : packets_) {
    packet.time_us -= 37'000'000;
  }
  write(packets_, lidar_);
  const Read told = read(log(rows(0), 0));
  EXPECT_EQ(told.words, "");
  EXPECT_EQ(std::get<0>(told.datagrams[0]), 1'714'564'762'940'000U);
  EXPECT_EQ(std::get<2>(told.datagrams[0]), std::get<2>(right.datagrams[0]));
  EXPECT_EQ(read(log(rows(37))).words,
            "the packets are 37.000 s ahead of the poses: --clock-offset 37 adds it to these, and "
            "--clock-offset 0 says that the log is by the packets' clock");
}

TEST_F(BesideALog, WhatIsWrongWithItIsToldInASentence) {
  const std::string head(kHead);
  const std::string row = "1714564800.11,1,0,0,0.1,0.1\n";
  expect_error(log(rows(100)),
               "log.csv: the packets (1714564800.040 to 1714564800.242 s) and the poses "
               "(1714564699.940 to 1714564700.280 s) have no time in common: if they begin "
               "together, the packets are 100.100 s ahead of the poses: --clock-offset 100.100");
  expect_error(log(""), "log.csv: empty");
  expect_error(log(head), "log.csv: no pose in it");
  expect_error(log(head + "1,nan,0,0,0,0\n"), "log.csv:2: x_m is 'nan'");
  expect_error({.captures = {lidar_}, .poses = lidar_}, "no log of poses");
  expect_error({.captures = {"/dev/null"}, .poses = log_}, "");
  expect_error(log(head + row + row + row),
               "log.csv: only one pose in it; not used: 2 poses that are not newer than the one "
               "before (first: line 3)");
  EXPECT_EQ(read(log(head + row + row + "1714564800.13,1,0,0,0.1,0.1\n")).words,
            "|not used: 1 pose that is not newer than the one before (line 3)");
  EXPECT_THROW(CarCapture(log(rows(0)), find_vehicle("two_lux_parking")), UsageError);
}

// 80 frames end 2.96 s after the six of the fixture.
TEST_F(BesideALog, OneThatDoesNotCoverThePacketsIsTold) {
  write(sample_drive(car(), 1, 80), lidar_);
  const std::string clocks =
      ": packets there have no place; if the clocks differ, --clock-offset auto finds by how much";
  EXPECT_EQ(read(log(rows(0, 0, 350))).words, "");
  EXPECT_EQ(read(log(rows(0))).words, "the poses end 2.922 s before the last packet" + clocks);
  EXPECT_EQ(
      read(log(rows(0, 150, 160))).words,
      "the poses begin 1.400 s after the first packet and end 1.672 s before the last packet" +
          clocks);
}

// Of each scanner a file.
TEST_F(BesideALog, CapturesAreMergedByTime) {
  DriveFiles files;
  for (const description::SensorConfig& sensor : car().sensors) {
    Datagrams its = packets_;
    std::erase_if(its, [&](const auto& one) { return one.destination.port != sensor.udp_port; });
    files.captures.push_back(write(its, folder_ / sensor.name));
  }
  const Read merged = read(files);
  EXPECT_EQ(merged.datagrams.size(), packets_.size());
  const auto time_us = [](const auto& one) { return std::get<0>(one); };
  EXPECT_TRUE(std::ranges::is_sorted(merged.datagrams, {}, time_us));
  EXPECT_EQ(merged.words, "");
  Datagrams later = packets_;
  for (CapturedDatagram& datagram : later) {
    datagram.time_us += 86'400'000'000;
  }
  files.captures.push_back(write(later, folder_ / "later.pcap"));
  const std::string words = read(files).words;
  EXPECT_NE(words.find("later.pcap begins 86399 s after the captures before it end"),
            std::string::npos)
      << words;
}

}  // namespace
}  // namespace iog::tools
