// The three places from which a viewer gets its grids. What is wrong with one shows when it is
// made, before anybody is asked to look.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tools/identity/car_capture.hpp"
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

// The stream of a target to a UDP port. UsageError if the port cannot be bound.
[[nodiscard]] std::unique_ptr<Source> make_stream_source(const std::string& address,
                                                         std::uint16_t port);

struct RecordingOptions {
  DriveFiles drive;
  std::string vehicle;
  std::uint16_t port;  // to which a recorded stream went
  double speed;        // 2: twice as fast as recorded
  bool loops;
};

// Captures of a vehicle's sensors, or one of a target's stream, or an MCAP file that has a stream,
// in its own time, from wherever pages ask. UsageError if the file cannot be read, or nothing in it
// can be shown.
[[nodiscard]] std::unique_ptr<Source> make_recording_source(const RecordingOptions& options);

// A drive that is made up as it goes, with the truth of its world. UsageError if there is no such
// scene or vehicle, or its sensors cannot be simulated.
[[nodiscard]] std::unique_ptr<Source> make_drive_source(const std::string& scene,
                                                        const std::string& vehicle,
                                                        std::uint64_t seed);

}  // namespace iog::tools::view
