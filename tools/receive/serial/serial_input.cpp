#include "tools/receive/serial/serial_input.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>
#include <utility>

#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

constexpr std::array<std::pair<unsigned, speed_t>, 9> kSpeeds{{{9600, B9600},
                                                               {19'200, B19200},
                                                               {38'400, B38400},
                                                               {57'600, B57600},
                                                               {115'200, B115200},
                                                               {230'400, B230400},
                                                               {460'800, B460800},
                                                               {921'600, B921600},
                                                               {1'000'000, B1000000}}};

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw UsageError("cannot read " + path + ": " + why);
}

bool is_socket(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    refuse(path, std::strerror(errno));
  }
  return S_ISSOCK(status.st_mode);
}

int connected(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    refuse(path, "the name of a socket has at most 107 characters");
  }
  std::ranges::copy(path, address.sun_path);
  const int file = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (connect(file, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    const std::string why = std::strerror(errno);
    close(file);
    refuse(path, why);
  }
  return file;
}

void make_raw(int file, const std::string& path, unsigned baud) {
  const auto* const speed =
      std::ranges::find(kSpeeds, baud, [](const auto& each) { return each.first; });
  termios settings{};
  if (speed == kSpeeds.end() || tcgetattr(file, &settings) != 0) {
    refuse(path, "no rate of " + std::to_string(baud) + " baud");
  }
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~(CSTOPB | CRTSCTS);
  cfsetspeed(&settings, speed->second);
  if (tcsetattr(file, TCSANOW, &settings) != 0) {
    refuse(path, std::strerror(errno));
  }
}

}  // namespace

SerialInput::SerialInput(const std::string& path, unsigned baud) {
  if (is_socket(path)) {
    file_ = connected(path);
    return;
  }
  // Not to wait for the carrier of a modem that is none.
  file_ = open(path.c_str(), O_RDONLY | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  if (file_ < 0) {
    refuse(path, std::strerror(errno));
  }
  if (isatty(file_) != 0) {
    make_raw(file_, path, baud);
  }
}

SerialInput::~SerialInput() { close(file_); }

std::optional<std::span<const std::byte>> SerialInput::take(std::chrono::milliseconds longest) {
  pollfd waiting{.fd = file_, .events = POLLIN, .revents = 0};
  if (poll(&waiting, 1, static_cast<int>(longest.count())) <= 0) {
    return std::span<const std::byte>{};
  }
  const ssize_t bytes = read(file_, buffer_.data(), buffer_.size());
  if (bytes > 0) {
    return std::span<const std::byte>(buffer_).first(static_cast<std::size_t>(bytes));
  }
  const bool is_over = bytes == 0 || (errno != EAGAIN && errno != EINTR);
  return is_over ? std::nullopt : std::optional(std::span<const std::byte>{});
}

}  // namespace iog::tools
