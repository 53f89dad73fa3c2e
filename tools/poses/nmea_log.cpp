#include <array>
#include <cmath>

#include "tools/poses/local_plane.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/poses/text_fields.hpp"

namespace iog::tools {
namespace {

constexpr double kKnot = 1852.0 / 3600;
// Slower than this a course is no heading.
constexpr double kWalkingMps = 1.0;
constexpr std::uint64_t kDayUs = 86'400'000'000U;

// What the sentences of one time of day say together.
struct Epoch {
  std::uint64_t time_of_day_us = 0;
  std::optional<std::uint64_t> midnight_us{};  // by RMC
  std::optional<double> latitude{};
  std::optional<double> longitude{};
  std::optional<double> speed_mps{};
  std::optional<double> course_deg{};
  std::optional<double> heading_deg{};
  bool has_no_fix = false;
};

// "hhmmss.ss"
std::optional<std::uint64_t> time_of_day(std::string_view text) {
  const std::optional<std::uint64_t> digits = microseconds_in(text);
  if (!digits || text.find('.') < 6 || text.size() < 6) {
    return std::nullopt;
  }
  const std::uint64_t whole = *digits / 1'000'000;
  const std::uint64_t hour = whole / 10'000;
  const std::uint64_t minute = whole / 100 % 100;
  const std::uint64_t second = whole % 100;
  if (hour > 23 || minute > 59 || second > 60) {
    return std::nullopt;
  }
  return ((hour * 60 + minute) * 60 + second) * 1'000'000 + *digits % 1'000'000;
}

// "ddmm.mmmm" and its hemisphere, as degrees.
std::optional<double> angle_in(std::string_view text, std::string_view hemisphere,
                               std::string_view positive_negative, double most) {
  const std::optional<double> value = number_in(text);
  if (!value || *value < 0 || hemisphere.size() != 1) {
    return std::nullopt;
  }
  const std::size_t side = positive_negative.find(hemisphere.front());
  const double degrees = std::floor(*value / 100);
  const double minutes = *value - degrees * 100;
  const double angle = degrees + minutes / 60;
  if (side == std::string_view::npos || minutes >= 60 || angle > most) {
    return std::nullopt;
  }
  return side == 0 ? angle : -angle;
}

std::optional<std::uint64_t> midnight_in(std::string_view ddmmyy) {
  const std::optional<std::uint32_t> digits = whole_number_in(ddmmyy);
  if (!digits || ddmmyy.size() != 6) {
    return std::nullopt;
  }
  // Two digits of the year: receivers are younger than 1980.
  const std::uint32_t year = *digits % 100;
  return unix_us_of(year < 80 ? 2000 + year : 1900 + year, *digits / 100 % 100, *digits / 10'000,
                    0);
}

// The sentence between '$' and '*'; empty if its checksum is wrong or missing.
std::string_view sentence_in(std::string_view line) {
  const std::size_t star = line.find('*');
  if (line.empty() || line.front() != '$' || star == std::string_view::npos ||
      line.size() != star + 3) {
    return {};
  }
  const std::string_view sentence = line.substr(1, star - 1);
  unsigned sum = 0;
  for (const char letter : sentence) {
    sum ^= static_cast<unsigned char>(letter);
  }
  unsigned stated = 0;
  const char* const digits = line.data() + star + 1;
  const auto [end, error] = std::from_chars(digits, digits + 2, stated, 16);
  return error == std::errc() && end == digits + 2 && stated == sum ? sentence : std::string_view();
}

class Reader {
 public:
  void take(std::string_view line) {
    if (line.empty()) {
      return;
    }
    const std::string_view sentence = sentence_in(line);
    if (sentence.empty()) {
      ++damaged_;
      return;
    }
    const std::vector<std::string_view> fields = parts_of(sentence, ',');
    const std::string_view name = fields.front().size() == 5 ? fields.front().substr(2) : "";
    const bool is_sound = name == "RMC"   ? take_rmc(fields)
                          : name == "GGA" ? take_gga(fields)
                          : name == "HDT" ? take_hdt(fields)
                                          : pass_over();
    damaged_ += is_sound ? 0U : 1U;
  }

  [[nodiscard]] PoseLog log() {
    PoseLog log;
    std::size_t without_fix = 0;
    std::uint64_t midnight_us = first_midnight();
    std::uint64_t last_us = 0;
    for (const Epoch& epoch : epochs_) {
      // A time of day that has gone back by more than half a day is of the next one.
      const bool is_next_day = epoch.time_of_day_us + kDayUs / 2 < last_us;
      midnight_us = epoch.midnight_us.value_or(midnight_us + (is_next_day ? kDayUs : 0));
      last_us = epoch.time_of_day_us;
      if (epoch.has_no_fix || !epoch.latitude || !epoch.longitude) {
        ++without_fix;
        continue;
      }
      if (!log.plane) {
        log.plane.emplace(*epoch.latitude, *epoch.longitude);
      }
      log.poses.push_back(pose_of(epoch, midnight_us, *log.plane));
    }
    remark(damaged_, "lines that are no sound NMEA sentence", log.remarks);
    remark(others_, "sentences other than RMC, GGA and HDT", log.remarks);
    remark(without_fix, "times without a fix", log.remarks);
    remark(early_headings_, "headings before the first position", log.remarks);
    return log;
  }

 private:
  [[nodiscard]] bool pass_over() {
    ++others_;
    return true;
  }

  Epoch& epoch_at(std::uint64_t time_of_day_us) {
    if (epochs_.empty() || epochs_.back().time_of_day_us != time_of_day_us) {
      epochs_.push_back({.time_of_day_us = time_of_day_us});
    }
    return epochs_.back();
  }

  // $--RMC,time,A|V,latitude,N|S,longitude,E|W,knots,course,date,...
  [[nodiscard]] bool take_rmc(const std::vector<std::string_view>& fields) {
    if (fields.size() < 10) {
      return false;
    }
    const auto time = time_of_day(fields[1]);
    const auto midnight = midnight_in(fields[9]);
    const auto latitude = angle_in(fields[3], fields[4], "NS", 90);
    const auto longitude = angle_in(fields[5], fields[6], "EW", 180);
    const bool has_fix = fields[2] == "A";
    if (!time || (!has_fix && fields[2] != "V") ||
        (has_fix && (!midnight || !latitude || !longitude))) {
      return false;
    }
    Epoch& epoch = epoch_at(*time);
    epoch.has_no_fix = epoch.has_no_fix || !has_fix;
    epoch.midnight_us = midnight;
    epoch.latitude = latitude;
    epoch.longitude = longitude;
    const std::optional<double> knots = number_in(fields[7]);
    epoch.speed_mps = knots ? std::optional(*knots * kKnot) : std::nullopt;
    epoch.course_deg = number_in(fields[8]);
    return true;
  }

  // $--GGA,time,latitude,N|S,longitude,E|W,quality,...
  [[nodiscard]] bool take_gga(const std::vector<std::string_view>& fields) {
    if (fields.size() < 7) {
      return false;
    }
    const auto time = time_of_day(fields[1]);
    const auto quality = whole_number_in(fields[6]);
    const auto latitude = angle_in(fields[2], fields[3], "NS", 90);
    const auto longitude = angle_in(fields[4], fields[5], "EW", 180);
    if (!time || !quality || (*quality > 0 && (!latitude || !longitude))) {
      return false;
    }
    Epoch& epoch = epoch_at(*time);
    epoch.has_no_fix = epoch.has_no_fix || *quality == 0;
    if (!epoch.latitude || !epoch.longitude) {
      epoch.latitude = latitude;
      epoch.longitude = longitude;
    }
    return true;
  }

  // $--HDT,heading,T
  [[nodiscard]] bool take_hdt(const std::vector<std::string_view>& fields) {
    const std::optional<double> heading = fields.size() < 3 ? std::nullopt : number_in(fields[1]);
    if (!heading || fields[2] != "T") {
      return false;
    }
    if (epochs_.empty()) {
      ++early_headings_;
    } else {
      epochs_.back().heading_deg = heading;
    }
    return true;
  }

  [[nodiscard]] std::uint64_t first_midnight() const {
    for (const Epoch& epoch : epochs_) {
      if (epoch.midnight_us) {
        return *epoch.midnight_us;
      }
    }
    return 0;
  }

  static LoggedPose pose_of(const Epoch& epoch, std::uint64_t midnight_us,
                            const LocalPlane& plane) {
    const LocalPlane::Place place = plane.place_of(*epoch.latitude, *epoch.longitude);
    const bool is_driving = epoch.speed_mps.value_or(0) >= kWalkingMps;
    const std::optional<double> heading_deg =
        epoch.heading_deg ? epoch.heading_deg
                          : (is_driving ? epoch.course_deg : std::optional<double>());
    LoggedPose pose{
        .time_us = midnight_us + epoch.time_of_day_us, .x_m = place.east_m, .y_m = place.north_m};
    if (heading_deg) {
      pose.heading_rad = (90 - *heading_deg) * kRadians;
    }
    // Along the heading: a car that reverses has a course of its own.
    if (heading_deg && epoch.speed_mps && epoch.course_deg) {
      pose.speed_mps = *epoch.speed_mps * std::cos((*epoch.course_deg - *heading_deg) * kRadians);
    }
    return pose;
  }

  std::vector<Epoch> epochs_;
  std::size_t damaged_ = 0;
  std::size_t others_ = 0;
  std::size_t early_headings_ = 0;
};

}  // namespace

PoseLog read_nmea_log(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Reader reader;
  for (const std::string_view line : parts_of(text, '\n')) {
    reader.take(trimmed(line));
  }
  return reader.log();
}

}  // namespace iog::tools
