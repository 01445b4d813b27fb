#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "study/config/input_error.h"
#include "study/page/paper_figure.h"
#include "study/store/file.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

// One column of a journal: 84 mm wide.
std::string terminal_of(PaperFormat format) {
  switch (format) {
    case PaperFormat::svg:
      return "svg size 476,357 font 'Helvetica,11' dashed";
    case PaperFormat::pdf:
      return "pdfcairo size 8.4cm,6.3cm font 'Helvetica,8' dashed";
    case PaperFormat::png:
      return "pngcairo size 1190,892 font 'Helvetica,22' dashed linewidth 2";
  }
  return "";
}

// Told apart by people who see few colours ([Okabe, Ito 2008]), and dark enough on paper.
constexpr std::array kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                 "#000000", "#56b4e9", "#b8860b"};
constexpr std::size_t kDashes = 5;  // of gnuplot

// In double quotes gnuplot reads escapes, in single ones a quote is two.
std::string quoted(const std::string& text) {
  std::string safe = "'";
  for (const char c : text) {
    if (c == '\'') safe += c;
    safe += c == '\n' ? ' ' : c;
  }
  return safe + "'";
}

std::string data_of(const PaperSeries& series, bool x_log, bool y_log) {
  std::string text;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const bool is_there = std::isfinite(series.x[i]) && std::isfinite(series.y[i]) &&
                          (!x_log || series.x[i] > 0.0) && (!y_log || series.y[i] > 0.0);
    // An empty line is a gap.
    text += is_there ? fmt::format("{:.9g} {:.9g}", series.x[i], series.y[i]) : "";
    if (is_there && !series.shade.empty()) text += fmt::format(" {:.9g}", series.shade[i]);
    text += "\n";
  }
  return text;
}

std::string style_of(const PaperSeries& series, std::size_t i) {
  if (series.point) {
    return fmt::format("using {} with points pt {} ps 0.8 {}",
                       series.shade.empty() ? "1:2" : "1:2:3", *series.point,
                       series.shade.empty() ? "lc rgb '#d55e00'" : "lc palette");
  }
  return fmt::format("using 1:2 with {} lc rgb '{}' dt {}",
                     series.has_points ? fmt::format("linespoints pt {} ps 0.4", i + 4) : "lines",
                     kColours[series.colour % kColours.size()], series.dash % kDashes + 1);
}

// With some room for marks at the edges.
std::string range_of(char axis, const PaperFigure& figure) {
  const bool is_log = (axis == 'x' ? figure.x : figure.y).is_logarithmic;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const PaperSeries& series : figure.series) {
    for (const double value : axis == 'x' ? series.x : series.y) {
      if (is_log && value <= 0.0) continue;
      low = std::fmin(low, is_log ? std::log10(value) : value);
      high = std::fmax(high, is_log ? std::log10(value) : value);
    }
  }
  const double room = 0.05 * (high - low);
  if (!(room > 0.0)) return "";
  const auto end = [&](double value) { return is_log ? std::pow(10.0, value) : value; };
  return fmt::format("set {}range [{:.9g}:{:.9g}]\n", axis, end(low - room), end(high + room));
}

// One hue by lightness: it reads in grey, too.
std::string scale_of(const PaperFigure& figure) {
  return fmt::format(
      "set palette defined (0 '#c6dbf3', 0.5 '#2a7ad5', 1 '#06234a')\nset cblabel {} noenhanced\n"
      "{}{}{}",
      quoted(figure.colour->label),
      figure.colour->is_logarithmic ? "set logscale cb\nset format cb '10^{%T}'\n" : "",
      range_of('x', figure), range_of('y', figure));
}

class Pipe {
 public:
  explicit Pipe(const std::string& command) : stream_(popen(command.c_str(), "w")) {}
  ~Pipe() { close(); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  bool write(const std::string& text) {
    return stream_ != nullptr && std::fwrite(text.data(), 1, text.size(), stream_) == text.size();
  }
  int close() {
    if (stream_ == nullptr) return -1;
    std::FILE* closing = stream_;
    stream_ = nullptr;
    return pclose(closing);
  }

 private:
  std::FILE* stream_;
};

}  // namespace

std::string gnuplot_script(const PaperFigure& figure, PaperFormat format,
                           const std::filesystem::path& output) {
  std::string text = fmt::format(
      "set terminal {}\nset output {}\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n"
      "set key noenhanced outside below center samplen 3 spacing 1.1\nset grid lc rgb '#d0d0d0'\n"
      "set border 3\nset tics nomirror\nset xrange [*:*] noextend\n",
      terminal_of(format), quoted(output.string()), quoted(figure.x.label), quoted(figure.y.label));
  if (figure.x.is_logarithmic) text += "set logscale x\nset format x '10^{%T}'\n";
  if (figure.y.is_logarithmic) text += "set logscale y\nset format y '10^{%T}'\n";
  if (figure.colour) text += scale_of(figure);
  for (std::size_t i = 0; i < figure.series.size(); ++i) {
    text +=
        fmt::format("$s{} << LINKSTUDY_END\n{}LINKSTUDY_END\n", i,
                    data_of(figure.series[i], figure.x.is_logarithmic, figure.y.is_logarithmic));
  }
  std::string plots;
  for (std::size_t i = 0; i < figure.series.size(); ++i) {
    const PaperSeries& series = figure.series[i];
    plots += fmt::format("{} $s{} {} title {}", plots.empty() ? "" : ",", i, style_of(series, i),
                         quoted(series.title));
  }
  int tag = 1;
  for (const PaperMark& mark : figure.marks) {
    text += mark.is_vertical
                ? fmt::format(
                      "set arrow {} from first {:.9g}, graph 0 to first {:.9g}, graph 1 "
                      "nohead dt 3 lc rgb '#404040'\n",
                      tag, mark.value, mark.value)
                : fmt::format(
                      "set arrow {} from graph 0, first {:.9g} to graph 1, first {:.9g} "
                      "nohead dt 2 lc rgb '#404040'\n",
                      tag, mark.value, mark.value);
    ++tag;
    plots += fmt::format(", NaN with lines dt {} lc rgb '#404040' title {}",
                         mark.is_vertical ? 3 : 2, quoted(mark.title));
  }
  return text + "plot" + plots + "\n";
}

void draw_paper_figure(const PaperFigure& figure, PaperFormat format,
                       const std::filesystem::path& output) {
  const std::filesystem::path made = output.string() + ".tmp";
  Pipe gnuplot("gnuplot 2>&1 1>&2");
  const bool is_written = gnuplot.write(gnuplot_script(figure, format, made));
  const int status = gnuplot.close();
  constexpr int kNoCommand = 127 << 8;
  if (status == kNoCommand) {
    throw UsageError(
        "--figure needs gnuplot, which is not installed (apt-get install gnuplot-nox)");
  }
  std::error_code ignored;
  if (!is_written || status != 0 || std::filesystem::file_size(made, ignored) == 0) {
    std::filesystem::remove(made, ignored);
    throw StoreError(fmt::format("gnuplot did not draw '{}'", output.string()));
  }
  replace_file(made, output);
}

}  // namespace linkstudy
