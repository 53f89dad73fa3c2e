#include "lab/experiments/page.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "lab/experiments/markdown.hpp"
#include "lab/experiments/overview.hpp"
#include "lab/experiments/sections.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::lab {
namespace {

constexpr auto kSections = std::to_array<NamedSection>({
    {"output_rates", output_rates},
    {"goals", goals},
    {"worst_frames", worst_frames},
    {"scaling", scaling},
});

std::string command_of(const TablesInput& input) {
  return "experiments --seed " + std::to_string(input.seed) + " --seconds " +
         std::to_string(input.seconds);
}

// Who gave the page its numbers. A recording goes by its name; where it lies is nobody's business.
void add_introduction(Markdown& page, const TablesInput& input) {
  page.title("Results");
  page.paragraph(
      "What two papers claim about occupancy grids, and what this project finds when it repeats "
      "it. Every word and number of this page was written by `" +
      command_of(input) +
      "`; none is typed. *Thesis* is T. A. Rakotovao, *Integer Occupancy Grids* (Grenoble 2017), "
      "*many-core paper* is T. A. Rakotovao, J. Mottin, D. Puschini and C. Laugier, *Real-time "
      "power-efficient integration of multi-sensor occupancy grid on many-core* (2015). Tables, "
      "figures and sections without a name are the thesis's. *By the paper* is what it prints, "
      "*measured* what was counted or computed here, *modelled* what follows from a measured "
      "number by a stated assumption.");
  page.paragraph(
      "The simulated drive is that of `iog simulate --seed " + std::to_string(input.seed) +
      " --seconds " + std::to_string(input.seconds) +
      "`: the reference car with four LUX in a city, " + std::to_string(25 * input.seconds) +
      " frames. Instructions of the Cortex-A9 were counted, and cycles modelled, before by "
      "`lab/target/measure_a9`; they are compiled in.");
  if (!input.recordings.empty()) {
    page.paragraph(
        "Recordings, which are not part of this project, added with `--recording`; `lab/results "
        "--help` says where those of docs/results.md are from:");
    for (const Recording& recording : input.recordings) {
      page.item("recording `" + std::filesystem::path(recording.pcap).filename().string() +
                "`, vehicle `" + recording.vehicle + "`");
    }
  }
}

void add_made_with(Markdown& page) {
  page.heading("Made with");
  page.paragraph("on this PC: " IOG_MADE_WITH);
}

// Hands out the sections one by one, and keeps what comes back.
class Work {
 public:
  Work(std::span<const NamedSection> sections, const TablesInput& input,
       const std::function<void(std::size_t)>& on_done)
      : sections_(sections), input_(&input), on_done_(&on_done), results_(sections.size()) {}

  // Runs in every thread.
  void share() {
    for (std::size_t i = next_++; i < sections_.size(); i = next_++) {
      try {
        results_[i] = sections_[i].compute(*input_);
        const std::lock_guard lock(mutex_);
        (*on_done_)(++done_);
      } catch (const tools::UsageError&) {
        fail(std::current_exception());
      } catch (const std::exception& error) {
        fail(std::make_exception_ptr(std::runtime_error(
            "section " + std::string(sections_[i].name) + " failed: " + error.what())));
      }
    }
  }

  // After all threads.
  std::vector<Section> take() {
    if (failure_) {
      std::rethrow_exception(failure_);
    }
    return std::move(results_);
  }

 private:
  void fail(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) {
      failure_ = std::move(failure);
    }
    next_ = sections_.size();
  }

  std::span<const NamedSection> sections_;
  const TablesInput* input_;
  const std::function<void(std::size_t)>* on_done_;
  std::vector<Section> results_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

std::span<const NamedSection> all_sections() { return kSections; }

std::vector<Section> compute(std::span<const NamedSection> sections, const TablesInput& input,
                             const std::function<void(std::size_t)>& on_done) {
  Work work(sections, input, on_done);
  {
    const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
    std::vector<std::jthread> threads;
    for (std::size_t i = 1; i < std::min(cores, sections.size()); ++i) {
      threads.emplace_back([&work] { work.share(); });
    }
    work.share();
  }
  return work.take();
}

std::string page_of(const TablesInput& input, std::span<const Section> sections) {
  std::vector<Claim> claims;
  for (const Section& section : sections) {
    claims.insert(claims.end(), section.claims.begin(), section.claims.end());
  }

  Markdown page;
  add_introduction(page, input);
  add_overview(page, claims);
  for (const Section& section : sections) {
    page.append(section.body);
  }
  add_made_with(page);
  return page.text();
}

}  // namespace iog::lab
