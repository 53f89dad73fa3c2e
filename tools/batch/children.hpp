// Processes that run side by side, so that a crash of one ends nothing else.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace iog::tools {

class Children {
 public:
  // Their output goes to folder/0.out, folder/0.err and so on, by place.
  Children(std::string folder, std::size_t most);
  // Kills those that run.
  ~Children();
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  struct Ended {
    std::size_t place;
    std::size_t work;   // of start()
    std::string how{};  // "ended by signal 11 (Segmentation fault)"; empty: by itself
    int status = 0;     // then
    double seconds = 0;
  };

  // A place where nothing runs; none if all are taken.
  [[nodiscard]] std::optional<std::size_t> free_place() const;
  [[nodiscard]] bool are_running() const;

  // Runs this program again with other arguments. It ends when we do, however we end, and Ctrl-C
  // reaches only us.
  void start(std::size_t place, std::size_t work, std::vector<std::string> arguments);

  // The next one that ends; none if an interrupt comes or has come (catch_interrupts()). One of
  // them runs.
  [[nodiscard]] std::optional<Ended> wait();

  [[nodiscard]] std::string file(std::size_t place, const char* ending) const {
    return folder_ + '/' + std::to_string(place) + ending;
  }

 private:
  struct Child {
    pid_t id = 0;  // 0: none
    std::size_t work = 0;
    std::chrono::steady_clock::time_point begin{};
  };

  std::string folder_;
  std::vector<Child> all_;
};

}  // namespace iog::tools
