#include "tools/receive/udp_receiver.hpp"

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <span>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>
#include <utility>

#include "tools/program/exit_status.hpp"
#include "tools/program/fixed.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/time_of_day.hpp"

namespace iog::tools {
namespace {

constexpr int kSocketBufferBytes = 64 << 20;  // beyond the system's limit it is cut, silently
constexpr std::size_t kMaxQueued = 400'000;   // some 10 minutes of frames
constexpr std::size_t kBatch = 64;            // datagrams of one system call
constexpr std::size_t kMostLastBatches = 4096;
constexpr std::size_t kRoomBytes = 2048;  // more than any message; a longer one is cut
constexpr timeval kWakeUp{.tv_sec = 0, .tv_usec = 100'000};  // to see that it is over

}  // namespace

UdpReceiver::UdpReceiver(const std::string& address, std::uint16_t port) {
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = htons(port);
  if (inet_pton(AF_INET, address.c_str(), &here.sin_addr) != 1) {
    throw UsageError("--bind " + address + ": give an IPv4 address such as 127.0.0.1");
  }
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (setsockopt(socket_, SOL_SOCKET, SO_RCVBUFFORCE, &kSocketBufferBytes,
                 sizeof kSocketBufferBytes) != 0) {
    static_cast<void>(
        setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &kSocketBufferBytes, sizeof kSocketBufferBytes));
  }
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &kWakeUp, sizeof kWakeUp);
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0) {
    const std::string reason = std::strerror(errno);
    close(socket_);
    throw UsageError("cannot receive on " + address + ":" + std::to_string(port) + ": " + reason);
  }
  thread_ = std::thread([this] { receive(); });
}

UdpReceiver::~UdpReceiver() {
  stop();
  close(socket_);
}

void UdpReceiver::stop() {
  is_closing_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
}

bool UdpReceiver::has_ended() {
  if (!was_interrupted()) {
    return false;
  }
  stop();
  return queue_.empty();
}

UdpReceiver::Messages UdpReceiver::take(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, longest, [this] { return !queue_.empty(); });
  return std::exchange(queue_, {});
}

void UdpReceiver::receive() {
  std::vector<std::array<std::byte, kRoomBytes>> rooms(kBatch);
  std::array<iovec, kBatch> vectors{};
  std::array<mmsghdr, kBatch> headers{};
  for (std::size_t i = 0; i < kBatch; ++i) {
    vectors[i] = {rooms[i].data(), rooms[i].size()};
    headers[i].msg_hdr.msg_iov = &vectors[i];
    headers[i].msg_hdr.msg_iovlen = 1;
  }
  // At the end, what the system has kept is read, too, however much goes on coming.
  for (std::size_t last = 0; last < kMostLastBatches; last += is_closing_ ? 1U : 0U) {
    const bool is_last = is_closing_;
    const int count =
        recvmmsg(socket_, headers.data(), kBatch, is_last ? MSG_DONTWAIT : MSG_WAITFORONE, nullptr);
    if (count <= 0 && is_last) {
      return;
    }
    if (count <= 0) {
      continue;
    }
    const std::uint64_t now_us = time_of_day_us();
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (queue_.size() >= kMaxQueued) {
        ++overflow_;
        continue;
      }
      const auto bytes = std::span(rooms[i]).first(headers[i].msg_len);
      queue_.push_back({.time_us = now_us, .bytes = {bytes.begin(), bytes.end()}});
    }
    arrived_.notify_one();
  }
}

std::string words_of_silence(const std::string& address, std::uint16_t port,
                             std::chrono::duration<double> waited, const std::string& consequence) {
  std::string text = "nothing came to UDP " + address + ':' + std::to_string(port) + " in " +
                     fixed(waited.count(), 1) + " s" + consequence +
                     ". Does the target run, and is this the address and port that it sends to?";
  if (address.starts_with("127.")) {
    text += " Only this PC reaches " + address + ": --bind 0.0.0.0 listens to others, too";
  }
  return text;
}

}  // namespace iog::tools
