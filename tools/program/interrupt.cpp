#include "tools/program/interrupt.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <unistd.h>

namespace iog::tools {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void remember(int /*signal*/) { interrupted = 1; }

// Names of unfinished files. Files beyond these are left by a signal.
std::array<std::atomic<const char*>, 8> unfinished{};
static_assert(std::atomic<const char*>::is_always_lock_free);

void remove_and_end(int signal) {
  for (const auto& name : unfinished) {
    if (const char* const path = name.load(); path != nullptr) {
      unlink(path);
    }
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void forget(const std::string& path) {
  const auto slot = std::ranges::find_if(
      unfinished, [&path](const auto& name) { return name.load() == path.c_str(); });
  if (slot != unfinished.end()) {
    slot->store(nullptr);
  }
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember;  // without SA_RESTART: a wait ends with EINTR
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

bool was_interrupted() { return interrupted != 0; }

UnfinishedFile::UnfinishedFile(const std::string& path) : path_(new std::string(path)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_DFL) {
      std::signal(signal, remove_and_end);
    }
  }
  for (auto& name : unfinished) {
    const char* none = nullptr;
    if (name.compare_exchange_strong(none, path_->c_str())) {
      return;
    }
  }
}

void UnfinishedFile::keep() {
  forget(*path_);
  delete path_.release();
}

void UnfinishedFile::Remover::operator()(std::string* path) const {
  unlink(path->c_str());
  forget(*path);
  delete path;
}

}  // namespace iog::tools
