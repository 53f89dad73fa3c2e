// The three places from which a viewer gets its grids. What is wrong with one shows when it is
// made, before anybody is asked to look.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tools/view/viewer.hpp"

namespace iog::tools::view {

class Source {
 public:
  virtual ~Source() = default;

  // "stream" of a target, "recording" of one, "capture" of sensors or made-up "drive": the last two
  // are fused in this process.
  [[nodiscard]] virtual std::string kind() const = 0;

  // Until it is over or somebody interrupts.
  virtual void run(Viewer& viewer) = 0;
};

// The stream of a target to a UDP port. forward_port: of this PC, for another receiver; 0: none.
// UsageError if the port cannot be bound.
[[nodiscard]] std::unique_ptr<Source> make_stream_source(const std::string& address,
                                                         std::uint16_t port,
                                                         std::uint16_t forward_port);

struct CaptureOptions {
  std::string path;
  std::string vehicle;
  std::uint16_t port;  // to which a recorded stream went
  double speed;        // 2: twice as fast as recorded
  bool loops;
};

// A capture of a vehicle's sensors, or of a target's stream, in its own time. UsageError if the
// file cannot be read, or nothing in it can be shown.
[[nodiscard]] std::unique_ptr<Source> make_capture_source(const CaptureOptions& options);

// A drive that is made up as it goes, with the truth of its world. UsageError if there is no such
// scene or vehicle, or its sensors cannot be simulated.
[[nodiscard]] std::unique_ptr<Source> make_drive_source(const std::string& scene,
                                                        const std::string& vehicle,
                                                        std::uint64_t seed);

}  // namespace iog::tools::view
