#include "lab/experiments/side_by_side.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "tools/program/exit_status.hpp"

namespace iog::lab {
namespace {

// Hands out the experiments one by one, and keeps what comes back.
class Work {
 public:
  Work(std::span<const Experiment> experiments, const Input& input,
       const std::function<void(std::size_t)>& on_done)
      : experiments_(experiments), input_(&input), on_done_(&on_done), found_(experiments.size()) {}

  // Runs in every thread.
  void share() {
    for (std::size_t i = next_++; i < experiments_.size(); i = next_++) {
      run(i);
    }
  }

  // After all threads.
  std::vector<Tables> take() {
    if (failure_) {
      std::rethrow_exception(failure_);
    }
    return std::move(found_);
  }

 private:
  void run(std::size_t i) {
    try {
      found_[i] = experiments_[i].run(*input_);
      const std::lock_guard lock(mutex_);
      (*on_done_)(++done_);
    } catch (const tools::UsageError&) {
      fail(std::current_exception());
    } catch (const std::exception& error) {
      fail(std::make_exception_ptr(std::runtime_error(
          "experiment " + std::string(experiments_[i].name) + " failed: " + error.what())));
    }
  }

  void fail(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) {
      failure_ = std::move(failure);
    }
    next_ = experiments_.size();
  }

  std::span<const Experiment> experiments_;
  const Input* input_;
  const std::function<void(std::size_t)>* on_done_;
  std::vector<Tables> found_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

std::vector<Tables> run_side_by_side(std::span<const Experiment> experiments, const Input& input,
                                     const std::function<void(std::size_t)>& on_done) {
  Work work(experiments, input, on_done);
  {
    const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
    std::vector<std::jthread> threads;
    for (std::size_t i = 1; i < std::min(cores, experiments.size()); ++i) {
      threads.emplace_back([&work] { work.share(); });
    }
    work.share();
  }
  return work.take();
}

}  // namespace iog::lab
