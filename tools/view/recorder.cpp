#include "tools/view/recorder.hpp"

#include <array>
#include <ctime>
#include <filesystem>
#include <utility>

#include "net/udp.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools::view {
namespace {

constexpr std::uint32_t kLoopback = 0x7F000001;

std::string name_of_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  std::array<char, 32> name{};
  const std::size_t length = std::strftime(name.data(), name.size(), "view_%Y%m%d_%H%M%S", &parts);
  return {name.data(), length};
}

}  // namespace

void Recorder::start() {
  if (is_open()) {
    return;
  }
  make_folder(folder_);
  const std::string stem = folder_ + "/" + name_of_now();
  path_ = stem + ".pcap";
  for (int again = 2; std::filesystem::exists(path_); ++again) {
    path_ = stem + "_" + std::to_string(again) + ".pcap";
  }
  file_.emplace(path_);
  file_->keep_beginning();
  messages_ = 0;
  bytes_ = 0;
}

void Recorder::stop() {
  if (auto file = std::exchange(file_, std::nullopt)) {
    file->finish();
  }
}

void Recorder::take(std::span<const std::byte> message, std::uint64_t time_us) {
  if (!is_open() || message.size() > net::kMaxUdpPayloadBytes) {
    return;
  }
  try {
    file_->write({.time_us = time_us,
                  .source = {.ipv4 = kLoopback, .port = port_},
                  .destination = {.ipv4 = kLoopback, .port = port_},
                  .payload = {message.begin(), message.end()}});
  } catch (const UsageError&) {
    file_.reset();
    throw;
  }
  ++messages_;
  bytes_ += message.size();
}

}  // namespace iog::tools::view
