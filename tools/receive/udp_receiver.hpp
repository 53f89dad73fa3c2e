// Receives datagrams on a thread that does nothing else, so that none is lost while another thread
// draws pictures.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace iog::tools {

class UdpReceiver {
 public:
  struct Message {
    std::uint64_t time_us;  // when it arrived, by this PC's time of day
    std::vector<std::byte> bytes;
  };
  using Messages = std::vector<Message>;

  // UsageError if that address and port cannot be bound.
  UdpReceiver(const std::string& address, std::uint16_t port);
  ~UdpReceiver();
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;

  // What has come since the last call, in its order; waits for it, but no longer than that.
  [[nodiscard]] Messages take(std::chrono::milliseconds longest);

  // Ends the reception. What has arrived before can still be taken.
  void stop();

  // Returns true if the program was interrupted and all messages that had arrived were taken. Stops
  // the reception if the program was interrupted.
  [[nodiscard]] bool has_ended();

  // Messages that were dropped here because nobody took them.
  [[nodiscard]] std::uint64_t overflow() const { return overflow_; }

 private:
  void receive();

  int socket_ = -1;
  std::atomic<bool> is_closing_ = false;
  std::atomic<std::uint64_t> overflow_ = 0;
  std::mutex mutex_;
  std::condition_variable arrived_;
  Messages queue_;
  std::thread thread_;
};

// For who has waited: "nothing came to UDP 127.0.0.1:15000 in 3.0 s, and nothing is written. Does
// ...". consequence: such as ", and nothing is written".
[[nodiscard]] std::string words_of_silence(const std::string& address, std::uint16_t port,
                                           std::chrono::duration<double> waited,
                                           const std::string& consequence = "");

}  // namespace iog::tools
