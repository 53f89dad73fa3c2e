#include "tools/receive/serial/reception.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>

#include "stream/crc32.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/progress.hpp"
#include "tools/receive/run_statistics.hpp"
#include "tools/receive/serial/serial_input.hpp"
#include "tools/receive/serial/serial_link.hpp"

namespace iog::tools {
namespace {

using Clock = std::chrono::steady_clock;

// One line for each tile of cells that was told of: frame, tile, CRC-32 of its cells, 0 if all are
// unknown.
class TileLog {
 public:
  explicit TileLog(const std::string& path) : file_(path) {
    file_.write("# frame tile cells_crc\n");
  }
  void add(std::size_t tile, const ToldTile& told) {
    stream::Crc32 crc;
    if (told.cells) {
      crc.update(*told.cells);
    }
    file_.write(std::to_string(told.frame_number) + " " + std::to_string(tile) + " " +
                hex(told.cells ? crc.value() : 0) + "\n");
  }
  void finish() { file_.finish(); }

 private:
  OutputFile file_;
};

class SerialReception {
 public:
  explicit SerialReception(const SerialOptions& options)
      : options_(&options),
        pictures_(options.pictures),
        log_(options.tiles.empty() ? nullptr : std::make_unique<TileLog>(options.tiles)),
        link_([this](std::size_t tile, const ToldTile& told) { note(tile, told); },
              [this] { look_at_newest(); }),
        progress_("frames", options.frames) {}

  void run() {
    SerialInput input(options_->path, options_->baud);
    last_evidence_ = Clock::now();
    while (!was_interrupted() && !is_done() && !is_idle()) {
      const auto bytes = input.take(std::chrono::milliseconds(100));
      if (!bytes) {
        break;
      }
      link_.take(*bytes);
    }
  }

  void write_results() {
    if (log_ && link_.counts().messages > 0) {
      log_->finish();
    }
    if (link_.grid().newest_seen()) {
      pictures_.write_last(composed());
    } else if (link_.counts().messages > 0) {
      pictures_.write_none();
    }
    const Facts facts = this->facts();
    if (!options_->summary.empty()) {
      write_facts(options_->summary, facts);
    }
    for (const auto& [name, value] : facts) {
      std::string words = name;
      std::ranges::replace(words, '_', ' ');
      std::cout << row(words, value);
    }
  }

  void check() const {
    if (link_.counts().messages == 0 && link_.version_sent()) {
      throw CheckFailed("the target sends " + words_of_version(*link_.version_sent()));
    }
    if (link_.counts().messages == 0) {
      throw CheckFailed("no message came; is this the grid's line, and " +
                        std::to_string(options_->baud) + " its rate?");
    }
  }

 private:
  [[nodiscard]] std::uint32_t frames() const {
    return first_frame_ ? link_.grid().newest()->frame_number - *first_frame_ + 1 : 0;
  }
  [[nodiscard]] bool is_done() const {
    return options_->frames > 0 && frames() >= options_->frames;
  }
  [[nodiscard]] bool is_idle() const {
    const std::chrono::duration<double> silent = Clock::now() - last_evidence_;
    return options_->idle_timeout_s > 0 && silent.count() > options_->idle_timeout_s;
  }

  [[nodiscard]] GridFrame composed() const {
    return link_.grid().composed(static_cast<std::uint64_t>(options_->max_age_s * 1e6));
  }

  void note(std::size_t tile, const ToldTile& told) {
    if (log_) {
      log_->add(tile, told);
    }
  }

  void look_at_newest() {
    const auto& newest = link_.grid().newest();
    if (newest->frame_number == last_frame_) {
      return;
    }
    last_frame_ = newest->frame_number;
    if (!first_frame_ || newest->run_number != run_number_) {
      run_number_ = newest->run_number;
      first_frame_ = newest->frame_number;
      first_closed_us_ = newest->closed_us;
    }
    if (newest->has_evidence()) {
      last_evidence_ = Clock::now();
    }
    progress_.show(frames());
    if (newest->has_evidence() && options_->pictures.every > 0) {
      pictures_.offer(composed());
    }
  }

  // Of the tiles of cells in which something is known: how many, and how old on the mean and at
  // most, by the target's clock.
  void add_ages(Facts& facts) const {
    TimeStatistics ages;
    std::size_t known = 0;
    for (std::size_t tile = 0; tile < geometry::kTileCount && link_.grid().newest(); ++tile) {
      const auto told = link_.grid().cells_of(tile);
      if (told && told->cells) {
        ++known;
        ages.add(static_cast<double>(link_.grid().age_us(*told)) / 1000);
      }
    }
    facts.emplace_back("tiles_known", std::to_string(known));
    facts.emplace_back("mean_age_ms", std::to_string(static_cast<std::uint64_t>(ages.mean())));
    facts.emplace_back("largest_age_ms", std::to_string(static_cast<std::uint64_t>(ages.max())));
  }

  [[nodiscard]] Facts facts() const {
    const SerialCounts counts = link_.counts();
    Facts facts;
    const auto add = [&facts](const char* name, std::uint64_t count, bool is_always_told = false) {
      if (count > 0 || is_always_told) {
        facts.emplace_back(name, std::to_string(count));
      }
    };
    add("frames", frames(), true);
    add("messages", counts.messages, true);
    add("bytes", counts.bytes, true);
    const std::uint64_t micros =
        link_.grid().newest() ? link_.grid().newest()->closed_us - first_closed_us_ : 0;
    add("bytes_per_second", micros > 0 ? counts.bytes * 1'000'000 / micros : 0);
    add("messages_lost", counts.lost, true);
    add("messages_damaged", counts.damaged, true);
    add("messages_repeated", counts.repeated);
    add("messages_not_ours", counts.not_ours);
    add("messages_other_version", counts.other_version);
    add("messages_malformed", counts.malformed);
    add("messages_not_understood", counts.not_understood);
    add("tiles_unreadable", counts.unreadable_tiles);
    add("target_restarts", counts.restarts);
    add("coarse_tiles", counts.coarse_tiles, true);
    add("tiles", counts.tiles, true);
    add_ages(facts);
    return facts;
  }

  const SerialOptions* options_;
  FrameWriter pictures_;
  std::unique_ptr<TileLog> log_;
  SerialLink link_;
  Progress progress_;
  Clock::time_point last_evidence_;
  std::optional<std::uint32_t> first_frame_;
  std::optional<std::uint32_t> last_frame_;
  std::uint64_t first_closed_us_ = 0;
  std::uint32_t run_number_ = 0;
};

}  // namespace

void receive_serial(const SerialOptions& options) {
  SerialReception reception(options);
  reception.run();
  reception.write_results();
  reception.check();
}

}  // namespace iog::tools
