// gnuplot reads a script with the data in it from a file without a name, and its output is the SVG.
// Neither a shell nor a path is in between, and nothing of the user's settings: the words of a plot
// stand in single quotes, where gnuplot takes every character but the quote for itself.
#include "lab/experiments/plot.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <limits>
#include <spawn.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::lab {
namespace {

// Of M. Okabe and K. Ito, "Color Universal Design" (2008); without its yellow, too pale on white.
constexpr std::array<std::string_view, 7> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                   "#E69F00", "#000000", "#56B4E9"};
// What tells the series apart in black and white: dashes, markers, hatching.
constexpr std::array<std::string_view, 7> kDashes{"1",          "(8,4)",      "(2,3)", "(8,3,2,3)",
                                                  "(14,4,3,4)", "(14,4,8,4)", "(4,2)"};
constexpr std::array<std::string_view, 7> kMarkers{"7", "4", "2", "9", "12", "5", "6"};
constexpr std::array<std::string_view, 7> kHatchings{"3", "4", "5", "1", "2", "6", "7"};

std::string quoted(std::string_view words) {
  std::string text = "'";
  for (const char letter : words) {
    if (letter == '\'') {
      text += "''";
    } else {
      text += letter == '\n' ? ' ' : letter;
    }
  }
  return text + "'";
}

// Every digit that the value has, and no more; a value that is not finite leaves a gap.
std::string number(double value) {
  if (!std::isfinite(value)) {
    return "NaN";
  }
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

bool is_bars(const Series& series) { return series.style == Series::Style::kBars; }

// All bars of one x together take four fifths of the smallest distance between two x.
struct BarLayout {
  double width = 0;
  double first = 0;  // the first series's shift
};

BarLayout layout_of_bars(const Plot& plot) {
  std::vector<double> places;
  double count = 0;
  for (const Series& series : plot.series) {
    if (is_bars(series)) {
      count += 1;
      for (const auto& [x, y] : series.points) {
        places.push_back(x);
      }
    }
  }
  std::sort(places.begin(), places.end());
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (places[i] > places[i - 1]) {
      step = std::min(step, places[i] - places[i - 1]);
    }
  }
  const double all = std::isfinite(step) ? 0.8 * step : 0.8;
  const double width = count > 0 ? all / count : all;
  return {.width = width, .first = (width - all) / 2};
}

// "$data0 << END ... END"
std::string data_of(const Plot& plot) {
  const BarLayout bars = layout_of_bars(plot);
  double shift = bars.first;
  std::string text;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    text.append("$data").append(std::to_string(i)).append(" << END\n");
    for (const auto& [x, y] : series.points) {
      text.append(number(is_bars(series) ? x + shift : x)).append(" ");
      text.append(number(y)).append(" ").append(number(bars.width)).append("\n");
    }
    text += "END\n";
    if (is_bars(series)) {
      shift += bars.width;
    }
  }
  return text;
}

std::string how(Series::Style style, std::size_t place) {
  const std::string colour = "lc rgb '" + std::string(kColours[place % kColours.size()]) + "'";
  const std::string line = "lw 2 dt " + std::string(kDashes[place % kDashes.size()]);
  const std::string marker = "ps 1 pt " + std::string(kMarkers[place % kMarkers.size()]);
  switch (style) {
    case Series::Style::kLine:
      return "using 1:2 with lines " + colour + " " + line;
    case Series::Style::kPoints:
      return "using 1:2 with points " + colour + " " + marker;
    case Series::Style::kLineAndPoints:
      return "using 1:2 with linespoints " + colour + " " + line + " " + marker;
    case Series::Style::kSteps:
      return "using 1:2 with steps " + colour + " " + line;
    case Series::Style::kBars:
      break;
  }
  return "using 1:2:3 with boxes " + colour + " fs pattern " +
         std::string(kHatchings[place % kHatchings.size()]);
}

// Plain numbers where they are short, else powers of ten.
std::string log_axis(const Plot& plot, char axis) {
  double smallest = 1;
  double largest = 1;
  for (const Series& series : plot.series) {
    for (const auto& [x, y] : series.points) {
      const double value = axis == 'x' ? x : y;
      if (value > 0) {
        smallest = std::min(smallest, value);
        largest = std::max(largest, value);
      }
    }
  }
  const bool is_short = smallest >= 1e-3 && largest < 1e5;
  return std::string("set logscale ") + axis + "\nset format " + axis +
         (is_short ? " '%g'\n" : " '10^{%T}'\n");
}

std::string axes_of(const Plot& plot) {
  std::string text = "set xlabel " + quoted(plot.x_label) + " noenhanced\nset ylabel " +
                     quoted(plot.y_label) + " noenhanced\n";
  if (plot.has_log_x) {
    // Not on to the next power of ten, where no data are.
    text += log_axis(plot, 'x') + "set autoscale xfix\n";
  }
  if (plot.has_log_y) {
    text += log_axis(plot, 'y');
  } else if (std::any_of(plot.series.begin(), plot.series.end(), is_bars)) {
    // A bar's length is its value, and none touches the frame.
    text += "set yrange [*<0:0<*]\nset offsets graph 0.04, graph 0.04, 0, 0\n";
  }
  for (std::size_t i = 0; i < plot.x_names.size(); ++i) {
    text.append(i == 0 ? "set xtics noenhanced (" : ", ");
    text.append(quoted(plot.x_names[i].second)).append(" ").append(number(plot.x_names[i].first));
    text.append(i + 1 == plot.x_names.size() ? ")\n" : "");
  }
  return text;
}

std::string script_of(const Plot& plot) {
  std::string text =
      "set encoding utf8\n"
      "set terminal svg size 800,500 background '#ffffff' enhanced "
      "font 'Helvetica,Arial,sans-serif,14'\n"
      "set key outside bottom center horizontal Left reverse height 0.5 noenhanced\n"
      "set border 3 lc rgb '#444444'\n"
      "set tics nomirror\n"
      "set grid xtics ytics lt 1 lw 1 lc rgb '#dddddd'\n"
      "set title " +
      quoted(plot.title) + " noenhanced\n" + axes_of(plot) + data_of(plot);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    text.append(i == 0 ? "plot " : ", ").append("$data").append(std::to_string(i)).append(" ");
    text.append(how(series.style, i));
    text.append(series.name.empty() ? " notitle" : " title " + quoted(series.name));
  }
  return text + "\n";
}

// A file without a name, at its beginning; its bytes go to a program that reads it.
class NamelessFile {
 public:
  explicit NamelessFile(std::string_view text) : file_(memfd_create("plot", MFD_CLOEXEC)) {
    while (file_ >= 0 && !text.empty()) {
      const ssize_t written = ::write(file_, text.data(), text.size());
      if (written < 0 && errno != EINTR) {
        break;
      }
      text.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
    }
    if (file_ < 0 || !text.empty() || lseek(file_, 0, SEEK_SET) != 0) {
      throw tools::UsageError(std::string("no memory for a plot: ") + std::strerror(errno));
    }
  }
  ~NamelessFile() { close(file_); }
  NamelessFile(const NamelessFile&) = delete;
  NamelessFile& operator=(const NamelessFile&) = delete;

  [[nodiscard]] int get() const { return file_; }

 private:
  int file_;
};

// The status that gnuplot ends with; 127 if there is none. What it complains of is for stderr.
int run_gnuplot(const NamelessFile& script, const std::string& path) {
  constexpr int kMissing = 127;
  std::array<std::string, 3> arguments{"gnuplot", "--default-settings", "-"};
  std::array<char*, 4> argv{arguments[0].data(), arguments[1].data(), arguments[2].data(), nullptr};
  std::string locale = "LC_ALL=C.UTF-8";
  std::array<char*, 2> environment{locale.data(), nullptr};
  posix_spawn_file_actions_t files{};
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, script.get(), STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, path.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0666);
  pid_t process = 0;
  const int error =
      posix_spawnp(&process, "gnuplot", &files, nullptr, argv.data(), environment.data());
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) {
    return kMissing;
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

void write_svg(const Plot& plot, const std::string& path) {
  tools::OutputFile(path).finish();  // one plain sentence if it cannot be written
  const int status = run_gnuplot(NamelessFile(script_of(plot)), path);
  if (status == 127) {
    throw tools::UsageError(path +
                            ": there is no gnuplot to draw it; install Debian's gnuplot-nox");
  }
  if (status != 0) {
    throw tools::UsageError(path + ": gnuplot (Debian's gnuplot-nox) could not draw it, status " +
                            std::to_string(status));
  }
}

}  // namespace iog::lab
