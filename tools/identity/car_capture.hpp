// Captures of a car, and a log of its poses beside them. An offset corrects clocks that differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pose/message.hpp"
#include "tools/formats/capture/capture_set.hpp"
#include "tools/identity/car_clocks.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/vehicles/named_senders.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// What is given of a drive.
struct DriveFiles {
  std::vector<std::string> captures{};
  std::string poses{};  // a log as of read_pose_log(); empty: they are in the captures
  std::vector<double> poses_mount{};  // x and y in metres, perhaps the yaw in degrees; empty: none
  std::vector<double> poses_sigma{};  // mm and mrad in a second, instead of the log's; empty: none
  std::optional<double> clock_offset_s{};  // added to the clock of the poses
  bool finds_clock_offset = false;         // instead, by the motion in log and captures
  [[nodiscard]] std::string name() const;  // of the captures, for messages
};

// The log as poses of the car. UsageError as of read_pose_log(), or if no pose is left.
[[nodiscard]] ConvertedLog log_of(const DriveFiles& drive, const CatalogueEntry& car);

class CarCapture {
 public:
  // An offset is added to the clock of the poses. If the capture times of their datagrams are of
  // that clock, too, as after merging a log with the packets, these are shifted as well.
  // Poses of a log come at their own times, instead of those in the captures: by the captures'
  // clock or, if an offset is given, by the sensors'; from a second before the first packet to a
  // second behind the last one. UsageError as of PcapReader and
  // read_pose_log(), if packets and log have no time in common, if the motion shows no offset that
  // is to be found, and, with an offset or a log, for what can be read only once.
  CarCapture(const DriveFiles& drive, const CatalogueEntry& car);

  [[nodiscard]] std::optional<CapturedDatagram> next();

  [[nodiscard]] const CaptureSet& files() const { return files_; }
  // As of PcapReader; nothing if poses come at other times.
  [[nodiscard]] std::optional<PcapReader::Place> place() const;
  void go_to(const PcapReader::Place& place) { files_.go_to(place); }

  // Words for a difference between the clocks of poses, packets and captures or between captures.
  // Empty if there is none. Complete when everything has been read.
  [[nodiscard]] std::string time_words() const;
  // The same, with words for packets of strangers.
  [[nodiscard]] std::string clock_words() const;
  // As of CarClocks. Complete when everything has been read.
  [[nodiscard]] std::string words_of_crowd() const { return clocks_.words_of_crowd(); }
  [[nodiscard]] std::vector<std::string> words_of_lost() const { return clocks_.words_of_lost(); }
  // What is to be told of the log.
  [[nodiscard]] std::vector<std::string> remarks() const;

 private:
  [[nodiscard]] bool is_distant(std::uint64_t pose_us,
                                const std::optional<CapturedDatagram>& packet) const;
  // That the log begins later than the packets or ends before them.
  [[nodiscard]] std::string words_of_cover() const;
  // Whether it is of a stranger, or a pose that comes at another time. Counts it.
  [[nodiscard]] bool is_left_out(const CapturedDatagram& datagram) {
    const std::uint16_t port = datagram.destination.port;
    const bool is_unused = is_merged_ && is_pose_port(*car_, port);
    unused_poses_ += is_unused && has_log_ ? 1U : 0U;
    return is_unused || senders_.is_stranger(datagram.source.ipv4, port);
  }
  // The offset in the pose's message, if it is one; those of a log are numbered anew.
  void put_ahead(CapturedDatagram& pose);
  // The delay of the poses, found at the beginning of the files.
  [[nodiscard]] std::int64_t delay_of_poses(const DriveFiles& drive);
  void read_poses(const DriveFiles& drive);
  void read_log(const DriveFiles& drive);

  const CatalogueEntry* car_;
  bool has_log_;
  std::int64_t offset_us_;
  std::optional<std::int64_t> found_us_;  // how much the log is behind the captures by motion
  CaptureSet files_;
  CarClocks clocks_;
  pose::Encoder encoder_;
  std::vector<std::string> log_words_;
  NamedSenders senders_;
  std::uint64_t unused_poses_ = 0;       // in the captures, beside a log
  bool is_merged_ = false;               // the poses do not come as they stand in the files
  std::vector<CapturedDatagram> poses_;  // then all of them
  std::size_t next_pose_ = 0;
  std::optional<CapturedDatagram> packet_;  // that comes behind them
};

// As of PcapReader, remarks(), clock_words(), words_of_crowd() and words_of_lost().
void warn_of(const DriveFiles& drive, const CarCapture& capture);

}  // namespace iog::tools
