#include "study/cli/option_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/topology/nearest_name.h"
#include "study/page/paper_figure.h"
#include "study/report/results_tables.h"
#include "study/report/write_table.h"
#include "study/schedule/progress.h"

namespace linkstudy {
namespace {

namespace po = boost::program_options;

// What fills one member of the command line.
template <class Record>
auto fill_switch(bool Record::*member) {
  return [member](CommandLine& line, const char*) { return po::bool_switch(&(line.*member)); };
}

template <class Record, class Type>
auto fill(Type Record::*member) {
  return [member](CommandLine& line, const char* value) {
    return po::value(&(line.*member))->value_name(value);
  };
}

template <class Record, class Type>
auto fill(std::optional<Type> Record::*member) {
  return [member](CommandLine& line, const char* value) {
    return po::value<Type>()->value_name(value)->notifier(
        [&line, member](const Type& given) { line.*member = given; });
  };
}

template <class Record>
auto fill(std::vector<std::string> Record::*member) {
  return [member](CommandLine& line, const char* value) {
    return po::value(&(line.*member))->composing()->value_name(value);
  };
}

using Rows = std::vector<OptionRow>;

std::vector<std::string> figure_names() {
  std::vector<std::string> names;
  for (const PaperKind& kind : paper_kinds()) names.emplace_back(kind.name);
  return names;
}

std::vector<std::string> table_names() {
  std::vector<std::string> names;
  for (const ResultsTable& table : results_tables()) names.emplace_back(table.name);
  return names;
}

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const TableFormat& format : table_formats()) names.emplace_back(format.name);
  for (const auto& word : kWords<PaperFormat>) names.emplace_back(word.text);
  return names;
}

// Of what goes in and out.
Rows file_options() {
  using Line = CommandLine;
  return {
      {"output,o", "FILE", "write to this file", fill(&Line::output), {"export", "init"}},
      {"output,o",
       "FILE",
       "write to this file; default: report.html in DIR, or beside FILE.h5",
       fill(&Line::output),
       {"report"}},
      {"evaluation", "N",
       "show the motion of this one; default: that of the answer, or the best match",
       fill(&Line::evaluation)},
      {"output,o", "DIR", "results directory", fill(&Line::output)},
      {"set,s", "PATH=VALUE", "set a value of the input; repeatable; * for a name: everywhere",
       fill(&Line::set)},
      {"json", "", "one JSON object on standard output", fill_switch(&Line::json)},
      {"markdown", "", "the text of configs/README.md", fill_switch(&Line::markdown)},
      {"man",
       "N",
       "the manual page: 1 of the program, 5 of the input files",
       fill(&Line::man),
       {},
       {"1", "5"}},
      {"completion", "", "completion of the command line for bash", fill_switch(&Line::completion)},
      {"slurm", "", "write a batch script beside FILE as well", fill_switch(&Line::slurm)},
      {"csv",
       "FILE",
       "write the positions; - is standard output",
       fill(&Line::csv),
       {"kinematics"}},
      {"csv",
       "FILE",
       "write the evaluations and their parameters; - is standard output",
       fill(&Line::csv),
       {"plan"}},
      {"csv", "FILE", "write time histories; - is standard output", fill(&Line::csv)},
      {"h5", "FILE", "write everything as HDF5: positions, poses, singular positions, loops",
       fill(&Line::h5)},
      {"signals", "A,B",
       "channels of --csv or -o, or groups: closure.S.force, joint.A, energy; default: all; "
       "linkstudy "
       "describe channels MODEL",
       fill(&Line::signals)},
      {"all", "", "every evaluation", fill_switch(&Line::all)},
      {"count", "N", "evaluations to run again, beside those that a certificate rests on (8)",
       fill(&Line::count)},
  };
}

// Of results as they are shown.
Rows results_options() {
  using Line = CommandLine;
  return {
      {"watch", "", "again every two seconds, with the best so far, until nothing runs",
       fill_switch(&Line::watch)},
      {"list", "", "the tables there are, with their rows and what they hold",
       fill_switch(&Line::list)},
      {"table", "NAME", "which of them; default: summary", fill(&Line::table), {}, table_names()},
      {"columns", "A,B", "columns in this order; default: all that the table shows",
       fill(&Line::columns)},
      {"rows", "EXPR",
       "rows where comparisons hold: \"closure.S.sde.stiffness >= 1e5 N/m and status = ok\" (= != "
       "< "
       "<= > >=)",
       fill(&Line::rows)},
      {"figure",
       "NAME",
       "draw a figure for a paper with gnuplot; with --format svg, pdf or png, and -o FILE",
       fill(&Line::figure),
       {},
       figure_names()},
      {"traces", "", "the table traces: time histories, and their differences from the reference",
       fill_switch(&Line::traces)},
      {"format",
       "FORM",
       "text, csv, md, latex or json; default: text on a terminal, csv in files and pipes; of a "
       "figure svg, pdf or png",
       fill(&Line::format),
       {},
       format_names()},
  };
}

// Of how a study or tune is run.
Rows run_rows() {
  using Line = CommandLine;
  return {
      {"seed", "N", "seed of random numbers", fill(&Line::seed)},
      {"batch", "N", "points asked for together; changes the path of the search",
       fill(&Line::batch)},
      {"on-failure",
       "WHAT",
       "record: note a failed evaluation and go on; abort: stop",
       fill(&Line::on_failure),
       {},
       {"record", "abort"}},
      {"max-failures", "N|P%", "failed evaluations accepted, a count or a share of all",
       fill(&Line::max_failures)},
      {"timeout", "S", "longest time of one run in seconds", fill(&Line::timeout_s)},
      {"walltime", "S", "end in time, resumable, before S seconds are over (default: from Slurm)",
       fill(&Line::walltime_s)},
      {"fresh", "", "overwrite files that exist", fill_switch(&Line::fresh), {"init"}},
      {"fresh", "", "overwrite what DIR holds", fill_switch(&Line::fresh)},
      {"group", "N", "ranks that share the work on one file; default: all", fill(&Line::group)},
      {"wait", "S", "stay for further files until nothing was to do for S seconds (0)",
       fill(&Line::wait_s)},
      {"retry-failed", "",
       "run again what failed for a passing cause (timeout, exception, rank_lost, cancelled), or "
       "by a limit that is wider now",
       fill_switch(&Line::retry_failed)},
      {"extend", "",
       "keep the rows of a smaller design, or of a search with a smaller budget or narrower "
       "ranges, "
       "that DIR holds",
       fill_switch(&Line::extend)},
      {"cache", "DIR",
       "take finished evaluations from this directory, and keep those that are run; any number of "
       "studies may share it",
       fill(&Line::cache)},
      {"progress",
       "HOW",
       "auto, bar, line or none",
       fill(&Line::progress),
       {},
       {"auto", "bar", "line", "none"}},
      {"log-level",
       "LEVEL",
       "of DIR/linkstudy.log: debug, info, warning, error or off",
       fill(&Line::log_level),
       {},
       {"debug", "info", "warning", "error", "off"}},
  };
}

// Of what is forecast.
Rows plan_options() {
  using Line = CommandLine;
  return {
      {"ranks", "N", "forecast for N ranks (default: tasks of the Slurm job, else processors)",
       fill(&Line::ranks)},
      {"probe", "S", "seconds spent on beginning runs to measure them (2); 0: only count",
       fill(&Line::probe_s)},
  };
}

// Of the course of driven joints, and of an equilibrium.
Rows course_options() {
  using Line = CommandLine;
  return {
      {"drive", "joint.NAME[=FROM:TO]",
       "driven coordinate; repeatable; default: the model's [kinematics], else its [[motion]]s, "
       "else the joint of the first drive load, else the first on ground",
       fill(&Line::drives)},
      {"from", "Q", "first position of the drive, such as 0 or \"90 deg\"; default: the start",
       fill(&Line::from)},
      {"to", "Q", "last position; default: a full turn on", fill(&Line::to)},
      {"positions", "N", "number of positions, both ends included (73)", fill(&Line::positions)},
      {"write-start", "FILE",
       "also write the model with the assembled start (and equilibrium) in its joints",
       fill(&Line::write_start)},
      {"modes", "N",
       "also print the N slowest modes about the equilibrium: frequency, damping, shape",
       fill(&Line::modes)},
      {"speed", "V", "constant speed of a single drive (1 rad/s or m/s)", fill(&Line::speed)},
  };
}

const Rows& option_rows() {
  static const Rows rows = [] {
    Rows all = file_options();
    for (const Rows& more : {results_options(), run_rows(), plan_options(), course_options()}) {
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }();
  return rows;
}

void check_word(const char* option, const CommandLine& line, const std::string& word) {
  const std::vector<std::string>& words = find_option(option, line.verb).words;
  if (std::ranges::find(words, word) != words.end()) return;
  std::string all;
  for (std::size_t i = 0; i < words.size(); ++i) {
    all += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  }
  throw UsageError(fmt::format("--{} must be {}, got '{}'", option, all, word));
}

}  // namespace

std::string OptionRow::full_name() const {
  const std::string all = name;
  return all.substr(0, all.find(','));
}

std::string OptionRow::short_name() const {
  const std::string all = name;
  return all.substr(std::min(full_name().size() + 1, all.size()));
}

const OptionRow& find_option(const std::string& name, const std::string& verb) {
  for (const OptionRow& row : option_rows()) {
    const bool is_of_verb =
        row.verbs.empty() || std::ranges::find(row.verbs, verb) != row.verbs.end();
    if (row.name == name && is_of_verb) return row;
  }
  throw std::logic_error("an option without a row: " + name);
}

void check_values(const CommandLine& line) {
  const auto is_positive = [](const std::optional<double>& value) {
    return !value || (*value > 0.0 && std::isfinite(*value));
  };
  require(is_positive(line.timeout_s), "--timeout must be a positive number of seconds");
  require(is_positive(line.walltime_s), "--walltime must be a positive number of seconds");
  require(!line.positions || (*line.positions >= 2 && *line.positions <= 1000000),
          "--positions must be from 2 to 1000000");
  require(!line.modes || *line.modes > 0, "--modes must be positive");
  require(!line.count || *line.count > 0, "--count must be positive");
  require(!(line.count && line.all), "--all runs every evaluation; leave out --count");
  require(!line.ranks || (*line.ranks > 0 && *line.ranks <= 1000000),
          "--ranks must be from 1 to 1000000");
  require(line.probe_s >= 0.0 && std::isfinite(line.probe_s),
          "--probe must be a number of seconds, or 0");
  require(!(line.fresh && (line.retry_failed || line.extend)),
          "--fresh overwrites the rows that --retry-failed and --extend keep; leave it out");
  require(!line.group || *line.group > 0, "--group must be positive");
  require(line.wait_s >= 0.0 && std::isfinite(line.wait_s), "--wait must be a number of seconds");
  require(!line.batch || *line.batch > 0, "--batch must be positive");
  check_word("progress", line, line.progress);
  check_word("log-level", line, line.log_level);
  if (line.format) check_word("format", line, *line.format);
  if (line.man) check_word("man", line, *line.man);
  if (line.on_failure) check_word("on-failure", line, *line.on_failure);
  require(!(line.json && line.csv == "-"), "--json and --csv - both want standard output");
  const bool chooses = line.traces || line.table || line.columns || line.rows;
  require(!(line.list && chooses), "--list lists all tables; leave out what chooses one");
  require(!(line.traces && line.table), "--traces is --table traces; leave out one of them");
  require(!line.signals || line.csv || line.output,
          "--signals chooses what --csv or -o keeps; add --csv FILE or -o DIR");
}

}  // namespace linkstudy
