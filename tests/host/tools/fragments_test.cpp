// What is missing of datagrams that came in fragments.
#include <span>
#include <vector>

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/program/file.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

// Frames behind 16 bytes each: Ethernet 14, IPv4 20.
// Of two datagrams of three fragments each, the first ones or the others.
TEST(Capture, WhichFragmentsAreMissingIsTold) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "fragments.pcap";
  constexpr std::size_t kHeaderBytes = 24;
  PcapWriter writer(path);
  for (const std::uint64_t time_us : {1U, 2U}) {
    writer.write({.time_us = time_us,
                  .source = {.ipv4 = 0x0A000265, .port = 12000},
                  .destination = {.ipv4 = 0x0A00020F, .port = 12003},
                  .payload = std::vector<std::byte>(3000)});
  }
  writer.finish();
  const auto whole = read_file(path);
  for (const bool has_first : {true, false}) {
    auto bytes = std::vector<std::byte>(whole.begin(), whole.begin() + kHeaderBytes);
    for (std::size_t at = kHeaderBytes; at < whole.size();) {
      const std::size_t size = 16 + wire::load_le32(std::span(whole).subspan(at + 8).first<4>());
      const auto flags = wire::load_be16(std::span(whole).subspan(at + 16 + 20).first<2>());
      const auto begin = whole.begin() + static_cast<std::ptrdiff_t>(at);
      if (((flags & 0x1FFFU) == 0) == has_first) {
        bytes.insert(bytes.end(), begin, begin + static_cast<std::ptrdiff_t>(size));
      }
      at += size;
    }
    OutputFile file(path);
    file.write(bytes);
    file.finish();
    PcapReader reader(path);
    EXPECT_FALSE(reader.next().has_value());
    EXPECT_EQ(describe_skipped(reader.counts()),
              has_first
                  ? "2 packets skipped: 2 first fragments without the others of their datagrams "
                    "(a filter by port passes no others: record with `host ADDRESS`)"
                  : "4 packets skipped: 4 fragments without the first ones of their datagrams "
                    "(record all packets of `host ADDRESS`)");
  }
}

}  // namespace
}  // namespace iog::tools
