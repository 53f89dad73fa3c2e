#include "tools/formats/capture/capture_clock.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/program/file.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

constexpr std::int64_t kMinute = 60'000'000;
constexpr std::int64_t kHour = 60 * kMinute;
constexpr std::int64_t kStart = 1'714'564'800'000'000;

// A packet each 10 ms for 3 s, recorded by a clock that is set by `step_us` from each of `at` on.
struct Recorded {
  std::vector<std::int64_t> since_start_us;  // that times say
  std::string words;
};

Recorded recorded(std::int64_t step_us, const std::vector<int>& at) {
  SteadyTime time;
  Recorded its;
  for (int i = 0; i < 300; ++i) {
    std::int64_t clock_us = kStart + 10'000L * i;
    for (const int each : at) {
      clock_us += i >= each ? step_us : 0;
    }
    const std::uint64_t time_us = time.of(static_cast<std::uint64_t>(clock_us));
    its.since_start_us.push_back(static_cast<std::int64_t>(time_us) - kStart);
  }
  its.words = time.words();
  return its;
}

// Nothing shows of them, but for the first packets, before which nothing was apart.
TEST(SteadyTime, GoesOnWhereTheClockStepsBack) {
  for (const std::int64_t step_us : {100'000LL, 3'000'000LL, 37'000'000LL, 50LL * 24 * kHour}) {
    for (const std::vector<int>& at : {std::vector{100}, {100, 101}, {1, 50, 200, 299}}) {
      const Recorded its = recorded(-step_us, at);
      for (std::size_t i = 1; i < its.since_start_us.size(); ++i) {
        const std::int64_t passed_us = its.since_start_us[i] - its.since_start_us[i - 1];
        EXPECT_EQ(passed_us, i == 1 && at.front() == 1 ? 0 : 10'000) << step_us << ' ' << i;
      }
    }
  }
  EXPECT_EQ(recorded(-3'000'000, {100}).words,
            "its clock steps back once, by 3.000 s; its times go on from there");
  EXPECT_EQ(recorded(-3'000'000, {100, 200}).words,
            "its clock steps back 2 times, by 3.000 s at most; its times go on from there");
  EXPECT_EQ(recorded(0, {}).words, "");
}

TEST(SteadyTime, AStepThatIsTakenBackLeavesNoTrace) {
  SteadyTime time;
  for (int i = 0; i < 300; ++i) {
    const std::int64_t clock_us = kStart + 10'000L * i - (i >= 100 && i < 200 ? kHour : 0);
    const auto time_us =
        static_cast<std::int64_t>(time.of(static_cast<std::uint64_t>(clock_us))) - kStart;
    EXPECT_EQ(time_us, 10'000L * i);
  }
}

// Packets of two interfaces of which one is 200 ms late in the file, or a little.
TEST(SteadyTime, DisorderIsNoStep) {
  for (const std::uint64_t late_ms : {5UL, 40UL, 200UL}) {
    SteadyTime time;
    std::uint64_t newest_us = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const std::uint64_t clock_us = kStart + 10'000 * i;
      newest_us = std::max(newest_us, time.of(clock_us));
      newest_us = std::max(newest_us, time.of(clock_us - 1'000UL * late_ms));
    }
    EXPECT_LE(newest_us, kStart + 2'990'000) << late_ms;
    EXPECT_GE(newest_us, kStart + 2'980'000) << late_ms;
    EXPECT_EQ(time.words().empty(), late_ms < 50) << time.words();
  }
}

TEST(SteadyTime, StepsAheadAreKeptAndTold) {
  const Recorded its = recorded(2 * kHour, {150});
  EXPECT_EQ(its.since_start_us.back(), 2'990'000 + 2 * kHour);
  EXPECT_EQ(its.words,
            "nothing comes for more than 1 s, or its clock steps ahead, once, by 7200.000 s");
}

// The header of a pcap says the unit of its times, and some programs write the other one
// (draft-ietf-opsawg-pcap, 4: 0xA1B2C3D4 of microseconds, 0xA1B23C4D of nanoseconds). 300 packets,
// 10 ms apart.
constexpr std::uint64_t kStartUs = kStart;

TEST(PcapReader, TimesOfAnotherUnitThanTheHeaderSaysAreTold) {
  constexpr std::size_t kHeaderBytes = 24;
  constexpr std::size_t kPacketBytes = 16 + 14 + 20 + 8 + 20;
  const tests::TemporaryFolder folder;
  const std::string path = folder / "drive.pcap";
  struct Written {
    bool promises_ns;
    bool has_ns;
    std::string words;
  };
  for (const auto& [promises_ns, has_ns, words] :
       {Written{false, false, ""}, Written{true, true, ""},
        Written{false, true,
                "its header promises microseconds, and its times are nanoseconds, as which they "
                "are read"},
        Written{
            true, false,
            "its header promises nanoseconds, and all packets come in the first millisecond of "
            "a second: if its times are microseconds, its magic number has to be 0xA1B2C3D4"}}) {
    PcapWriter writer(path);
    for (std::uint64_t i = 0; i < 300; ++i) {
      CapturedDatagram datagram;
      datagram.time_us = kStartUs + 10'000 * i;
      datagram.payload.resize(20);
      writer.write(datagram);
    }
    writer.finish();
    std::vector<std::byte> bytes = read_file(path);
    ASSERT_EQ(bytes.size(), kHeaderBytes + 300 * kPacketBytes);
    wire::store_le32(std::span(bytes).first<4>(), promises_ns ? 0xA1B23C4D : 0xA1B2C3D4);
    for (std::size_t at = kHeaderBytes + 4; has_ns && at < bytes.size(); at += kPacketBytes) {
      const auto fraction = std::span(bytes).subspan(at).first<4>();
      wire::store_le32(fraction, wire::load_le32(fraction) * 1000);
    }
    OutputFile file(path);
    file.write(bytes);
    file.finish();
    PcapReader reader(path);
    std::uint64_t last_us = 0;
    while (const auto datagram = reader.next()) {
      last_us = datagram->time_us;
    }
    EXPECT_EQ(reader.clock_words(), words);
    EXPECT_EQ(last_us, kStartUs + (promises_ns && !has_ns ? 2'000'990 : 2'990'000));
  }
}

TEST(CaptureClock, NeverRunsBackAndShortensPauses) {
  CaptureClock clock;
  EXPECT_EQ(clock.move_to(5'000'000), 0U);
  EXPECT_EQ(clock.move_to(5'040'000), 40'000U);
  EXPECT_EQ(clock.move_to(5'030'000), 40'000U);
  EXPECT_EQ(clock.move_to(5'041'000), 41'000U);
  EXPECT_EQ(clock.move_to(99'000'000'000), 1'041'000U);
}

}  // namespace
}  // namespace iog::tools
