// A sensor that stops, and scans that are longer than a frame, leave a plausible grid.
#include "tools/identity/sensor_watch.hpp"

#include <array>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/points_packet.hpp"
#include "fakes/velodyne_packet.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kBeginUs = 1'700'000'000'000'000;

// Every 100 ms a datagram of each sensor of a car with two, but for some.
class TwoSensors {
 public:
  // to_ds: in tenths of a second.
  void send(std::uint64_t from_ds, std::uint64_t to_ds, bool of_first, bool of_second) {
    for (std::uint64_t i = from_ds; i < to_ds; ++i) {
      for (std::size_t sensor = 0; sensor < 2; ++sensor) {
        if (sensor == 0 ? of_first : of_second) {
          watch_.take({.time_us = kBeginUs + i * 100'000 + sensor,
                       .source = {},
                       .destination = {.ipv4 = 0, .port = car_->sensors[sensor].udp_port},
                       .payload = {}});
        }
      }
    }
  }
  [[nodiscard]] std::string rows() const { return watch_.rows_of_silence(); }
  [[nodiscard]] std::string name(std::size_t sensor) const {
    return std::string(car_->sensors[sensor].name);
  }

 private:
  const CatalogueEntry* car_ = &find_vehicle("two_lux_parking");
  SensorWatch watch_{*car_};
};

TEST(SensorWatch, ASensorThatStopsIsTold) {
  TwoSensors car;
  car.send(0, 30, true, true);
  car.send(30, 100, true, false);
  EXPECT_EQ(car.rows(), row("SILENT?", car.name(1) + " sends nothing from 2.9 s on"));
}

TEST(SensorWatch, TheLongestSilenceIsTold) {
  TwoSensors car;
  car.send(0, 15, false, true);
  car.send(15, 30, true, true);
  car.send(30, 60, false, true);
  car.send(60, 75, true, true);
  EXPECT_EQ(car.rows(), row("SILENT?", car.name(0) + " sends nothing from 2.9 s to 6.0 s"));
}

TEST(SensorWatch, ASensorThatNeverSendsIsTold) {
  TwoSensors car;
  car.send(0, 20, false, true);
  EXPECT_EQ(car.rows(), row("SILENT?", car.name(0) + " sends nothing"));
}

// A car without a packet is told of elsewhere.
TEST(SensorWatch, ShortSilencesAndPausesOfTheRecordingAreNone) {
  TwoSensors car;
  EXPECT_EQ(car.rows(), "");
  car.send(0, 20, true, true);
  car.send(20, 28, true, false);
  car.send(28, 40, true, true);
  car.send(100, 120, true, true);
  EXPECT_EQ(car.rows(), "");
  car.send(120, 128, true, false);
  EXPECT_EQ(car.rows(), "");
}

// Scans of 10 packets, 10 ms from one to the next, and so many of them fused.
std::string told_of_late(std::uint32_t frame_period_us, std::uint64_t fused, std::uint64_t late) {
  CatalogueEntry car = find_vehicle("robot_2d");
  vehicle::Vehicle vehicle = *car.vehicle;
  vehicle.frame_period_us = frame_period_us;
  car.vehicle = &vehicle;
  SensorWatch watch(car);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const tests::PointsPacket packet{.scan_number = 1 + i / 10,
                                     .number = static_cast<int>(i % 10),
                                     .datagrams = 10,
                                     .time_us = kBeginUs + i / 10 * 100'000};
    const std::vector<std::byte> bytes = packet.bytes();
    watch.take({.time_us = kBeginUs + i * 10'000,
                .source = {},
                .destination = {.ipv4 = 0, .port = car.sensors[0].udp_port},
                .payload = bytes});
  }
  const std::array<std::uint64_t, 1> counts{fused};
  return watch.rows_of_late(counts, late);
}

TEST(SensorWatch, ScansThatAreLongerThanAFrameAreTold) {
  EXPECT_EQ(told_of_late(40'000, 80, 120),
            row("LATE?",
                "120 of 200 packets of front come after their frame has ended: a scan lasts 90 ms, "
                "and a frame ends after 40 ms: set frame_period_us = 150000 in the car file"));
  EXPECT_EQ(told_of_late(150'000, 80, 120),
            row("LATE?", "120 of 200 packets of front come after their frame has ended"));
  EXPECT_EQ(told_of_late(40'000, 180, 20), "");
  EXPECT_EQ(told_of_late(40'000, 80, 0), "");  // dropped for another reason
}

// 12 blocks of so many hundredths of a degree, 1327 us from packet to packet (VLP-16 User Manual).
std::string told_of_turns(std::uint32_t frame_period_us, int step, int packets) {
  CatalogueEntry car = find_vehicle("roof_vlp16");
  vehicle::Vehicle vehicle = *car.vehicle;
  vehicle.frame_period_us = frame_period_us;
  car.vehicle = &vehicle;
  SensorWatch watch(car);
  for (int i = 0; i < packets; ++i) {
    const std::vector<std::byte> bytes =
        tests::VelodynePacket{.first_azimuth = i * 12 * step % 36'000, .step = step}.bytes();
    watch.take({.time_us = kBeginUs + static_cast<std::uint64_t>(i) * 1'327,
                .source = {},
                .destination = {.ipv4 = 0, .port = car.sensors[0].udp_port},
                .payload = bytes});
  }
  return watch.rows_of_turns();
}

// 150 packets are a turn at 5 Hz.
TEST(SensorWatch, TurnsThatAreLongerThanAFrameAreTold) {
  const std::string words = row(
      "PARTIAL?",
      "a turn of roof takes 199 ms, and a frame ends after 150 ms: set frame_period_us = 299000 "
      "in the car file");
  EXPECT_EQ(told_of_turns(150'000, 20, 460), words);
  EXPECT_EQ(told_of_turns(299'000, 20, 460), "");
  EXPECT_EQ(told_of_turns(150'000, 40, 460), "");
  EXPECT_EQ(told_of_turns(40'000, 20, 460), "");  // a part of a turn by intention
  EXPECT_EQ(told_of_turns(150'000, 20, 440), "");
}

}  // namespace
}  // namespace iog::tools
