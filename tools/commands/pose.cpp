// iog pose: a log of poses as the messages that the target places its frames by.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/commands/subcommands.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/poses/pose_encoder.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/replay/pace.hpp"
#include "tools/replay/udp_sender.hpp"

namespace iog::tools {
namespace {

struct Options {
  std::string from;
  std::string format;
  std::string out;
  std::string target;
  std::uint16_t port = pose::kPosePort;
  double speed = 1;
  double sigma_mm = 50;
  double heading_sigma_mrad = 2;
  std::vector<double> mount_m{0, 0};
  std::optional<std::uint32_t> run;
};

// By the name of what is to be read.
std::string format_of(const Options& options) {
  if (!options.format.empty()) {
    return options.format;
  }
  const std::string suffix = std::filesystem::path(options.from).extension();
  if (std::filesystem::is_directory(options.from)) {
    return "oxts";
  }
  if (suffix == ".csv" || suffix == ".nmea" || suffix == ".ubx") {
    return suffix.substr(1);
  }
  throw UsageError(options.from + ": give --format csv, oxts, nmea or ubx");
}

PoseLog log_of(const Options& options) {
  const std::string format = format_of(options);
  if (format == "csv") {
    return read_csv_log(options.from);
  }
  if (format == "oxts") {
    return read_oxts_log(options.from);
  }
  const std::vector<std::byte> bytes = read_file(options.from);
  return format == "nmea" ? read_nmea_log(bytes) : read_ubx_log(bytes);
}

// What a file says does not depend on the day; a target must know one sending from the next.
std::uint32_t run_of(const Options& options) {
  if (options.run) {
    return *options.run;
  }
  if (!options.out.empty()) {
    return 1;
  }
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint32_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

// "; not used: 3 poses without a heading, ..."
std::string joined(const std::vector<std::string>& remarks) {
  std::string text;
  for (const std::string& remark : remarks) {
    text += (text.empty() ? "; not used: " : ", ") + remark;
  }
  return text;
}

void print_remarks(const Options& options, const ConvertedLog& log) {
  for (const std::string& remark : log.remarks) {
    std::cout << options.from << ": not used: " << remark << '\n';
  }
  if (log.taken_sigmas > 0) {
    std::cout << options.from << ": no standard deviation of the way in " << log.taken_sigmas
              << " poses, " << options.sigma_mm << " mm taken\n";
  }
  if (log.taken_sigma_headings > 0) {
    std::cout << options.from << ": no standard deviation of the turn in "
              << log.taken_sigma_headings << " poses, " << options.heading_sigma_mrad
              << " mrad taken\n";
  }
}

void write(const std::vector<CapturedDatagram>& datagrams, const std::string& path) {
  PcapWriter capture(path);
  for (const CapturedDatagram& datagram : datagrams) {
    capture.write(datagram);
  }
  capture.finish();
  std::cout << datagrams.size() << " poses in " << path << '\n';
}

void send(const std::vector<CapturedDatagram>& datagrams, const Options& options) {
  catch_interrupts();
  UdpSender sender(options.target, options.port);
  Pace pace(options.speed);
  std::size_t sent = 0;
  std::size_t refused = 0;
  for (const CapturedDatagram& datagram : datagrams) {
    pace.wait_for(datagram.time_us - datagrams.front().time_us);
    if (was_interrupted()) {
      break;
    }
    ++(sender.send(0, datagram.payload) ? sent : refused);
  }
  std::cout << sent << " poses sent, " << refused << " refused by the system; worst delay "
            << pace.worst_delay_us() << " us\n";
}

void convert(const Options& options) {
  if (options.out.empty() == options.target.empty()) {
    throw UsageError("give either --out FILE or --target ADDRESS");
  }
  const ConvertedLog log =
      converted(log_of(options), {.mount_x_m = options.mount_m[0],
                                  .mount_y_m = options.mount_m[1],
                                  .sigma_m = options.sigma_mm / 1000,
                                  .sigma_heading_rad = options.heading_sigma_mrad / 1000,
                                  .run = run_of(options)});
  if (log.samples.empty()) {
    throw UsageError(options.from + ": no pose in it" + joined(log.remarks));
  }
  PoseEncoder encoder;
  std::vector<CapturedDatagram> datagrams;
  for (const PoseSample& sample : log.samples) {
    datagrams.push_back(encoder.datagram_of(sample));
  }
  print_remarks(options, log);
  options.out.empty() ? send(datagrams, options) : write(datagrams, options.out);
}

}  // namespace

void add_pose(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "pose", "Make pose messages of a log of where the car was, or send them to a target");
  const auto options = std::make_shared<Options>();
  command->add_option("--from", options->from, "The log to read")
      ->option_text("FILE | FOLDER  (required)")
      ->required();
  command->add_option("--format", options->format, "What it is, where its name does not say")
      ->option_text("csv | oxts | nmea | ubx")
      ->check(CLI::IsMember({"csv", "oxts", "nmea", "ubx"}));
  command->add_option("--out", options->out, "The capture to write (.pcap)")->option_text("FILE");
  command->add_option("--target", options->target, "Or the IPv4 address to send to")
      ->option_text("ADDRESS");
  command->add_option("--port", options->port, "UDP port of the target")
      ->option_text("PORT  (default 15010)")
      ->check(CLI::Range(1, 65'535));
  command
      ->add_option("--speed", options->speed,
                   "1: as logged, 2: twice as fast, 0: as fast as it goes")
      ->option_text("X")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--mount", options->mount_m,
                   "Where in the vehicle frame the receiver is whose places were logged")
      ->option_text("X Y  (metres, default 0 0)")
      ->expected(2);
  command
      ->add_option("--sigma", options->sigma_mm,
                   "Standard deviation of the way during a second, if the log says none")
      ->option_text("MM  (default 50)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--heading-sigma", options->heading_sigma_mrad,
                   "Standard deviation of the turn during a second, if the log says none")
      ->option_text("MRAD  (default 2)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--run", options->run,
                   "Number of the source's run; with --target else one of the clock's")
      ->option_text("N  (default 1)")
      ->check(CLI::Range(1U, 0xFFFFFFFFU));
  command->footer(
      "csv: the first line names the columns, at least time_s,x_m,y_m,heading_deg; speed_m_s,\n"
      "yaw_rate_deg_s, sigma_m and sigma_heading_deg if known. oxts: a folder of KITTI with\n"
      "timestamps.txt and data. nmea: RMC, GGA, HDT. ubx: NAV-PVT. Latitude and longitude become\n"
      "metres east and north of the first position. docs/drives.md says how each is read.");
  command->callback([options] { convert(*options); });
}

}  // namespace iog::tools
