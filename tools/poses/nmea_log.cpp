#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "tools/poses/nmea_epochs.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/poses/receiver_fixes.hpp"
#include "tools/poses/text_fields.hpp"

namespace iog::tools {
namespace {

constexpr double kKnot = 1852.0 / 3600;

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

// The positions of one kind of sentence.
struct Positions {
  std::size_t epochs = 0;  // so many had begun at the last one that is used
  double latitude = 0;
  double longitude = 0;
  Tally not_newer;  // other positions of the same time
};

// An empty field is a speed or an angle that is not known.
std::optional<double> speed_in(std::string_view knots) {
  const std::optional<double> value = number_in(knots);
  return value && *value >= 0 ? std::optional(*value * kKnot) : std::nullopt;
}

class Reader {
 public:
  void take(std::string_view line, std::size_t number) {
    line_ = number;
    // A receiver's log may have the time of the PC before a sentence, or what a UBX message left.
    const std::size_t dollar = line.rfind('$');
    const std::string_view sentence =
        dollar == std::string_view::npos ? std::string_view() : sentence_in(line.substr(dollar));
    is_last_damaged_ = false;
    if (sentence.empty()) {
      const bool is_bare = dollar == 0 && line.find('*') == std::string_view::npos;
      count_damage(is_bare ? bare_ : damaged_);
      return;
    }
    is_first_ = false;
    const std::vector<std::string_view> fields = parts_of(sentence, ',');
    const std::string_view name = fields.front().size() == 5 ? fields.front().substr(2) : "";
    const bool is_sound = name == "RMC"   ? take_rmc(fields)
                          : name == "GGA" ? take_gga(fields)
                          : name == "HDT" ? take_hdt(fields)
                          : name == "VTG" ? take_vtg(fields)
                                          : pass_over();
    if (!is_sound) {
      count_damage(damaged_);
    }
  }

  [[nodiscard]] PoseLog log() {
    std::vector<std::string> notes;
    for (UntimedSentences* const untimed : {&headings_, &courses_}) {
      untimed->is_cut_at_begin = is_cut_;
      untimed->is_cut_at_end = is_last_damaged_;
    }
    complete(epochs_, headings_, courses_, notes);
    Tally without_fix;
    std::vector<Fix> fixes;
    for (const NmeaEpoch& epoch : epochs_) {
      if (!epoch.has_fix()) {
        without_fix.add(epoch.line);
        continue;
      }
      fixes.push_back({.time_us = epoch.time_us(),
                       .at = {*epoch.latitude, *epoch.longitude},
                       .speed_mps = epoch.speed_mps,
                       .course_deg = epoch.course_deg,
                       .heading_deg = epoch.heading_deg,
                       .heading_doubt_rad = epoch.doubt_rad,
                       .place = epoch.line});
    }
    if (!fixes.empty() && fixes.front().time_us < kDayUs) {
      notes.emplace_back("no date in it: times are those of 1970-01-01");
    }
    PoseLog log = log_of(std::move(fixes), "line");
    log.notes.insert(log.notes.begin(), notes.begin(), notes.end());
    remark(damaged_, "line|lines that is|are no sound NMEA sentence", log.unit, log.remarks);
    remark(std::ranges::max(of_gga_.not_newer, of_rmc_.not_newer, {}, &Tally::count),
           "position|positions with the time of an earlier one", log.unit, log.remarks);
    remark(bare_, "sentence|sentences without a checksum", log.unit, log.remarks);
    remark(others_, "sentence|sentences other than RMC, GGA, HDT and VTG", log.remarks);
    remark(without_fix, "time|times without a fix", log.unit, log.remarks);
    return log;
  }

 private:
  [[nodiscard]] bool pass_over() {
    ++others_;
    return true;
  }

  void count_damage(Tally& tally) {
    tally.add(line_);
    is_cut_ = is_cut_ || is_first_;
    is_first_ = false;
    is_last_damaged_ = true;
  }

  NmeaEpoch& epoch_at(std::uint64_t time_of_day_us) {
    if (epochs_.empty() || epochs_.back().time_of_day_us != time_of_day_us) {
      epochs_.push_back({.time_of_day_us = time_of_day_us, .line = line_});
    }
    for (UntimedSentences* const untimed : {&headings_, &courses_}) {
      for (std::size_t i = untimed->all.size();
           i-- > 0 && untimed->all[i].times_before == epochs_.size();) {
        untimed->all[i].is_inside = true;
      }
    }
    return epochs_.back();
  }

  // As in a log whose times have no fraction of a second. Some receivers repeat one position with
  // fewer decimals.
  bool is_not_newer(Positions& its, double latitude, double longitude) {
    constexpr double kSameDeg = 1e-6;  // 0.1 m
    const bool is_same = std::abs(latitude - its.latitude) <= kSameDeg &&
                         std::abs(longitude - its.longitude) <= kSameDeg;
    if (its.epochs == epochs_.size() && !is_same) {
      its.not_newer.add(line_);
      return true;
    }
    its.epochs = epochs_.size();
    its.latitude = latitude;
    its.longitude = longitude;
    return false;
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
        (has_fix && ((!midnight && !fields[9].empty()) || !latitude || !longitude))) {
      return false;
    }
    NmeaEpoch& epoch = epoch_at(*time);
    epoch.has_no_fix = epoch.has_no_fix || !has_fix;
    if (!has_fix) {
      return true;  // the date may be that of the receiver's first day
    }
    if (is_not_newer(of_rmc_, *latitude, *longitude)) {
      return true;
    }
    epoch.stated_midnight_us = midnight;
    epoch.latitude = latitude;
    epoch.longitude = longitude;
    epoch.speed_mps = speed_in(fields[7]);
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
    NmeaEpoch& epoch = epoch_at(*time);
    epoch.has_no_fix = epoch.has_no_fix || *quality == 0;
    if (latitude && longitude && is_not_newer(of_gga_, *latitude, *longitude)) {
      return true;
    }
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
    headings_.all.push_back({.times_before = epochs_.size(), .angle_deg = heading});
    return true;
  }

  // $--VTG,course,T,course,M,knots,N,...
  [[nodiscard]] bool take_vtg(const std::vector<std::string_view>& fields) {
    if (fields.size() < 7 || fields[2] != "T" || fields[6] != "N") {
      return false;
    }
    courses_.all.push_back({.times_before = epochs_.size(),
                            .angle_deg = number_in(fields[1]),
                            .speed_mps = speed_in(fields[5])});
    return true;
  }

  std::vector<NmeaEpoch> epochs_;
  UntimedSentences headings_;
  UntimedSentences courses_;
  std::size_t line_ = 0;
  bool is_first_ = true;
  bool is_cut_ = false;  // the log begins within a sentence
  bool is_last_damaged_ = false;
  Positions of_rmc_;
  Positions of_gga_;
  Tally damaged_;
  Tally bare_;
  std::size_t others_ = 0;
};

// The text without the UBX messages between its lines, which may hold line ends.
std::string text_without_ubx(std::span<const std::byte> bytes, std::size_t& messages) {
  std::string text;
  while (!bytes.empty()) {
    const std::size_t message = ubx_message_at(bytes).size();
    messages += message > 0 ? 1U : 0U;
    if (message == 0) {
      text += static_cast<char>(bytes.front());
    }
    bytes = bytes.subspan(std::max<std::size_t>(message, 1));
  }
  return text;
}

}  // namespace

PoseLog read_nmea_log(std::span<const std::byte> bytes) {
  std::size_t messages = 0;
  const std::string text = text_without_ubx(bytes, messages);
  Reader reader;
  std::size_t number = 0;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    if (!trimmed(line).empty()) {
      reader.take(trimmed(line), number);
    }
  }
  PoseLog log = reader.log();
  remark(messages, "UBX message|messages between the lines", log.remarks);
  return log;
}

}  // namespace iog::tools
