// A capture of a car, and the clocks in it: that of the poses, and those of the sensors that the
// car's file calls synchronised with it. If they differ (TAI and UTC, GPS and UTC, a wrong year) no
// packet has a pose. The difference is reported, and an offset corrects it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pose/message.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// How far each clock is ahead of the capture's, us, by the time stamps in the datagrams.
class CarClocks {
 public:
  explicit CarClocks(const CatalogueEntry& car) : car_(&car) {}

  void add(const CapturedDatagram& datagram);

  // Whether there is a pose, and enough of each sensor that has a clock.
  [[nodiscard]] bool are_known() const;
  [[nodiscard]] std::int64_t poses_us() const { return poses_us_.value_or(0); }
  // Of the first sensor that has a clock; 0 if there is none, or it is the capture's.
  [[nodiscard]] std::int64_t sensors_us() const;

  // "the packets are 37.000 s ahead of the poses; ..."; empty if poses and packets agree.
  [[nodiscard]] std::string words() const;

 private:
  void add_pose(const CapturedDatagram& datagram);
  void add_packet(const CapturedDatagram& datagram, std::size_t sensor);

  struct Span {
    std::uint64_t first_us = ~std::uint64_t{0};
    std::uint64_t last_us = 0;
    void add(std::uint64_t time_us);
  };

  const CatalogueEntry* car_;
  Span poses_;
  Span packets_;
  std::uint64_t first_pose_us_ = 0;  // by its own clock, and the last one's
  std::uint64_t last_pose_us_ = 0;
  std::optional<std::int64_t> poses_us_;
  std::map<std::size_t, std::vector<std::int64_t>> sensors_us_;  // by sensor
};

class CarCapture {
 public:
  // clock_offset_s is added to the clock of the poses. If the capture times of their datagrams are
  // of that clock, too, as after merging a log with the packets, these are shifted as well.
  // UsageError as of PcapReader, and for an offset if the file can be read only once.
  CarCapture(const std::string& path, const CatalogueEntry& car, double clock_offset_s = 0);

  [[nodiscard]] std::optional<CapturedDatagram> next();

  [[nodiscard]] const PcapReader& file() const { return file_; }
  // As of PcapReader; nothing if poses come at other times.
  [[nodiscard]] std::optional<PcapReader::Place> place() const;
  void go_to(const PcapReader::Place& place) { file_.go_to(place); }

  // How the clocks of poses and packets differ; empty if they agree. Known when all has been read.
  [[nodiscard]] std::string clock_words() const { return clocks_.words(); }

 private:
  // The offset in the pose's message, if it is one.
  void put_ahead(CapturedDatagram& pose);
  // The delay of the poses, found at the beginning of the file.
  [[nodiscard]] std::int64_t delay_of_poses(const std::string& path) const;
  void read_poses(const std::string& path, std::int64_t delay_us);

  const CatalogueEntry* car_;
  std::int64_t offset_us_;
  PcapReader file_;
  CarClocks clocks_;
  pose::Encoder encoder_;
  bool is_merged_ = false;               // the poses do not come as they stand in the file
  std::vector<CapturedDatagram> poses_;  // then all of them
  std::size_t next_pose_ = 0;
  std::optional<CapturedDatagram> packet_;  // that comes behind them
};

// As of PcapReader, and clock_words().
void warn_of(const std::string& path, const CarCapture& capture);

}  // namespace iog::tools
