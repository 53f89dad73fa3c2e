// Logs of satellite receivers. What is expected comes from their documents: NMEA 0183's well-known
// example sentences, u-blox's layout of NAV-PVT written here by its offsets.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gtest/gtest.h"

#include "tools/poses/pose_log.hpp"
#include "tools/simulate/random.hpp"

namespace iog::tools {
namespace {

const double kDegree = std::acos(-1.0) / 180;

PoseLog nmea_log(std::string_view text) {
  return read_nmea_log(std::as_bytes(std::span(text.data(), text.size())));
}

std::string sealed(std::string_view sentence) {
  unsigned sum = 0;
  for (const char letter : sentence) {
    sum ^= static_cast<unsigned char>(letter);
  }
  constexpr std::string_view kHex = "0123456789ABCDEF";
  return "$" + std::string(sentence) + "*" + kHex[sum / 16] + kHex[sum % 16] + "\r\n";
}

constexpr std::string_view kRmc =
    "$GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W*6A\r\n";
constexpr std::string_view kGga =
    "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n";

TEST(NmeaLog, ReadsTheExampleSentences) {
  const PoseLog log = nmea_log(std::string(kRmc) + std::string(kGga));
  ASSERT_EQ(log.poses.size(), 1U);
  EXPECT_EQ(log.poses[0].time_us, 764'426'119'000'000U);  // 1994-03-23 12:35:19 UTC
  EXPECT_NEAR(log.poses[0].heading_rad.value_or(0), 5.6 * kDegree, 1e-12);
  EXPECT_NEAR(log.poses[0].speed_mps.value_or(0), 22.4 * 1852 / 3600, 1e-9);
  EXPECT_TRUE(log.remarks.empty());
}

TEST(NmeaLog, PlacesAreMetresFromTheFirst) {
  const PoseLog log =
      nmea_log(std::string(kRmc) +
               sealed("GNRMC,123519.20,A,4807.0390,N,01130.9980,E,022.4,084.4,230394,,,A"));
  ASSERT_EQ(log.poses.size(), 2U);
  EXPECT_EQ(log.poses[1].time_us - log.poses[0].time_us, 200'000U);
  EXPECT_NEAR(log.poses[1].y_m, 1.853, 0.005);   // a thousandth of a minute
  EXPECT_NEAR(log.poses[1].x_m, -2.481, 0.005);  // two, at 48 degrees
}

TEST(NmeaLog, AHeadingGoesBeforeACourse) {
  const PoseLog log = nmea_log(std::string(kRmc) + sealed("GPHDT,264.4,T"));
  EXPECT_NEAR(log.poses.at(0).heading_rad.value_or(0), (90 - 264.4) * kDegree, 1e-12);
  // It reverses.
  EXPECT_NEAR(log.poses[0].speed_mps.value_or(0), -22.4 * 1852 / 3600, 1e-9);
}

TEST(NmeaLog, ACarThatStandsHasNoCourse) {
  const PoseLog log = nmea_log(sealed("GPRMC,123519,A,4807.038,N,01131.000,E,0.3,084.4,230394,,"));
  ASSERT_EQ(log.poses.size(), 1U);
  EXPECT_FALSE(log.poses[0].heading_rad);
}

TEST(NmeaLog, GgaAndHdtAreEnough) {
  const PoseLog log =
      nmea_log(sealed("GPGGA,235959.9,4807.038,N,01131.000,E,4,08,0.9,545.4,M,46.9,M,,") +
               sealed("GPHDT,90.0,T") +
               sealed("GPGGA,000000.0,4807.038,N,01131.001,E,4,08,0.9,545.4,M,46.9,M,,") +
               sealed("GPHDT,90.0,T"));
  ASSERT_EQ(log.poses.size(), 2U);
  EXPECT_EQ(log.poses[1].time_us - log.poses[0].time_us, 100'000U);  // over midnight
  EXPECT_NEAR(log.poses[1].heading_rad.value_or(1), 0, 1e-12);
}

TEST(NmeaLog, WhatIsNotUsedIsCounted) {
  std::string damaged(kRmc);
  damaged[20] = '9';
  const PoseLog log = nmea_log(
      damaged + "nonsense\n" + sealed("GPHDT,10,T") + sealed("GPRMC,123520,V,,,,,,,230394,,") +
      sealed("GPRMC,123521,A,4807.038,N,01131.000,E,9,9,230394,,") +
      sealed("GPGGA,123521,,,,,0,00,,,M,,M,,") + sealed("GPGSV,3,1,11,03") +
      sealed("GPRMC,126099,A,4807.038,N,01131.000,E,9,9,230394,,") +
      sealed("GPRMC,123522,A,4867.038,N,01131.000,E,9,9,230394,,") + std::string(kRmc) +
      "$GPHDT,10,T\n");
  EXPECT_EQ(log.poses.size(), 1U);
  EXPECT_EQ(log.remarks,
            (std::vector<std::string>{"4 lines that are no sound NMEA sentence (first: line 1)",
                                      "1 sentence without a checksum (line 11)",
                                      "1 sentence other than RMC, GGA, HDT and VTG",
                                      "2 times without a fix (first: line 4)"}));
}

// 5 m/s east, through a stop of nobody's notice, and back.
TEST(NmeaLog, ACarThatReversesDoesNotTurnAbout) {
  std::string text;
  for (int i = 0; i < 40; ++i) {
    text += sealed("GPRMC,12000" + std::to_string(i / 10) + '.' + std::to_string(i % 10) +
                   ",A,4807.038,N,01131.000,E,9.72," + (i < 20 ? "90.0" : "270.0") + ",010524,,,A");
  }
  const PoseLog log = nmea_log(text);
  ASSERT_EQ(log.poses.size(), 40U);
  for (int i = 0; i < 40; ++i) {
    const LoggedPose& pose = log.poses[static_cast<std::size_t>(i)];
    EXPECT_NEAR(std::remainder(pose.heading_rad.value_or(9), 360 * kDegree), 0, 1e-9) << i;
    EXPECT_NEAR(pose.speed_mps.value_or(0), i < 20 ? 5 : -5, 0.01) << i;
  }
}

// A time of the first of May 2024, unless another date is given.
std::string rmc(std::string_view time, std::string_view date = "010524", char status = 'A') {
  return sealed("GNRMC," + std::string(time) + ',' + status + ",4807.038,N,01131.000,E,0.0,," +
                std::string(date) + ",,,A");
}
std::string gga(std::string_view time, int quality = 4) {
  return sealed("GAGGA," + std::string(time) + ",4807.038,N,01131.000,E," +
                std::to_string(quality) + ",12,0.8,100.0,M,45.0,M,,");
}

std::vector<std::uint64_t> seconds_of(std::string_view text) {
  std::vector<std::uint64_t> seconds;
  for (const LoggedPose& pose : nmea_log(text).poses) {
    seconds.push_back(pose.time_us / 1'000'000);
  }
  return seconds;
}

// date -u -d 2024-01-01 +%s and so on. A date is of its own time; others are counted from it.
TEST(NmeaLog, DaysAreCountedFromTheNearestDate) {
  using Seconds = std::vector<std::uint64_t>;
  constexpr std::uint64_t kNewYear = 1'704'067'200;
  const Seconds around{kNewYear - 1, kNewYear, kNewYear + 1};
  EXPECT_EQ(seconds_of(gga("235959") + gga("000000") + rmc("000001", "010124")), around);
  EXPECT_EQ(seconds_of(rmc("235959", "311223") + gga("000000") + gga("000001")), around);
  EXPECT_EQ(seconds_of(rmc("235959", "") + rmc("000000", "010124") + rmc("000001", "")), around);
  EXPECT_EQ(seconds_of(gga("235959") + rmc("235959", "311223") + gga("000000") +
                       rmc("000000", "010124") + gga("000001")),
            around);
  // The leap second has no number of its own in Unix time.
  EXPECT_EQ(seconds_of(rmc("235959", "311216") + gga("235960") + rmc("000000", "010117")),
            (Seconds{1'483'228'799, 1'483'228'800, 1'483'228'800}));
  // Before its first fix a receiver lives in 1980 and at any time of day.
  EXPECT_EQ(
      seconds_of(rmc("235950", "050180", 'V') + gga("235951", 0) + rmc("000003", "060180", 'V') +
                 gga("235958") + gga("235959") + rmc("000000", "010124")),
      (Seconds{kNewYear - 2, kNewYear - 1, kNewYear}));
  EXPECT_EQ(seconds_of(rmc("120000", "") + rmc("120001", "")), (Seconds{43'200, 43'201}));
  EXPECT_EQ(nmea_log(rmc("120000", "")).notes.at(0),
            "no date in it: times are those of 1970-01-01");
}

TEST(NmeaLog, FindsSentencesInWhateverIsAroundThem) {
  const std::string line = rmc("120000");
  const std::string bare = line.substr(0, line.size() - 2);
  // NAV-SAT of eight bytes: two line ends, a dollar, zeros.
  const std::string ubx("\xB5\x62\x01\x35\x08\x00\r\n$\0\0\0\0\0\x79\x29", 16);
  const std::string among = std::string(ubx).append(line).append(ubx);
  for (const std::string& text :
       {"\xEF\xBB\xBF" + line, bare + "\r" + rmc("120001"), bare + "\n" + rmc("120001"),
        among + rmc("120001"), "12:00:00.013 " + line, "\xB5\x62\x01" + line}) {
    const PoseLog log = nmea_log(text);
    ASSERT_FALSE(log.poses.empty()) << text;
    EXPECT_EQ(log.poses[0].time_us, 1'714'564'800'000'000U);
    EXPECT_LE(log.remarks.size(), 1U) << log.remarks.at(0);
  }
  EXPECT_EQ(nmea_log(among).remarks.at(0), "2 UBX messages between the lines");
}

// A car that turns about itself for ten seconds, 30 degrees a second clockwise, as a receiver tells
// it whose HDT comes before the sentences with a time, behind them or between them.
struct TurningLog {
  std::size_t place_every = 1;  // ticks
  std::size_t heading_every = 1;
  double tick_s = 0.2;
  char order = 'b';  // before, after, middle
  std::size_t cut = 0;
  std::size_t lose_every = 0;
  bool is_open = false;
};

std::string text_of(const TurningLog& recipe) {
  std::vector<std::string> sentences;
  for (std::size_t tick = 0; static_cast<double>(tick) * recipe.tick_s < 9.95; ++tick) {
    const double seconds = static_cast<double>(tick) * recipe.tick_s;
    const std::string tenths = std::to_string(std::lround(seconds * 10));
    const std::string time =
        "12000" + (tenths.size() > 1 ? tenths.substr(0, 1) : "0") + '.' + tenths.back();
    std::string heading;
    if (tick % recipe.heading_every == 0) {
      heading = sealed("HEHDT," + std::to_string(std::fmod(350 + 30 * seconds, 360)) + ",T");
    }
    const bool has_place = tick % recipe.place_every == 0;
    for (const std::string& sentence :
         {recipe.order == 'b' ? heading : "", has_place ? gga(time) : "",
          recipe.order == 'm' ? heading : "", has_place ? rmc(time) : "",
          recipe.order == 'a' ? heading : ""}) {
      if (!sentence.empty()) {
        sentences.push_back(sentence);
      }
    }
  }
  std::string text;
  for (std::size_t i = recipe.cut; i < sentences.size(); ++i) {
    const bool is_lost = recipe.lose_every > 0 && i % recipe.lose_every == 3;
    text += is_lost ? "" : sentences[i];
  }
  return text;
}

TEST(NmeaHeadings, AreOfTheirOwnTime) {
  const std::vector<TurningLog> recipes{
      {.order = 'b'},
      {.order = 'a'},
      {.order = 'm'},
      {.heading_every = 5, .order = 'b'},
      {.heading_every = 5, .order = 'a'},
      {.heading_every = 5, .order = 'm'},
      {.place_every = 10, .tick_s = 0.1, .order = 'a'},
      {.place_every = 10, .tick_s = 0.1, .order = 'm'},
      {.place_every = 10, .tick_s = 0.1, .order = 'b', .is_open = true},
      {.place_every = 10, .tick_s = 0.1, .order = 'a', .cut = 2, .is_open = true},
      {.order = 'b', .cut = 1, .is_open = true},
      {.order = 'a', .cut = 2, .is_open = true},
      {.order = 'm', .cut = 1},
      {.order = 'b', .lose_every = 11},
      {.order = 'a', .lose_every = 13},
      {.order = 'm', .lose_every = 7},
      {.heading_every = 5, .order = 'b', .lose_every = 17},
      {.place_every = 10, .tick_s = 0.1, .order = 'a', .lose_every = 23, .is_open = true},
      {.place_every = 2, .heading_every = 5, .tick_s = 0.1, .order = 'b', .is_open = true}};
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    const PoseLog log = nmea_log(text_of(recipes[i]));
    const double rows = 9.95 / recipes[i].tick_s / static_cast<double>(recipes[i].place_every);
    EXPECT_GE(static_cast<double>(log.poses.size()), rows * 0.9 - 1) << i;
    std::size_t known = 0;
    double doubt = 0;
    for (const LoggedPose& pose : log.poses) {
      const double seconds = static_cast<double>(pose.time_us % 60'000'000) / 1e6;
      doubt = std::max(doubt, pose.heading_doubt_rad);
      if (pose.heading_rad && pose.heading_doubt_rad < 0.2) {
        ++known;
        const double off =
            std::remainder(*pose.heading_rad - (100 - 30 * seconds) * kDegree, 360 * kDegree);
        EXPECT_LE(std::abs(off), pose.heading_doubt_rad + 0.01 * kDegree) << i << ' ' << seconds;
      }
    }
    EXPECT_GE(static_cast<double>(known), rows * 0.8 - 5) << i;
    EXPECT_TRUE((doubt > 0.01) == recipes[i].is_open || recipes[i].lose_every > 0) << i << doubt;
    EXPECT_EQ(!log.notes.empty() && log.notes[0].find("leaves open") != std::string::npos,
              recipes[i].is_open)
        << i;
  }
}

void put(std::vector<std::byte>& bytes, std::size_t offset, std::size_t count,
         std::uint64_t value) {
  for (std::size_t i = 0; i < count; ++i) {
    bytes[offset + i] = static_cast<std::byte>(value >> (8 * i) & 0xFFU);
  }
}

struct PvtFields {
  std::int32_t nanoseconds = 0;
  std::int32_t longitude = 115'166'667;  // 1e-7 degrees
  std::int32_t latitude = 481'173'000;
  std::uint8_t flags = 1;
  std::int32_t north_mm_s = 2'500;
  std::int32_t east_mm_s = -4'330;
  std::int32_t course = 30'000'000;  // 300 degrees
  std::uint8_t second = 56;
  std::size_t payload_bytes = 92;
};

// u-blox's header, payload by its offsets, and Fletcher's checksum.
std::vector<std::byte> pvt_message(const PvtFields& fields) {
  const std::size_t end = 6 + fields.payload_bytes;
  std::vector<std::byte> bytes(std::max<std::size_t>(end + 2, 100));
  put(bytes, 0, 4, 0x0701'62B5);
  put(bytes, 4, 2, fields.payload_bytes);
  constexpr std::size_t kPayload = 6;
  put(bytes, kPayload + 4, 2, 2024);
  put(bytes, kPayload + 6, 1, 5);
  put(bytes, kPayload + 7, 1, 1);
  put(bytes, kPayload + 8, 1, 12);
  put(bytes, kPayload + 9, 1, 34);
  put(bytes, kPayload + 10, 1, fields.second);
  put(bytes, kPayload + 11, 1, 0x07);
  put(bytes, kPayload + 16, 4, std::bit_cast<std::uint32_t>(fields.nanoseconds));
  put(bytes, kPayload + 20, 1, 3);
  put(bytes, kPayload + 21, 1, fields.flags);
  put(bytes, kPayload + 24, 4, std::bit_cast<std::uint32_t>(fields.longitude));
  put(bytes, kPayload + 28, 4, std::bit_cast<std::uint32_t>(fields.latitude));
  put(bytes, kPayload + 48, 4, std::bit_cast<std::uint32_t>(fields.north_mm_s));
  put(bytes, kPayload + 52, 4, std::bit_cast<std::uint32_t>(fields.east_mm_s));
  put(bytes, kPayload + 64, 4, std::bit_cast<std::uint32_t>(fields.course));
  put(bytes, kPayload + 68, 4, 123);        // mm/s
  put(bytes, kPayload + 72, 4, 150'000);    // 1.5 degrees
  put(bytes, kPayload + 84, 4, 9'000'000);  // 90 degrees
  bytes.resize(end + 2);
  unsigned a = 0;
  unsigned b = 0;
  for (std::size_t i = 2; i < end; ++i) {
    a = (a + std::to_integer<unsigned>(bytes[i])) & 0xFFU;
    b = (b + a) & 0xFFU;
  }
  put(bytes, end, 1, a);
  put(bytes, end + 1, 1, b);
  return bytes;
}

std::vector<std::byte> joined(std::initializer_list<std::vector<std::byte>> parts) {
  std::vector<std::byte> all;
  for (const auto& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

TEST(UbxLog, TakesTheFieldsByTheirOffsets) {
  const PoseLog log = read_ubx_log(
      joined({pvt_message({}), pvt_message({.nanoseconds = -100'000, .latitude = 481'174'000})}));
  ASSERT_EQ(log.poses.size(), 2U);
  const LoggedPose& pose = log.poses[0];
  EXPECT_EQ(pose.time_us, 1'714'566'896'000'000U);  // 2024-05-01 12:34:56 UTC
  EXPECT_EQ(log.poses[1].time_us, pose.time_us - 100);
  EXPECT_NEAR(log.poses[1].y_m, 11.12, 0.01);
  EXPECT_NEAR(pose.heading_rad.value_or(0), (90 - 300) * kDegree, 1e-12);
  EXPECT_NEAR(pose.speed_mps.value_or(0), 5, 1e-3);
  EXPECT_NEAR(pose.sigma_m.value_or(0), 0.123, 1e-12);
  EXPECT_NEAR(pose.sigma_heading_rad.value_or(0), 1.5 * kDegree, 1e-12);
  EXPECT_TRUE(log.remarks.empty());
}

TEST(UbxLog, AVehiclesHeadingGoesBeforeACourse) {
  const PoseLog log = read_ubx_log(pvt_message({.flags = 0x21}));
  EXPECT_NEAR(log.poses.at(0).heading_rad.value_or(1), 0, 1e-12);
  EXPECT_NEAR(log.poses[0].speed_mps.value_or(0), -4.33, 1e-3);
}

// u-blox 7 writes 84 bytes, without a vehicle's heading, whatever its flags; later ones may append.
TEST(UbxLog, ReadsShorterAndLongerMessages) {
  const auto old = read_ubx_log(pvt_message({.flags = 0x21, .payload_bytes = 84}));
  EXPECT_NEAR(old.poses.at(0).heading_rad.value_or(0), (90 - 300) * kDegree, 1e-12);
  const auto later = read_ubx_log(pvt_message({.flags = 0x21, .payload_bytes = 100}));
  EXPECT_NEAR(later.poses.at(0).heading_rad.value_or(1), 0, 1e-12);
  EXPECT_EQ(read_ubx_log(pvt_message({.payload_bytes = 83})).remarks.at(0),
            "1 message other than NAV-PVT");
  // As long as RXM-RAWX with 255 measurements, and longer than any.
  EXPECT_EQ(read_ubx_log(pvt_message({.payload_bytes = 8'176})).poses.size(), 1U);
  EXPECT_TRUE(read_ubx_log(pvt_message({.payload_bytes = 8'177})).poses.empty());
}

TEST(UbxLog, WhatIsNotUsedIsCounted) {
  auto damaged = pvt_message({});
  damaged[40] ^= std::byte{1};
  auto other = pvt_message({});
  other[3] = std::byte{0x35};  // NAV-SAT
  put(other, 98, 1, std::to_integer<unsigned>(other[98]) + 0x2E);
  put(other, 99, 1, std::to_integer<unsigned>(other[99]) + 0x2EU * 95U);
  const PoseLog log = read_ubx_log(
      joined({damaged, other, pvt_message({.flags = 0}), pvt_message({.latitude = 910'000'000}),
              pvt_message({}), std::vector<std::byte>(3)}));
  EXPECT_EQ(log.poses.size(), 1U);
  EXPECT_EQ(log.remarks, (std::vector<std::string>{
                             "103 bytes that are no UBX message", "1 message other than NAV-PVT",
                             "2 NAV-PVT without a fix or a time (first: NAV-PVT 1)"}));
}

// Whatever comes: no reader looks beyond its bytes (the sanitizers watch), and none believes it.
TEST(PoseLogs, DamageIsSurvived) {
  Random random(1);
  const auto ubx = joined({pvt_message({}), pvt_message({}), pvt_message({})});
  const std::string nmea = std::string(kRmc) + std::string(kGga) + sealed("GPHDT,10,T");
  for (int i = 0; i < 3000; ++i) {
    auto bytes = i % 2 == 0 ? ubx : std::vector<std::byte>();
    if (bytes.empty()) {
      const auto text = std::as_bytes(std::span(nmea));
      bytes.assign(text.begin(), text.end());
    }
    bytes.resize(random.below(bytes.size() + 1));
    for (std::size_t hit = 0; !bytes.empty() && hit < 3; ++hit) {
      bytes[random.below(bytes.size())] = static_cast<std::byte>(random.below(256));
    }
    EXPECT_LE(read_ubx_log(bytes).poses.size(), 3U);
    EXPECT_LE(read_nmea_log(bytes).poses.size(), 1U);
  }
}

}  // namespace
}  // namespace iog::tools
