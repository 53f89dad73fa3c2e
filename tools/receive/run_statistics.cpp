#include "tools/receive/run_statistics.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>

#include "tools/program/file.hpp"
#include "tools/program/fixed.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/report/names.hpp"
#include "tools/report/words.hpp"
#include "tools/vehicles/grid_words.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

std::string times(const TimeStatistics& statistics) {
  return fixed(statistics.mean(), 0) + " us mean, " + fixed(statistics.max(), 0) + " us max";
}

}  // namespace

void TimeStatistics::add(double micros) {
  ++count_;
  sum_ += micros;
  max_ = std::max(max_, micros);
}

void RunStatistics::add(const GridFrame& frame) {
  ++frames_;
  incomplete_ += frame.is_whole() || frame.is_damaged ? 0U : 1U;
  damaged_ += frame.is_damaged ? 1U : 0U;
  tiles_ += frame.tiles;
  classes_.add(frame);
  objects_.add(frame);
  if (frame.has_end) {
    tiles_not_sent_ += frame.end.tiles_lost;
    for (std::size_t i = 0; i < fates_.size(); ++i) {
      fates_[i] += frame.end.fates[i];
    }
    too_slow_ += points_not_taken(frame.end) > 0 ? 1U : 0U;
    add_drops(frame);
    stack_used_bytes_ = std::max(stack_used_bytes_, frame.end.stack_used_bytes);
    core_shares_ = stream::counts_of<work::TeamCounts>(frame.end);
    run_before_ = stream::counts_of<hal::RunBefore>(frame.end);
    commands_ = stream::counts_of<CommandCounts>(frame.end);
    loop_times_ = stream::counts_of<LoopTimes>(frame.end);
    hottest_dc_ = std::max(hottest_dc_, frame.end.temperature_dc);
    // Two frames are combined, because a capture may end within a scan. After the last scan, a
    // target closes some more frames without one; silence is longer.
    constexpr std::uint64_t kFramesAfterScan = 4;
    frames_without_scan_ = frame.header.has_evidence() ? 0 : frames_without_scan_ + 1;
    if (frames_without_scan_ == 0 || frames_without_scan_ > kFramesAfterScan || records_.empty()) {
      unwatched_ = frame.end.unwatched & newest_unwatched_;
      newest_unwatched_ = frame.end.unwatched;
    }
    blocked_ = frame.end.blocked;
    sensor_count_ = std::min<std::uint8_t>(frame.header.sensor_count, vehicle::kMaxSensors);
    add_times(frame);
    add_states(frame);
    add_points(frame.end);
  }
  if (!frame.header.has_evidence()) {
    nothing_taken_ += frame.header.points_other > 0 ? 1U : 0U;
    return;
  }
  grid_ = frame.shape;
  const FrameRecord record = record_of(frame);
  timed_out_ += record.is_timed_out ? 1U : 0U;
  records_.push_back(record);
  hash_.add(record.grid_crc);
}

// A target counts since its start.
void RunStatistics::add_drops(const GridFrame& frame) {
  if (last_ && last_->run_number != frame.header.run_number) {
    drops_before_ = packet_drops_;
  }
  std::ranges::transform(drops_before_, frame.end.packet_drops, packet_drops_.begin(), std::plus());
}

// States count in frames with evidence; before the first of these, in reports of silence.
void RunStatistics::add_states(const GridFrame& frame) {
  if (!frame.header.has_evidence() && !records_.empty()) {
    return;
  }
  if (frame.header.has_evidence() && records_.empty()) {
    sensor_frames_ = {};
  }
  for (std::size_t i = 0; i < sensor_count_; ++i) {
    const auto state = static_cast<std::size_t>(frame.end.sensors[i].state);
    sensor_frames_[i][std::min(state, kSensorStateNames.size() - 1)] += 1;
    blocked_frames_[i] += frame.end.sensors[i].blocked != intake::Blocked::kNot ? 1U : 0U;
  }
}

void RunStatistics::add_points(const stream::FrameEnd& end) {
  for (std::size_t i = 0; i < sensor_count_; ++i) {
    const intake::SensorReport& sensor = end.sensors[i];
    packets_fused_[i] += sensor.packets;
    most_points_[i] = std::max(most_points_[i], sensor.points);
    if (sensor.packets > 0) {
      most_packet_points_[i] = std::max(most_packet_points_[i], sensor.points / sensor.packets);
    }
  }
}

// The time to publish a frame is known only when it is over: the next frame tells it.
void RunStatistics::add_times(const GridFrame& frame) {
  double until_published = 0;
  if (frame.end.stopwatch_hz > 0) {
    const double us_per_tick = 1e6 / frame.end.stopwatch_hz;
    const double fuse = frame.end.ticks.fuse * us_per_tick;
    const double mark = frame.end.ticks.mark * us_per_tick;
    const double perceive =
        frame.header.has_classes() ? frame.end.ticks.perceive * us_per_tick : 0.0;
    if (frame.header.has_evidence()) {
      fuse_us_.add(fuse);
      mark_us_.add(mark);
      if (frame.header.has_classes()) {
        perceive_us_.add(perceive);
      }
    }
    if (last_ && last_->has_evidence() && last_->run_number == frame.header.run_number &&
        last_->frame_number + 1 == frame.header.frame_number) {
      const double publish = frame.end.ticks.publish * us_per_tick;
      publish_us_.add(publish);
      frame_us_.add(until_published_us_ + publish);
    }
    until_published = fuse + mark + perceive;
  }
  until_published_us_ = until_published;
  last_ = frame.header;
}

std::uint64_t RunStatistics::points_used() const {
  return fates_[static_cast<std::size_t>(vehicle::Fate::kUsed)];
}

Facts RunStatistics::facts() const {
  Facts facts;
  add_fact(facts, "frames", frames_);
  add_fact(facts, "frames_with_evidence", records_.size());
  add_fact(facts, "frames_timed_out", timed_out_);
  add_fact(facts, "frames_too_slow", too_slow_);
  add_fact(facts, "frames_incomplete", incomplete_);
  add_fact(facts, "frames_damaged", damaged_);
  add_fact(facts, "tiles", tiles_);
  add_fact(facts, "tiles_not_sent", tiles_not_sent_);
  for (std::size_t i = 0; i < sensor_count_; ++i) {
    const std::string sensor = "sensor_" + std::to_string(i) + '_';
    add_facts(facts, sensor, sensor_frames_[i], kSensorStateNames);
    add_fact(facts, sensor + "blocked", blocked_frames_[i]);
  }
  add_facts(facts, "points_", fates_, kPointFateNames);
  add_facts(facts, "packets_", packet_drops_, kPacketDropNames);
  const std::array stages{std::pair{"fuse", &fuse_us_}, std::pair{"mark", &mark_us_},
                          std::pair{"perceive", &perceive_us_}, std::pair{"publish", &publish_us_}};
  for (const auto& [name, statistics] : stages) {
    facts.emplace_back(std::string(name) + "_us_mean", fixed(statistics->mean(), 0));
    facts.emplace_back(std::string(name) + "_us_max", fixed(statistics->max(), 0));
  }
  facts.emplace_back("frame_us_max", fixed(frame_us_.max(), 0));
  add_target_facts(facts);
  facts.emplace_back("run_hash", hex(run_hash()));
  std::ranges::move(classes_.facts(), std::back_inserter(facts));
  std::ranges::move(objects_.facts(), std::back_inserter(facts));
  return facts;
}

// What only some targets say.
void RunStatistics::add_target_facts(Facts& facts) const {
  add_fact(facts, "stack_used_bytes", stack_used_bytes_);
  if (core_shares_) {
    add_fact(facts, "cores_at_work", core_shares_->at_work);
    add_fact(facts, "items_for_lost_cores", core_shares_->for_lost);
    for (std::size_t core = 0; core < core_shares_->items.size(); ++core) {
      add_fact(facts, "items_of_core_" + std::to_string(core), core_shares_->items[core]);
    }
  }
  if (run_before_) {
    add_fact(facts, "starts_since_power_up", run_before_->starts);
    add_fact(facts, "end_of_the_run_before", static_cast<std::uint64_t>(run_before_->end.cause));
    add_fact(facts, "detail_of_that_end", run_before_->end.detail);
  }
  if (commands_) {
    facts.emplace_back("commands", words_of(*commands_, last_->run_number));
  }
  if (unwatched_) {
    facts.emplace_back("unwatched_sectors", hex(*unwatched_, 16));
  }
  if (blocked_) {
    facts.emplace_back("blocked_sectors", hex(*blocked_, 16));
  }
  if (hottest_dc_ != hal::kTemperatureNotKnown) {
    facts.emplace_back("chip_temperature_dc_hottest", std::to_string(hottest_dc_));
  }
  for (std::size_t i = 0; loop_times_ && i < loop_times_->rows.size(); ++i) {
    const std::string name = key_of("loop_", kLoopTimeNames[i]);
    facts.emplace_back(name + "_us_mean", fixed(mean_us(loop_times_->rows[i]), 0));
    add_fact(facts, name + "_us_worst", loop_times_->rows[i].worst_us);
  }
}

std::string RunStatistics::rows_of_sensors() const {
  std::string text;
  for (std::size_t i = 0; i < sensor_count_; ++i) {
    const std::string blocked =
        blocked_frames_[i] > 0 ? ", blocked " + std::to_string(blocked_frames_[i]) : "";
    text +=
        row("sensor " + std::to_string(i), list_of(sensor_frames_[i], kSensorStateNames) + blocked);
  }
  return text;
}

// Of the points of which a height counts.
std::string RunStatistics::rows_of_ground() const {
  using vehicle::Fate;
  constexpr std::array kOfGround{Fate::kGround, Fate::kOverhang, Fate::kUnderGround};
  std::uint64_t all = points_used();
  for (const Fate fate : kOfGround) {
    all += fates_[static_cast<std::size_t>(fate)];
  }
  if (all == points_used()) {
    return {};
  }
  std::string words;
  for (const Fate fate : kOfGround) {
    const std::size_t its = static_cast<std::size_t>(fate);
    words += (words.empty() ? "" : ", ") +
             fixed(100 * static_cast<double>(fates_[its]) / static_cast<double>(all), 1) + " % " +
             std::string(kPointFateNames[its]);
  }
  // A right mount has less than 1 % under it, also in hills (docs/ground.md).
  constexpr std::uint64_t kOfAWrongMount = 50;
  return row("over the ground", words) +
         row_if(kOfAWrongMount * fates_[static_cast<std::size_t>(Fate::kUnderGround)] > all,
                "MOUNT?",
                "many returns are under the ground: is the pitch or roll of a mount "
                "wrong, or its sign? pitch_deg is positive down; `iog mount` finds it");
}

std::string RunStatistics::row_of_too_slow() const {
  const std::uint64_t left = fates_[static_cast<std::size_t>(vehicle::Fate::kNotTaken)];
  const std::uint64_t all = std::accumulate(fates_.begin(), fates_.end(), std::uint64_t{0});
  return left == 0 ? std::string()
                   : row("TARGET TOO SLOW", counted(left, "point|points not taken, ") +
                                                percent(left, all) + " % of all, in " +
                                                std::to_string(too_slow_) + " of " +
                                                std::to_string(frames_) + " frames");
}

// The stream does not say whose packets they were: a sensor is named in whose fullest frame another
// packet had no room.
std::string RunStatistics::row_of_over_budget() const {
  const std::uint64_t over =
      packet_drops_[static_cast<std::size_t>(intake::PacketDrop::kOverBudget)];
  if (over == 0) {
    return {};
  }
  const std::uint64_t all = std::accumulate(packets_fused_.begin(), packets_fused_.end(), over);
  std::string words = std::to_string(over) + " of " + std::to_string(all) + " packets dropped, " +
                      percent(over, all) + " %: ";
  const CatalogueEntry* const car = last_ ? vehicle_of_id(last_->vehicle_id) : nullptr;
  bool is_named = false;
  for (std::size_t i = 0; car != nullptr && i < std::min(car->sensors.size(), most_points_.size());
       ++i) {
    const description::SensorConfig& sensor = car->sensors[i];
    if (most_points_[i] + most_packet_points_[i] > sensor.max_points_per_scan) {
      words += "sensor " + std::string(sensor.name) + " may have " +
               std::to_string(sensor.max_points_per_scan) +
               " points a scan (max_points_per_scan), and sends more; ";
      is_named = true;
    }
  }
  words += is_named
               ? "a unit of two returns sends twice as many as one of one return"
               : "more points than the car's file (max_points_per_scan) or a frame's marks allow";
  return row("OVER BUDGET", words);
}

// What the target itself has counted, of all its frames since its start.
std::string RunStatistics::rows_of_target() const {
  std::string text = core_shares_ ? row("cores at work", words_of(*core_shares_)) : std::string();
  if (run_before_ && run_before_->starts > 1) {
    text += row("target's starts", words_of(*run_before_));
  }
  if (commands_) {
    text += row("commands", words_of(*commands_, last_->run_number));
  }
  for (std::size_t i = 0; loop_times_ && i < loop_times_->rows.size(); ++i) {
    const health::Durations& time = loop_times_->rows[i];
    text += row_if(time.count() > 0, "loop: " + std::string(kLoopTimeNames[i]), words_of(time));
  }
  return text;
}

std::string RunStatistics::table(bool has_target) const {
  const std::string where = has_target ? " on target" : " here";
  // A target has a stack; what a PC fuses for a recording has no times either.
  const bool is_timed = !has_target || stack_used_bytes_ > 0;
  const std::uint64_t blocked = blocked_.value_or(0);
  return row("frames", std::to_string(frames_) + ", with evidence " +
                           std::to_string(records_.size()) + ", of these closed by time " +
                           std::to_string(timed_out_)) +
         row_if(incomplete_ + damaged_ > 0, "frames not whole",
                std::to_string(incomplete_) + " incomplete, " + std::to_string(damaged_) +
                    " damaged") +
         row_if(grid_ != geometry::Grid{}, "grid", words_of_grid(grid_)) + rows_of_sensors() +
         row_if(unwatched_.has_value(), "unwatched at the end",
                words_of_sectors(unwatched_.value_or(0))) +
         row_if(blocked != 0, "blocked at the end",
                words_of_sectors(blocked) + ": nearly nothing comes back") +
         row_if(hottest_dc_ != hal::kTemperatureNotKnown, "chip",
                words_of_temperature(hottest_dc_) + " at the hottest" +
                    (hottest_dc_ >= kWarmDc ? ", which is too warm" : "")) +
         row("scan points", list_of(fates_, kPointFateNames)) + rows_of_ground() +
         row_of_too_slow() + row_of_over_budget() +
         row("packets dropped", list_of(packet_drops_, kPacketDropNames)) +
         row("tiles", std::to_string(tiles_)) +
         row_if(tiles_not_sent_ > 0, "tiles not sent", std::to_string(tiles_not_sent_)) +
         row_if(is_timed, "fuse" + where, times(fuse_us_)) +
         row_if(is_timed, "mark" + where, times(mark_us_)) +
         row_if(is_timed && perceive_us_.count() > 0, "perceive" + where, times(perceive_us_)) +
         row_if(is_timed, "publish" + where, times(publish_us_)) +
         row_if(has_target && is_timed, "deepest stack",
                std::to_string(stack_used_bytes_) + " bytes") +
         rows_of_target() + row("run hash", hex(run_hash())) + classes_.table() + objects_.table();
}

void write_facts(const std::string& path, const Facts& facts) {
  OutputFile file(path);
  for (const auto& [key, value] : facts) {
    std::string line = key;
    line.append("=").append(value).append("\n");
    file.write(line);
  }
  file.finish();
}

}  // namespace iog::tools
