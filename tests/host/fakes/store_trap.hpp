// Memory in which a store ends the core that makes it: what a data abort is to a real one, in the
// middle of whatever it does.
#pragma once

#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <sys/mman.h>
#include <unistd.h>

#include "fakes/thread_cores.hpp"

namespace iog::tests {

// Of whole pages. All cores may read them, and store into them once the trap is open. One trap at a
// time.
class StoreTrap {
 public:
  StoreTrap(void* memory, std::size_t bytes) {
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto first = reinterpret_cast<std::uintptr_t>(memory);
    page_bytes_ = page;
    begin_ = (first + page - 1) / page * page;
    end_ = (first + bytes) / page * page;
    struct sigaction action {};
    action.sa_sigaction = &StoreTrap::take_signal;
    action.sa_flags = SA_SIGINFO | SA_NODEFER;
    sigaction(SIGSEGV, &action, &before_);
    active() = this;
  }
  StoreTrap(const StoreTrap&) = delete;
  StoreTrap& operator=(const StoreTrap&) = delete;
  ~StoreTrap() {
    open();
    active() = nullptr;
    sigaction(SIGSEGV, &before_, nullptr);
  }

  // While it is open: the victim is to end when it stores into its next page but so many.
  void aim_at(ThreadCores& cores, std::size_t victim, int pages) {
    cores_ = &cores;
    victim_ = victim;
    pages_left_ = pages;
  }
  void close() { protect(begin_, end_ - begin_, PROT_READ); }
  void open() { protect(begin_, end_ - begin_, PROT_READ | PROT_WRITE); }

 private:
  static std::atomic<StoreTrap*>& active() {
    static std::atomic<StoreTrap*> trap = nullptr;
    return trap;
  }

  static void protect(std::uintptr_t begin, std::size_t bytes, int how) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the pages around an object are whole numbers
    mprotect(reinterpret_cast<void*>(begin), bytes, how);
  }

  static void take_signal(int signal, siginfo_t* what, void* /*context*/) {
    StoreTrap* const trap = active();
    const auto at = reinterpret_cast<std::uintptr_t>(what->si_addr);
    if (trap == nullptr || at < trap->begin_ || at >= trap->end_) {
      std::signal(signal, SIG_DFL);
      return;
    }
    if (ThreadCores::current() == trap->victim_ && trap->pages_left_-- == 0) {
      trap->cores_->fault();
    }
    protect(at / trap->page_bytes_ * trap->page_bytes_, trap->page_bytes_, PROT_READ | PROT_WRITE);
  }

  std::uintptr_t page_bytes_ = 0;
  std::uintptr_t begin_ = 0;
  std::uintptr_t end_ = 0;
  struct sigaction before_ {};
  ThreadCores* cores_ = nullptr;
  std::size_t victim_ = 0;
  std::atomic<int> pages_left_ = 0;
};

}  // namespace iog::tests
