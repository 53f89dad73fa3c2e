// Poses that somebody has logged, in whatever format, and how they become what a source sends.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/poses/map_origin.hpp"
#include "tools/poses/pose_sample.hpp"
#include "tools/poses/rigid.hpp"

namespace iog::tools {

// One row of a log. What the log does not say is empty.
struct LoggedPose {
  std::uint64_t time_us = 0;  // since 1970, or since the log's begin
  double x_m = 0;             // of the receiver or lidar, in the log's plane
  double y_m = 0;
  std::optional<double> heading_rad{};  // counter-clockwise from the plane's x
  std::optional<double> speed_mps{};
  std::optional<double> yaw_rate_rps{};
  std::optional<double> sigma_m{};
  std::optional<double> sigma_heading_rad{};
  bool is_tilted = false;        // its z is more than 45 degrees from up
  double heading_doubt_rad = 0;  // what the log leaves open about the heading, beside its sigma
  std::size_t place = 0;         // line of the log, or number of its message; 0: none
};

struct PoseLog {
  std::vector<LoggedPose> poses{};     // in the order of the log
  std::vector<std::string> remarks{};  // what was not used, and why; never silent
  std::vector<std::string> notes{};    // what was taken on an assumption, and which
  std::string_view unit = "line";      // what a place counts
  bool is_of_unit = false;             // poses of the lidar, not of the car or a receiver in it
  std::vector<Rigid> in_space{};       // each of them whole, if they are of the lidar
  // In which x is east and y north, if the log has latitudes: it touches at the first position.
  std::optional<LocalPlane> plane{};
};

// x_m, y_m and heading_deg of a plane, time_s of any clock; optional speed_m_s, yaw_rate_deg_s,
// sigma_m, sigma_heading_deg. The first line names the columns, in any order and perhaps behind a
// '#'; others are not used, which is remarked. Commas, semicolons or tabs separate fields.
// UsageError with file and line for a row that is not what the columns say.
[[nodiscard]] PoseLog read_csv_log(const std::string& path);

// A folder of KITTI's OXTS files: timestamps.txt, and data/0000000000.txt and so on with 30 numbers
// each (readme of the raw data, Geiger and others, 2013). UsageError with file and field for one
// that is not so.
[[nodiscard]] PoseLog read_oxts_log(const std::string& folder);

// NMEA 0183: position, speed, course and date by RMC; position and fix by GGA; true heading by HDT,
// without RMC speed and course by VTG, of the time that nmea_cycle.hpp finds. What has a wrong
// checksum or none, damaged fields and positions without a fix are counted and left out.
[[nodiscard]] PoseLog read_nmea_log(std::span<const std::byte> bytes);

// UBX-NAV-PVT messages of a u-blox receiver (M8 interface description, 32.17.15; u-blox 7 writes
// 84 bytes) among any others. receiver_fixes.hpp says what both make of a course.
[[nodiscard]] PoseLog read_ubx_log(std::span<const std::byte> bytes);

// A trajectory as the TUM RGB-D benchmark has it: timestamp tx ty tz qx qy qz qw. UsageError with
// file and line for a row that is not so.
[[nodiscard]] PoseLog read_tum_log(const std::string& path);

// poses.txt of KITTI's odometry benchmark, which are those of camera 0; beside it times.txt, in
// seconds, and calib.txt, whose Tr brings the unit's frame into the camera's. Poses of the unit in
// its first frame: x forward, y left. UsageError with file and line.
[[nodiscard]] PoseLog read_kitti_log(const std::string& path);

// A line of times.txt, seconds since the drive began, as us since 1970: the drive begins at
// kDriveStartUs, for clouds and poses alike. Nothing if it is no time.
[[nodiscard]] std::optional<std::uint64_t> kitti_time_in(std::string_view line);

// nav_msgs/msg/Odometry of an MCAP file or bag or, if it has none, base_link in
// tf2_msgs/msg/TFMessage, else PoseStamped or PoseWithCovarianceStamped of geometry_msgs; of a
// topic if one is given. UsageError if several topics or parents have
// poses.
[[nodiscard]] PoseLog read_ros_log(const std::string& path, const std::string& topic);

// A log of that format; empty: the one that its name or its first bytes show; "mcap" is any
// recording of ROS 2. "FILE.mcap:/topic" names a topic. UsageError if it is none, cannot be read,
// or as of its format.
inline constexpr std::array<std::string_view, 7> kPoseFormats{"csv", "oxts",  "nmea", "ubx",
                                                              "tum", "kitti", "mcap"};
[[nodiscard]] PoseLog read_pose_log(const std::string& input, const std::string& format = {});

// x, y, z, w. The heading of what is turned so; empty: it is no rotation.
using Quaternion = std::array<double, 4>;
[[nodiscard]] std::optional<double> heading_of(const Quaternion& turn);

// Whether its z is more than 45 degrees from up.
[[nodiscard]] bool is_tilted(const Quaternion& turn);

// The namespace of a vehicle's frame: "robot1/" of robot1/base_link or robot1/base_footprint.
// Nothing if the frame has another name.
[[nodiscard]] std::optional<std::string> robot_of(const std::string& frame);

// The sound UBX message at the beginning of the bytes; empty if there is none.
[[nodiscard]] std::span<const std::byte> ubx_message_at(std::span<const std::byte> bytes);

// How a log becomes poses of the vehicle frame.
struct PoseConversion {
  // How in the vehicle frame the receiver or lidar is mounted whose poses were logged.
  double mount_x_m = 0;
  double mount_y_m = 0;
  double mount_yaw_rad = 0;
  // The user's word, which goes before the log's; empty: the log's or, if it has none, 50 mm and
  // 2 mrad.
  std::optional<double> sigma_m{};
  std::optional<double> sigma_heading_rad{};
  std::uint32_t run = 1;
  // What each pose is to say of the map, if the log has a plane.
  struct Map {
    MapOrigin origin;
    pose::Sigma sigma;
  };
  std::optional<Map> map{};
};

struct ConvertedLog {
  std::vector<PoseSample> samples;   // by rising times, as far apart as the target wants
  std::vector<std::string> remarks;  // those of the log, and what else was left out
  std::vector<std::string> notes;    // those of the log, and what contradicts its positions
  // Poses of the log that are used, and those for which a standard deviation was assumed.
  std::size_t poses = 0;
  std::size_t taken_sigmas = 0;
  std::size_t taken_sigma_headings = 0;
};

// Speed and yaw rate that the log does not say, or says to be 0 throughout, are those between the
// poses before and after. Between poses that are further apart than a target predicts, up to 0.25
// s, others are interpolated. Notes poses that are less precise than a target accepts. Left
// out and remarked with their place in the log: poses without a heading, poses that are not newer
// than the one before or less than 8 ms after it, poses that a message cannot say (pose/limits.hpp)
// and poses that no car reaches from those around them (outliers.hpp).
// UsageError for a log and a map that words_of_far_map() finds too far apart.
[[nodiscard]] ConvertedLog converted(PoseLog log, const PoseConversion& conversion);

// A sentence if the log begins farther from the map's origin than a message can say; else nothing.
[[nodiscard]] std::string words_of_far_map(const PoseLog& log, const MapOrigin& origin);

// UsageError with the reason if there are fewer than the two poses that a target needs to accept a
// source.
void demand_poses(const ConvertedLog& log, const std::string& path);

// A line for each remark and note, and for standard deviations that were assumed.
[[nodiscard]] std::vector<std::string> words_of(const ConvertedLog& log);

// How many were left out, and where the first one is.
struct Tally {
  std::size_t count = 0;
  std::size_t first = 0;

  void add(std::size_t place) { first = count++ == 0 ? place : first; }
};

// "3 poses without a heading" as of counted(), of a tally with " (first: line 12)"; nothing for a
// count of 0.
void remark(std::size_t count, std::string_view what, std::vector<std::string>& remarks);
void remark(const Tally& tally, std::string_view what, std::string_view unit,
            std::vector<std::string>& remarks);

}  // namespace iog::tools
