// iog points: recorded clouds and scans of any lidar as a capture of points.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lidar/scanner_facts.hpp"
#include "tools/clouds/cloud_files.hpp"
#include "tools/clouds/cloud_frames.hpp"
#include "tools/clouds/cloud_set.hpp"
#include "tools/clouds/points_sender.hpp"
#include "tools/clouds/ros_clouds.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/formats/capture/capture_clock.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/formats/ros/bag_files.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/option_use.hpp"
#include "tools/program/progress.hpp"
#include "tools/program/table.hpp"
#include "tools/replay/pace.hpp"
#include "tools/replay/udp_sender.hpp"

namespace iog::tools {
namespace {

struct PointsOptions {
  std::vector<std::string> inputs;
  std::string topic;
  TimeUnit unit = TimeUnit::kFound;
  double clouds_per_second = 10;
  std::string sensor;
  std::string vehicle = kDefaultVehicle;
  std::string out;
  std::string target;
};

// Where datagrams go: into a capture, or to a target at the pace of the recording.
class Destination {
 public:
  Destination(const PointsOptions& options, std::uint16_t port) : options_(&options) {
    if (options.out.empty() == options.target.empty()) {
      throw UsageError("give either --out FILE or --target ADDRESS");
    }
    if (!options.target.empty()) {
      target_.emplace(options.target, std::vector<std::uint16_t>{port});
    }
  }

  void take(const CapturedDatagram& datagram) {
    if (target_) {
      pace_.wait_for(clock_.move_to(datagram.time_us));
      refused_ += target_->send(0, datagram.payload) ? 0U : 1U;
      return;
    }
    if (!capture_) {  // not before the first cloud is known to be one
      capture_.emplace(options_->out);
    }
    capture_->write(datagram);
  }

  // "in drive.pcap"
  [[nodiscard]] std::string finish(std::vector<std::string>& remarks) {
    if (capture_) {
      capture_->finish();
      return "in " + options_->out;
    }
    remark(refused_, "datagram|datagrams was|were refused by the system", remarks);
    return "to " + options_->target;
  }
  // CheckFailed if the system has refused all that was to be sent.
  void demand_sent() const {
    if (target_) {
      target_->demand_sent();
    }
  }

 private:
  const PointsOptions* options_;
  std::optional<PcapWriter> capture_;
  std::optional<UdpSender> target_;
  Pace pace_{1};
  CaptureClock clock_;
  std::uint64_t refused_ = 0;
};

// The one that is named, or the only one of points.
std::size_t sensor_of(const PointsOptions& options, const CatalogueEntry& car) {
  std::vector<std::size_t> fitting;
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    const bool is_meant = options.sensor.empty() || sensor_of_name(car, options.sensor) == i;
    if (is_meant && lidar::facts_of(car.sensors[i].format).is_points) {
      fitting.push_back(i);
    }
  }
  const std::string name(car.vehicle->name);
  if (fitting.empty()) {
    throw UsageError(
        (options.sensor.empty() ? name + " has no sensor" : options.sensor + " is no sensor") +
        " of type points or points_turning: give --vehicle-file FILE of a car that has one");
  }
  if (fitting.size() > 1) {
    throw UsageError(name + " has " + std::to_string(fitting.size()) +
                     " sensors of type points or points_turning: give --sensor NAME of one");
  }
  return fitting[0];
}

void report(const SentClouds& sent, TimeUnit unit, std::vector<std::string> words,
            const std::string& where, std::ostream& out) {
  remark(sent.not_finite, "point|points that is|are no number was|were not sent", words);
  remark(sent.nowhere, "point|points at the sensor or too near was|were not sent", words);
  remark(sent.beyond_layers,
         "point|points is|are beyond the car's layers; the target does not use it|them", words);
  remark(sent.beyond_width,
         "point|points outside the field of view (scan_width_ticks) was|were not sent", words);
  remark(sent.without_stamp,
         "cloud|clouds has|have no stamp (0): frames and poses cannot be matched", words);
  remark(sent.same_stamps, "cloud|clouds has|have the same stamp as the one before", words);
  remark(sent.without_times,
         "cloud|clouds has|have points without times (field t, time or timestamp): while the car "
         "moves, a "
         "spinning unit's points are misplaced",
         words);
  if (2 * sent.parts_of_turns > sent.clouds) {
    words.push_back(std::to_string(sent.parts_of_turns) +
                    " clouds see other directions than the cloud before them. They seem to be "
                    "parts of turns: let the lidar's driver publish whole turns, and record "
                    "again.");
  }
  if (const std::string of_period = words_of_short_period(sent.period_us()); !of_period.empty()) {
    words.push_back(of_period);
  }
  const std::string of_unit = words_of_wrong_unit(unit, sent.longest_span, sent.period_us());
  if (!of_unit.empty()) {
    words.push_back(of_unit);
  }
  if (sent.other_clock > 0) {
    words.push_back(words_of_other_clock(sent.apart_us));
  }
  remark(sent.wrong_times,
         "scan|scans was|were sent without beams' times: time_increment is below 0, no number or "
         "too long",
         words);
  remark(sent.at_once, "scan|scans without time_increment (0): all beams get the time of the stamp",
         words);
  remark(sent.at_range_max, "beam|beams at range_max counts|count as no return", words);
  remark(sent.out_of_order,
         "cloud|clouds out of order skipped (time goes back by up to " +
             std::to_string(sent.furthest_back_ms()) + " ms)",
         words);
  remark(sent.strays,
         "cloud|clouds skipped: its|their stamp|stamps is|are more than 1 s from those before and "
         "after",
         words);
  out << counted(sent.clouds, "cloud|clouds") << ", " << counted(sent.points, "point|points in ")
      << counted(sent.datagrams, "datagram|datagrams ") << where << '\n';
  for (const std::string& word : words) {
    out << word << '\n';
  }
}

// The files of clouds, also those of folders of such files alone, at the place of the first one.
struct Inputs {
  std::vector<std::string> before{};  // recordings and folders of KITTI
  CloudFiles clouds{};
  std::vector<std::string> behind{};
};

Inputs inputs_of(const PointsOptions& options) {
  Inputs all;
  std::vector<std::string> files;
  std::vector<std::vector<std::string>> folders;
  for (const std::string& input : options.inputs) {
    const bool is_folder = std::filesystem::is_directory(input);
    std::vector<std::string> its = ros::is_recording(input) ? std::vector<std::string>{}
                                   : is_folder              ? cloud_files_in(input)
                                                            : std::vector<std::string>{input};
    if (its.empty()) {
      (files.empty() ? all.before : all.behind).push_back(input);
    }
    if (is_folder && !its.empty()) {
      folders.push_back(its);
    }
    std::ranges::move(its, std::back_inserter(files));
  }
  if (!files.empty()) {
    all.clouds = timed(files, options.clouds_per_second);
  }
  if (const std::string overlap = words_of_overlap(folders); !overlap.empty()) {
    all.clouds.remarks.push_back(overlap);
  }
  return all;
}

// Calls take(cloud) with each cloud of all inputs. Returns remarks.
std::vector<std::string> for_each_input(const PointsOptions& options, TimeUnit& unit,
                                        const std::function<void(SeenCloud&&)>& take) {
  const Inputs inputs = inputs_of(options);
  std::vector<std::string> remarks = inputs.clouds.remarks;
  const auto read = [&](const std::string& input) {
    std::ranges::move(ros::is_recording(input) ? for_each_cloud(input, options.topic, unit, take)
                                               : for_each_of_set(input, take),
                      std::back_inserter(remarks));
  };
  std::ranges::for_each(inputs.before, read);
  bool is_assumed = false;
  std::uint64_t viewpoints = 0;
  std::uint64_t left_out = 0;
  std::string first_viewpoint;
  std::string its_name;
  for (const CloudFile& file : inputs.clouds.files) {
    SeenCloud cloud = read_cloud_of(file, unit);
    if (cloud.is_assumed && cloud.points.empty()) {
      ++left_out;  // the others may have times of their own
      continue;
    }
    is_assumed = is_assumed || cloud.is_assumed;
    if (!cloud.viewpoint.empty() && viewpoints++ == 0) {
      first_viewpoint = file.path + ": " + cloud.viewpoint;
      its_name = cloud.viewpoint.starts_with("camera") ? "the camera's pose" : "VIEWPOINT";
    }
    take(std::move(cloud));
  }
  if (is_assumed) {
    std::ranges::copy(inputs.clouds.remarks_if_assumed, std::back_inserter(remarks));
  }
  remark(left_out, "cloud|clouds with neither a point nor a time was|were left out", remarks);
  if (viewpoints > 0) {
    constexpr std::string_view kSet =
        "file|files sets|set: its|their points must be in the lidar's frame (";
    remarks.push_back("iog ignores " + its_name + ", which " + counted(viewpoints, kSet) +
                      first_viewpoint + ')');
  }
  std::ranges::for_each(inputs.behind, read);
  return remarks;
}

// The unit that the longest of the first clouds shows, before anything is sent: a part of a scan
// may be a whole scan in another unit. kFound if they have no times.
TimeUnit unit_of(PointsOptions options) {
  constexpr int kEnough = 10;
  constexpr int kMost = 100;
  struct Enough {};
  std::erase_if(options.inputs, [](const std::string& input) {  // KITTI's have no unit
    const bool is_folder = !ros::is_recording(input) && std::filesystem::is_directory(input);
    const std::vector<std::string> its = is_folder ? cloud_files_in(input) : std::vector{input};
    return its.empty() || its.front().ends_with(".bin");
  });
  TimeUnit shown = TimeUnit::kFound;
  TimeUnit unit = TimeUnit::kFound;
  double longest = 0;
  int seen = 0;
  int timed = 0;
  try {
    for_each_input(options, shown, [&](SeenCloud&& cloud) {
      // A Livox message says its unit itself.
      const bool is_asked = cloud.has_unknown_times || shown != TimeUnit::kFound;
      const double time_span = is_asked ? cloud.time_span : 0;
      timed += time_span > 0 ? 1 : 0;
      unit = time_span > longest ? shown : unit;
      longest = std::max(longest, time_span);
      shown = TimeUnit::kFound;
      if (++seen == kMost || (timed >= kEnough && unit != TimeUnit::kFound)) {
        throw Enough();
      }
    });
  } catch (const Enough&) {
  }
  if (timed > 0 && unit == TimeUnit::kFound) {
    throw UsageError("no cloud shows the unit of its points' times: give --time-unit");
  }
  return unit;
}

// Of clouds in files, and of recordings.
void demand_uses(const CLI::App& command, const PointsOptions& options) {
  demand_use(command, std::ranges::any_of(options.inputs, ros::is_recording), {"--topic"},
             "a recording of ROS 2 (.mcap, .db3)");
  const bool has_rate = command.get_option("--rate")->count() > 0;
  demand_use(command, !has_rate || !inputs_of(options).clouds.files.empty(), {"--rate"},
             "files of clouds (.pcd, .ply, .bin)");
}

void send_clouds(PointsOptions options) {
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  const std::size_t sensor = sensor_of(options, car);
  PointsSender sender(car, sensor);
  Destination destination(options, car.sensors[sensor].udp_port);
  options.unit = options.unit == TimeUnit::kFound ? unit_of(options) : options.unit;
  Progress progress("clouds");
  const auto take_all = [&](const std::vector<CapturedDatagram>& datagrams) {
    std::ranges::for_each(datagrams, [&](const auto& datagram) { destination.take(datagram); });
  };
  std::uint64_t untimed = 0;
  const auto recording = std::ranges::find_if(options.inputs, ros::is_recording);
  const FrameNames of_odometry =
      recording == options.inputs.end() ? FrameNames{} : frames_of_odometry(*recording);
  std::vector<std::string> remarks = for_each_input(options, options.unit, [&](SeenCloud&& cloud) {
    if (cloud.has_unknown_times) {
      throw UsageError("cloud " + std::to_string(sender.sent().given) +
                       " does not show the unit of its points' times: give --time-unit");
    }
    const std::string words = words_of_wrong_frame(cloud.frame, of_odometry);
    if (sender.sent().given == 0 && !words.empty()) {
      std::cerr << "iog: warning: the clouds are " << words << '\n';
    }
    untimed += cloud.untimed;
    take_all(sender.send(std::move(cloud)));
    progress.show(sender.sent().given);
  });
  take_all(sender.finish());
  if (sender.sent().clouds == 0) {
    throw UsageError("there is no cloud with a point in what is given");
  }
  sender.demand_order();
  remark(untimed, "point|points whose time is no number or 0 was|were not sent", remarks);
  const bool has_points = sender.sent().points > 0;
  const std::string where = has_points ? destination.finish(remarks) : "in no file";
  report(sender.sent(), options.unit, std::move(remarks), where,
         options.out == "-" ? std::cerr : std::cout);
  if (!has_points) {
    throw CheckFailed("no cloud has a point to send");
  }
  destination.demand_sent();
}

}  // namespace

void add_points(CLI::App& program) {
  auto* const command =
      program.add_subcommand("points", "Make a capture from point clouds or 2D scans of any lidar");
  const auto options = std::make_shared<PointsOptions>();
  add_option(*command, "FILE", "...", options->inputs,
             "Recordings of ROS 2 with clouds or scans (.mcap, .db3, folders), point clouds (.pcd, "
             ".ply, .bin of KITTI or nuScenes), or folders of these")
      ->required();
  add_option(*command, "--out", "FILE", options->out, "Capture to write (.pcap)");
  add_option(*command, "--target", "ADDRESS", options->target,
             "Or IPv4 address to send to, at the recording's pace");
  add_option(*command, "--sensor", "NAME  (default the only one of type points)", options->sensor,
             "Sensor of the car, by name or number");
  add_option(*command, "--topic", "TOPIC  (default the one with clouds)", options->topic,
             "Topic of a recording");
  const CLI::Validator is_unit(
      [](const std::string& word) {
        return std::ranges::find(kTimeUnitNames, word) != kTimeUnitNames.end()
                   ? std::string()
                   : word + " is none of s, ms, us, ns";
      },
      "{s,ms,us,ns}");
  command
      ->add_option_function<std::string>(
          "--time-unit",
          [options](const std::string& word) {
            const auto* const found = std::ranges::find(kTimeUnitNames, word);
            options->unit = static_cast<TimeUnit>(found - kTimeUnitNames.begin() + 1);
          },
          "Unit of the points' own times")
      ->option_text("s|ms|us|ns  (default the unit in which a full scan takes 5 to 500 ms)")
      ->check(is_unit);
  add_option(*command, "--rate", "HZ  (default 10)", options->clouds_per_second,
             "Files of clouds per second, if neither their names nor points have times")
      ->check(CLI::Range(0.1, 100.0));
  add_vehicle_options(*command, options->vehicle);
  command->footer(
      "docs/sensors.md, \"Any other lidar: points\", explains how to describe the car.");
  command->callback([command, options] {
    demand_uses(*command, *options);
    send_clouds(*options);
  });
}

}  // namespace iog::tools
