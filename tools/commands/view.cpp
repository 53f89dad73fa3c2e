// iog view: the grid in a browser, live.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "map/block.hpp"
#include "tools/commands/signing_options.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/foxglove/live_feed.hpp"
#include "tools/map/block_file.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/number_checks.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/simulate/scenes/scene_catalogue.hpp"
#include "tools/vehicles/key_file.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "tools/view/forward.hpp"
#include "tools/view/servers.hpp"
#include "tools/view/sources.hpp"

namespace iog::tools {
namespace {

constexpr std::uint16_t kUsualHttpPort = 8080;
constexpr const char* kUsualFoxglovePort = "8765";

struct ViewOptions {
  std::string bind = "127.0.0.1";
  std::uint16_t port = 15'000;
  std::uint16_t forward = 0;
  std::string http_bind = "127.0.0.1";
  std::optional<std::uint16_t> http;
  std::optional<std::uint16_t> foxglove;
  bool open = false;
  DriveFiles drive;
  std::string simulate;
  std::string vehicle = kDefaultVehicle;
  std::uint64_t seed = 1;
  double speed = 1;
  bool loop = false;
  std::string records = ".";
  std::string map;
  std::string key;
};

// The usual port, or where nobody has named one and it is taken, any free one.
std::unique_ptr<view::Server> serve(const ViewOptions& options, view::Scene& scene) {
  if (options.http) {
    return view::serve_page(options.http_bind, *options.http, scene);
  }
  try {
    return view::serve_page(options.http_bind, kUsualHttpPort, scene);
  } catch (const UsageError&) {
    return view::serve_page(options.http_bind, 0, scene);
  }
}

// Whether it could be opened shows on the screen; the address has been printed in any case.
void open_browser(const std::string& address) {
  const pid_t child = fork();
  if (child == 0) {
    // A grandchild, so that no one has to wait for the browser.
    if (fork() == 0) {
      static_cast<void>(std::freopen("/dev/null", "w", stdout));
      static_cast<void>(std::freopen("/dev/null", "w", stderr));
      execlp("xdg-open", "xdg-open", address.c_str(), nullptr);
    }
    _exit(0);
  }
  if (child > 0) {
    waitpid(child, nullptr, 0);
  }
}

// By which address the servers of this PC are found, and at that port.
std::string host_words(const ViewOptions& options, std::uint16_t port) {
  const std::string host =
      options.http_bind == "0.0.0.0" || options.http_bind == "::" ? "127.0.0.1" : options.http_bind;
  return (host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" +
         std::to_string(port);
}

std::string words_of_origin(const ViewOptions& options) {
  if (!options.drive.captures.empty()) {
    return options.drive.name();
  }
  if (!options.simulate.empty()) {
    return options.simulate + ", seed " + std::to_string(options.seed);
  }
  return "UDP " + options.bind + ":" + std::to_string(options.port);
}

std::unique_ptr<view::Source> source_of(const ViewOptions& options) {
  if (!options.drive.captures.empty()) {
    return view::make_recording_source({.drive = options.drive,
                                        .vehicle = options.vehicle,
                                        .port = options.port,
                                        .speed = options.speed,
                                        .loops = options.loop});
  }
  if (!options.simulate.empty()) {
    return view::make_drive_source(options.simulate, options.vehicle, options.seed);
  }
  if (options.forward == options.port &&
      (options.bind == "127.0.0.1" || options.bind == "0.0.0.0")) {
    throw UsageError("--forward " + std::to_string(options.forward) +
                     ": view itself receives on this port (--port), and each message would come "
                     "back without end; forward to another port");
  }
  return view::make_stream_source(options.bind, options.port);
}

void view_grid(const ViewOptions& options) {
  const std::unique_ptr<view::Source> source = source_of(options);
  view::Scene scene;
  view::Origin origin{.kind = source->kind(), .words = words_of_origin(options)};
  if (!options.map.empty()) {
    scene.set_map(read_block(options.map));
    origin.block = hex(map::Block(scene.map()).crc());
  }
  view::Viewer viewer(scene, origin, view::Recorder(options.records, options.port));
  if (!options.key.empty()) {
    viewer.believe_signed(read_key_file(options.key));
  }
  const std::unique_ptr<view::Server> server = serve(options, scene);
  const std::string address = "http://" + host_words(options, server->port()) + "/";
  std::optional<view::Forward> forward;
  if (options.forward != 0) {
    viewer.show_also(forward.emplace(options.forward));
  }
  foxglove::LiveFeed feed;
  std::unique_ptr<view::Server> foxglove_server;
  if (options.foxglove) {
    viewer.show_also(feed);
    foxglove_server = view::serve_foxglove(options.http_bind, *options.foxglove, feed,
                                           [&scene] { scene.note_page(); });
  }
  std::cout << "Look at " << address << std::endl;
  if (foxglove_server) {
    std::cout << "Foxglove: ws://" << host_words(options, foxglove_server->port()) << std::endl;
  }
  if (options.open) {
    open_browser(address);
  }
  source->run(viewer);
  viewer.finish();
}

// An option of one kind of source does nothing for another.
void add_sources(CLI::App& command, ViewOptions& options) {
  add_option(command, "--port", "PORT  (default 15000)", options.port,
             "UDP port of the target's stream")
      ->check(CLI::Range(1, 65'535));
  auto* const bind = command.add_option("--bind", options.bind, "IPv4 address to receive on");
  bind->option_text("ADDRESS  (default 127.0.0.1)");
  add_option(command, "--forward", "PORT", options.forward,
             "Forward each message to this port of this PC, for `iog receive`")
      ->check(CLI::Range(1, 65'535));
  auto* const pcap = add_drive_options(
      command, command, options.drive,
      "Show this recording of sensors or grids (.pcap, .pcapng, .mcap; also .gz or .zst)",
      "FILE,--pcap");
  auto* const simulate =
      command.add_option("--simulate", options.simulate,
                         "Show a simulated drive and its ground truth: " + scene_names());
  simulate->option_text("SCENE")->check(known_scenes())->excludes(pcap);
  bind->excludes(pcap)->excludes(simulate);
  add_vehicle_options(command, options.vehicle);
  add_option(command, "--seed", "N  (default 1)", options.seed, "Seed of the simulated drive")
      ->check(not_below_zero())
      ->needs(simulate);
  add_option(command, "--speed", "FACTOR  (default 1)", options.speed,
             "Speed of the recording; 2: twice as fast")
      ->check(CLI::Range(0.01, 100.0))
      ->needs(pcap);
  command.add_flag("--loop", options.loop, "Repeat the recording")
      ->option_text("(needs FILE)")
      ->needs(pcap);
}

}  // namespace

void add_view(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "view", "Show grids live in a browser: of a target, a capture or a simulated drive");
  const auto options = std::make_shared<ViewOptions>();
  add_sources(*command, *options);
  add_option(*command, "--http", "PORT  (default 8080, or a free one)", options->http,
             "TCP port of the page; 0: any free port")
      ->check(CLI::Range(0, 65'535));
  add_option(*command, "--http-bind", "ADDRESS  (default 127.0.0.1)", options->http_bind,
             "IP address of the page and of --foxglove; only this PC reaches a loopback address");
  add_option(*command, "--foxglove", "[PORT]  (default 8765)", options->foxglove,
             "Also serve Foxglove by its WebSocket protocol; 0: any free port")
      ->expected(0, 1)
      ->default_str(kUsualFoxglovePort)
      ->check(CLI::Range(0, 65'535));
  add_option(*command, "--map", "FILE.iogmap", options->map,
             "Draw the outlines of this map while the target uses it");
  add_believing_option(*command, options->key);
  command->add_flag("--open", options->open, "Open the page with xdg-open");
  add_option(*command, "--records", "FOLDER  (default .)", options->records,
             "Folder into which the page's record button writes captures");
  command->footer(
      "Ctrl-C ends the program. It fuses captures of sensors itself, so that it can also show "
      "their points.\n"
      "docs/view.md explains the page, and docs/foxglove.md explains the data for Foxglove.");
  command->callback([options] {
    catch_interrupts();
    view_grid(*options);
  });
}

}  // namespace iog::tools
