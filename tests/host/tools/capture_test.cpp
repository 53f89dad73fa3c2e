#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>
#include <zlib.h>
#include <zstd.h>

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

CapturedDatagram datagram_of(std::uint64_t time_us, std::size_t bytes) {
  CapturedDatagram datagram{.time_us = time_us,
                            .source = {.ipv4 = 0x0A000265, .port = 12000},
                            .destination = {.ipv4 = 0x0A00020F, .port = 12003},
                            .payload = {}};
  for (std::size_t i = 0; i < bytes; ++i) {
    datagram.payload.push_back(static_cast<std::byte>(i * 7 + bytes));
  }
  return datagram;
}

void write_capture(const std::string& path, const std::vector<CapturedDatagram>& datagrams) {
  PcapWriter writer(path);
  for (const CapturedDatagram& datagram : datagrams) {
    writer.write(datagram);
  }
  writer.finish();
}

std::vector<CapturedDatagram> read_capture(PcapReader& reader) {
  std::vector<CapturedDatagram> datagrams;
  while (auto datagram = reader.next()) {
    datagrams.push_back(std::move(*datagram));
  }
  return datagrams;
}

void write_bytes(const std::string& path, const std::vector<std::byte>& bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.finish();
}

// The file's header, then per packet 16 bytes, Ethernet 14, IPv4 20, UDP 8.
constexpr std::size_t kFileHeaderBytes = 24;
constexpr std::size_t kFirstFrame = kFileHeaderBytes + 16;

// Also through a link, which stays.
TEST(Capture, AnUnfinishedOneLeavesWhatWasThere) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "out.pcap";
  const std::string link = folder / "link.pcap";
  const auto files = [&] {
    const std::filesystem::directory_iterator all(std::filesystem::path(path).parent_path());
    return std::distance(begin(all), end(all));
  };
  write_capture(path, {datagram_of(1, 10)});
  const std::vector<std::byte> before = read_file(path);
  std::filesystem::create_symlink(path, link);
  for (const std::string& name : {path, link, folder / "new.pcap"}) {
    {
      PcapWriter writer(name);
      writer.write(datagram_of(2, 20));
    }
    EXPECT_EQ(read_file(path), before);
    EXPECT_EQ(files(), 2);
  }
  PcapWriter writer(link);
  writer.write(datagram_of(2, 20));
  writer.finish();
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  PcapReader reader(path);
  const std::vector<CapturedDatagram> found = read_capture(reader);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].payload, datagram_of(2, 20).payload);
  EXPECT_EQ(files(), 2);
}

// The first bytes by the formats' own descriptions (RFC 1952, RFC 8878, and so on).
TEST(Capture, WhatIsNoCaptureIsNamedWithWhatToDo) {
  using namespace std::string_literals;
  const tests::TemporaryFolder folder;
  const std::string path = folder / "some.file";
  const std::string velodyne = "\xFF\xEE"s + std::string(1204, '\0');
  const std::vector<std::pair<std::string, std::string>> known{
      {"\xFD"s + "7zXZ\0"s, "unxz"},
      {"BZh91AY&SY", "bunzip2"},
      {"#ROSBAG V2.0\n", "a bag of ROS 1: convert it to one of ROS 2 first"},
      {"SQLite format 3\0"s, "a bag of ROS 2 is: `iog points` makes a capture"},
      {"\x89MCAP0\r\n", "an MCAP file"},
      {"\xAF\xFE\xC0\xC2", "iog convert --raw"},
      {"ply\nformat", "iog points"},
      {"time_s,x_m", "--poses"},
      {velodyne, "iog convert --raw"},
      {velodyne + velodyne, "iog convert --raw"}};
  for (const auto& [begin, words] : known) {
    const std::string bytes = begin == velodyne ? begin : begin + std::string(100, 'x');
    OutputFile file(path);
    file.write(bytes);
    file.finish();
    try {
      const PcapReader reader(path);
      ADD_FAILURE() << words;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
}

TEST(Capture, WhatIsWrittenIsReadBack) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "round_trip.pcap";
  std::vector<CapturedDatagram> sent;
  for (const std::size_t bytes :
       {0U, 1U, 17U, 18U, 19U, 1206U, 1400U, 1472U, 1473U, 12'608U, 33'024U}) {
    sent.push_back(datagram_of(1'714'564'800'999'990U + bytes, bytes));
  }
  write_capture(path, sent);
  PcapReader reader(path);
  const auto received = read_capture(reader);
  ASSERT_EQ(received.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_EQ(received[i].time_us, sent[i].time_us);
    EXPECT_EQ(received[i].source.ipv4, sent[i].source.ipv4);
    EXPECT_EQ(received[i].source.port, sent[i].source.port);
    EXPECT_EQ(received[i].destination.ipv4, sent[i].destination.ipv4);
    EXPECT_EQ(received[i].destination.port, sent[i].destination.port);
    EXPECT_EQ(received[i].payload, sent[i].payload);
  }
  EXPECT_EQ(reader.counts().skipped(), 0U);
  EXPECT_EQ(describe_skipped(reader.counts()), "");
}

// RFC 791, section 2.3: pieces of at most 1480 bytes, whole units of 8 but for the last; one name,
// and each datagram another.
TEST(Capture, WhatDoesNotFitIntoAFrameIsFragments) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "fragments.pcap";
  write_capture(path, {datagram_of(1, 3000), datagram_of(2, 3000)});
  auto bytes = read_file(path);
  ASSERT_EQ(bytes.size(), kFileHeaderBytes + std::size_t{2} * (3 * (16 + 34) + 3008));
  const auto half = [&](std::size_t at) {
    return wire::load_be16(std::span(bytes).subspan(at).first<2>());
  };
  std::size_t frame = kFirstFrame;
  for (const unsigned flags : {0x2000U, 0x2000U | 185U, 370U}) {
    EXPECT_EQ(half(frame + 18), half(kFirstFrame + 18));
    EXPECT_EQ(half(frame + 20), flags);
    frame += half(frame + 16) + 14U + 16U;
  }
  EXPECT_NE(half(frame + 18), half(kFirstFrame + 18));
  // Without its second piece the first datagram is two fragments of nothing.
  const auto second = bytes.begin() + kFileHeaderBytes + 16 + 1514;
  bytes.erase(second, second + 16 + 1514);
  write_bytes(path, bytes);
  PcapReader reader(path);
  const auto received = read_capture(reader);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received[0].payload, datagram_of(2, 3000).payload);
  EXPECT_EQ(reader.counts().fragments, 2U);
  EXPECT_EQ(describe_skipped(reader.counts()),
            "2 packets skipped: 2 fragments of incomplete datagrams");
}

// One packet, with one byte of it changed.
CaptureCounts counts_with(std::size_t offset_in_frame, std::uint8_t value) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "changed.pcap";
  write_capture(path, {datagram_of(1, 100)});
  auto bytes = read_file(path);
  bytes[kFirstFrame + offset_in_frame] = std::byte{value};
  write_bytes(path, bytes);
  PcapReader reader(path);
  static_cast<void>(read_capture(reader));
  return reader.counts();
}

TEST(Capture, WhatIsNoWholeUdpDatagramIsCountedByCause) {
  EXPECT_EQ(counts_with(12, 0x86).not_udp, 1U);        // Ethernet type
  EXPECT_EQ(counts_with(14 + 8, 1).bad_checksum, 1U);  // time to live
  EXPECT_EQ(counts_with(14, 0x44).malformed, 1U);      // IPv4 header length
  EXPECT_EQ(counts_with(60, 0xEE).bad_checksum, 1U);   // payload
  EXPECT_EQ(counts_with(0, 0xEE).datagrams, 1U);       // an address of Ethernet does not matter
}

TEST(Capture, AFileThatBreaksOffEndsThere) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "cut.pcap";
  write_capture(path, {datagram_of(1, 100), datagram_of(2, 100)});
  auto bytes = read_file(path);
  bytes.resize(bytes.size() - 10);
  write_bytes(path, bytes);
  PcapReader reader(path);
  EXPECT_EQ(read_capture(reader).size(), 1U);
  EXPECT_EQ(reader.trouble(), "breaks off in a packet");
}

std::vector<std::byte> packed_by_gzip(std::span<const std::byte> bytes) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "packed.gz";
  const gzFile file = gzopen(path.c_str(), "wb9");
  EXPECT_EQ(gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size())),
            static_cast<int>(bytes.size()));
  EXPECT_EQ(gzclose(file), Z_OK);
  return read_file(path);
}

std::vector<std::byte> packed_by_zstd(std::span<const std::byte> bytes) {
  std::vector<std::byte> packed(ZSTD_compressBound(bytes.size()));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3));
  return packed;
}

using Packer = std::vector<std::byte> (*)(std::span<const std::byte>);
constexpr std::array<Packer, 2> kPackers{packed_by_gzip, packed_by_zstd};

// What is read of a file of these bytes, and why not more.
struct Reading {
  std::vector<CapturedDatagram> datagrams;
  std::string trouble;
};

Reading reading_of(const std::vector<std::byte>& bytes) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "some.file";
  write_bytes(path, bytes);
  try {
    PcapReader reader(path);
    Reading reading{.datagrams = read_capture(reader), .trouble = {}};
    reading.trouble = reader.trouble();
    return reading;
  } catch (const UsageError& error) {
    return {.datagrams = {}, .trouble = error.what()};
  }
}

std::vector<std::byte> capture_of(std::size_t datagrams) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "plain.pcap";
  std::vector<CapturedDatagram> all;
  for (std::size_t i = 0; i < datagrams; ++i) {
    all.push_back(datagram_of(i, 1000 + i));
  }
  write_capture(path, all);
  return read_file(path);
}

// RFC 1952, section 2.2, and RFC 8878, section 3: what has been packed in pieces is one file.
TEST(Capture, PackedOnesAreReadAsTheyWere) {
  const auto bytes = capture_of(200);
  for (const Packer pack : kPackers) {
    const auto whole = std::span<const std::byte>(bytes);
    auto pieces = pack(whole.first(77'777));
    const auto rest = pack(whole.subspan(77'777));
    pieces.insert(pieces.end(), rest.begin(), rest.end());
    const Reading reading = reading_of(pieces);
    ASSERT_EQ(reading.datagrams.size(), 200U);
    EXPECT_EQ(reading.datagrams[199].payload, datagram_of(199, 1199).payload);
    EXPECT_EQ(reading.trouble, "");
  }
}

TEST(Capture, APackedOneThatBreaksOffIsReadAsFarAsItGoes) {
  const auto bytes = capture_of(50);
  for (const Packer pack : kPackers) {
    const auto whole = pack(bytes);
    std::size_t before = 0;
    for (std::size_t kept = 1; kept < whole.size(); kept += 97) {
      const Reading reading = reading_of({whole.begin(), whole.begin() + static_cast<long>(kept)});
      EXPECT_FALSE(reading.trouble.empty()) << kept << " of " << whole.size();
      EXPECT_GE(reading.datagrams.size(), before);
      before = reading.datagrams.size();
      for (std::size_t i = 0; i < reading.datagrams.size(); ++i) {
        EXPECT_EQ(reading.datagrams[i].payload, datagram_of(i, 1000 + i).payload);
      }
    }
  }
}

TEST(Capture, APackedOneThatIsDamagedSaysSo) {
  const auto bytes = capture_of(50);
  for (const Packer pack : kPackers) {
    auto damaged = pack(bytes);
    std::fill_n(damaged.begin() + static_cast<long>(damaged.size() / 2), 40, std::byte{0x5A});
    const Reading reading = reading_of(damaged);
    EXPECT_LT(reading.datagrams.size(), 50U);
    EXPECT_NE(reading.trouble.find("cannot be "), std::string::npos) << reading.trouble;
  }
}

// Records of no bytes, which nothing but the limit ends.
TEST(Capture, APackedOneThatIsABombEndsAtTheLimit) {
  auto bytes = capture_of(0);
  bytes.resize(UnpackedFile::kAlwaysUnpacked + (1U << 20));
  for (const Packer pack : kPackers) {
    const Reading reading = reading_of(pack(bytes));
    EXPECT_NE(reading.trouble.find("unpacks to more than 500 times its size"), std::string::npos)
        << reading.trouble;
  }
}

// By draft-ietf-opsawg-pcapng: section header, one interface of Ethernet whose times are
// microseconds, and an enhanced packet, each with its length before and behind.
std::vector<std::byte> pcapng_of_a_datagram() {
  const auto plain = capture_of(1);
  const auto frame = std::span<const std::byte>(plain).subspan(kFirstFrame);
  std::vector<std::byte> bytes;
  const auto add = [&bytes](std::initializer_list<std::uint32_t> words) {
    for (const std::uint32_t word : words) {
      for (int shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<std::byte>(word >> shift & 0xFFU));
      }
    }
  };
  add({0x0A0D0D0A, 28, 0x1A2B3C4D, 1, 0xFFFFFFFF, 0xFFFFFFFF, 28});
  add({1, 20, 1, 0xFFFF, 20});
  const auto count = static_cast<std::uint32_t>(frame.size());
  const std::uint32_t block = 32 + (count + 3) / 4 * 4;
  add({6, block, 0, 0, 42, count, count});
  bytes.insert(bytes.end(), frame.begin(), frame.end());
  bytes.resize(bytes.size() + (4 - count % 4) % 4);
  add({block});
  return bytes;
}

TEST(Capture, PcapngIsRead) {
  const auto bytes = pcapng_of_a_datagram();
  for (const Packer pack : kPackers) {
    for (const auto& file : {bytes, pack(bytes)}) {
      const Reading reading = reading_of(file);
      ASSERT_EQ(reading.datagrams.size(), 1U) << reading.trouble;
      EXPECT_EQ(reading.datagrams[0].payload, datagram_of(0, 1000).payload);
      EXPECT_EQ(reading.datagrams[0].time_us, 42U);
    }
  }
}

// Whoever has come by a place comes back to the same packets, from anywhere.
TEST(Capture, GoesOnFromAnyPlace) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "plain.pcap";
  write_bytes(path, capture_of(100));
  PcapReader reader(path);
  std::vector<PcapReader::Place> places{reader.place().value()};
  while (reader.next()) {
    places.push_back(reader.place().value());
  }
  PcapReader fresh(path);
  for (const std::size_t from : {100U, 99U, 0U, 57U, 58U, 1U}) {
    for (PcapReader* const each : {&reader, &fresh}) {
      each->go_to(places.at(from));
      const auto rest = read_capture(*each);
      ASSERT_EQ(rest.size(), 100 - from);
      for (std::size_t i = 0; i < rest.size(); ++i) {
        EXPECT_EQ(rest[i].payload, datagram_of(from + i, 1000 + from + i).payload);
      }
      EXPECT_EQ(each->trouble(), "");
    }
  }
}

TEST(Capture, APackedOneAndAPcapngHaveNoPlaces) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "some.file";
  for (const Packer pack : kPackers) {
    write_bytes(path, pack(capture_of(3)));
    PcapReader reader(path);
    EXPECT_FALSE(reader.place());
    EXPECT_TRUE(reader.next());
    EXPECT_FALSE(reader.place());
    EXPECT_THROW(reader.go_to({.at = 24, .clock = {}}), UsageError);
    EXPECT_EQ(read_capture(reader).size(), 2U);
  }
  write_bytes(path, pcapng_of_a_datagram());
  EXPECT_FALSE(PcapReader(path).place());
}

TEST(Capture, WhatIsNoCaptureIsRefused) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "text.pcap";
  write_bytes(path, std::vector<std::byte>(100, std::byte{'x'}));
  EXPECT_THROW(PcapReader{path}, UsageError);
  EXPECT_THROW(PcapReader{folder / "missing.pcap"}, UsageError);
}

}  // namespace
}  // namespace iog::tools
