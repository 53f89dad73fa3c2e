// A TCP connection to an ibeo unit, which is made again whenever it is lost.
//
// Nothing is sent to the unit: it is to be set up, and measures and sends to whoever connects.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "tools/relay/scan_stream.hpp"

namespace iog::tools {

inline constexpr std::uint16_t kLuxTcpPort = 12'002;

class UnitLink {
 public:
  using Clock = std::chrono::steady_clock;

  // How long until a lost connection is tried again, and how long one is believed that is silent.
  // A unit sends 12.5 scans a second or more.
  struct Patience {
    std::chrono::milliseconds before_retry{1'000};
    std::chrono::milliseconds while_silent{3'000};
  };

  struct Counts {
    std::uint64_t connections = 0;
    std::uint64_t losses = 0;  // of those
    std::uint64_t bytes = 0;
  };

  // host: a dotted IPv4 address; UsageError if it is none.
  UnitLink(const std::string& host, std::uint16_t port, Patience patience);
  ~UnitLink();
  UnitLink(const UnitLink&) = delete;
  UnitLink& operator=(const UnitLink&) = delete;

  // Begins to connect, gives up what is silent. To be called now and then.
  void move_on(Clock::time_point now);

  // For poll(): the socket, -1 if there is none, and what it waits for.
  [[nodiscard]] int socket() const { return socket_; }
  [[nodiscard]] short awaited() const;

  // After poll() said that something has come: takes what is there, at most one buffer.
  void take(Clock::time_point now, const ScanStream::OnScan& on_scan);

  [[nodiscard]] bool is_connected() const { return is_connected_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] const ScanStream::Counts& scan_counts() const { return stream_.counts(); }
  // Why the last one was lost or was not made, as the system says it; empty: none was.
  [[nodiscard]] const std::string& last_fault() const { return last_fault_; }

 private:
  void begin(Clock::time_point now);
  void lose(Clock::time_point now, std::string fault);

  std::uint32_t address_ = 0;  // in the byte order of the wire
  std::uint16_t port_;
  Patience patience_;
  int socket_ = -1;
  bool is_connected_ = false;
  Clock::time_point last_heard_;
  Clock::time_point next_try_{};  // at once
  ScanStream stream_;
  Counts counts_;
  std::string last_fault_;
};

}  // namespace iog::tools
