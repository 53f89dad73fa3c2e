#include "tools/relay/unit_link.hpp"

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

std::string words_of_error(int error) { return std::generic_category().message(error); }

// What became of a connection that was begun.
int error_of(int socket) {
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

}  // namespace

UnitLink::UnitLink(const std::string& host, std::uint16_t port, Patience patience)
    : port_(port), patience_(patience) {
  in_addr address{};
  if (inet_pton(AF_INET, host.c_str(), &address) != 1) {
    throw UsageError(host + " is no address of a unit; give an IPv4 address such as 10.0.2.101");
  }
  address_ = address.s_addr;
}

UnitLink::~UnitLink() {
  if (socket_ >= 0) {
    close(socket_);
  }
}

short UnitLink::awaited() const { return is_connected_ ? POLLIN : POLLOUT; }

void UnitLink::lose(Clock::time_point now, std::string fault) {
  close(std::exchange(socket_, -1));
  counts_.losses += is_connected_ ? 1U : 0U;
  is_connected_ = false;
  last_fault_ = std::move(fault);
  next_try_ = now + patience_.before_retry;
  stream_.end();
}

void UnitLink::begin(Clock::time_point now) {
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0) {
    throw UsageError("no TCP socket to be had from this system");
  }
  last_heard_ = now;
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = address_;
  to.sin_port = htons(port_);
  if (connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0 &&
      errno != EINPROGRESS) {
    lose(now, words_of_error(errno));
  }
}

void UnitLink::move_on(Clock::time_point now) {
  if (socket_ < 0) {
    if (now >= next_try_) {
      begin(now);
    }
  } else if (now - last_heard_ > patience_.while_silent) {
    lose(now, is_connected_ ? "it fell silent" : "it does not answer");
  }
}

void UnitLink::take(Clock::time_point now, const ScanStream::OnScan& on_scan) {
  if (!is_connected_) {
    if (const int error = error_of(socket_); error != 0) {
      lose(now, words_of_error(error));
      return;
    }
    is_connected_ = true;
    last_heard_ = now;
    ++counts_.connections;
    return;
  }
  std::array<std::byte, 65'536> buffer;
  const ssize_t size = recv(socket_, buffer.data(), buffer.size(), 0);
  if (size > 0) {
    last_heard_ = now;
    counts_.bytes += static_cast<std::uint64_t>(size);
    stream_.take(std::span(buffer).first(static_cast<std::size_t>(size)), on_scan);
  } else if (size == 0) {
    lose(now, "it ended the connection");
  } else if (errno != EAGAIN && errno != EINTR) {
    lose(now, words_of_error(errno));
  }
}

}  // namespace iog::tools
