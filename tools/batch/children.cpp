#include "tools/batch/children.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tools/program/file.hpp"
#include "tools/program/interrupt.hpp"

namespace iog::tools {
namespace {

constexpr int kNotStarted = 127;  // as of a shell

void send_to_file(int stream, const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file < 0 || dup2(file, stream) < 0) {
    _exit(kNotStarted);
  }
  close(file);
}

}  // namespace

Children::Children(std::string folder, std::size_t most) : folder_(std::move(folder)), all_(most) {
  std::signal(SIGCHLD, [](int /*signal*/) {});  // it ends sigsuspend()
}

Children::~Children() {
  for (const Child& child : all_) {
    if (child.id > 0) {
      kill(child.id, SIGKILL);
      waitpid(child.id, nullptr, 0);
    }
  }
}

std::optional<std::size_t> Children::free_place() const {
  const auto found = std::ranges::find(all_, 0, &Child::id);
  return found == all_.end() ? std::nullopt : std::optional(found - all_.begin());
}

bool Children::are_running() const {
  return std::ranges::any_of(all_, [](const Child& child) { return child.id > 0; });
}

void Children::start(std::size_t place, std::size_t work, std::vector<std::string> arguments) {
  std::vector<char*> words;
  words.reserve(arguments.size() + 1);
  for (std::string& word : arguments) {
    words.push_back(word.data());
  }
  words.push_back(nullptr);
  const std::string out = file(place, ".out");
  const std::string err = file(place, ".err");
  const pid_t parent = getpid();
  errno = 0;
  const pid_t id = fork();
  if (id < 0) {
    throw file_error("iog", "cannot be started once more");
  }
  if (id == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) {  // it has ended before that
      _exit(kNotStarted);
    }
    setpgid(0, 0);
    std::signal(SIGPIPE, SIG_DFL);
    send_to_file(STDOUT_FILENO, out);
    send_to_file(STDERR_FILENO, err);
    execv("/proc/self/exe", words.data());
    _exit(kNotStarted);
  }
  all_[place] = {.id = id, .work = work, .begin = std::chrono::steady_clock::now()};
}

// Signals are held between the look for them and the wait, which lets them in.
std::optional<Children::Ended> Children::wait() {
  sigset_t held{};
  sigset_t before{};
  sigprocmask(SIG_SETMASK, nullptr, &before);
  sigset_t waiting = before;
  for (const int signal : {SIGCHLD, SIGINT, SIGTERM}) {
    sigaddset(&held, signal);
    sigdelset(&waiting, signal);
  }
  sigprocmask(SIG_BLOCK, &held, nullptr);
  int status = 0;
  pid_t id = 0;
  while (!was_interrupted() && (id = waitpid(-1, &status, WNOHANG)) == 0) {
    sigsuspend(&waiting);
  }
  sigprocmask(SIG_SETMASK, &before, nullptr);
  const auto child = std::ranges::find(all_, id, &Child::id);
  if (id <= 0 || child == all_.end()) {
    return std::nullopt;
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - child->begin;
  Ended ended{.place = static_cast<std::size_t>(child - all_.begin()),
              .work = child->work,
              .seconds = took.count()};
  child->id = 0;
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    ended.how = "ended by signal " + std::to_string(signal) + " (" + strsignal(signal) + ')';
  } else {
    ended.status = WEXITSTATUS(status);
  }
  return ended;
}

}  // namespace iog::tools
