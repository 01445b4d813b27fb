#include "study/cli/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/program_options.hpp>
#include <cmath>
#include <sstream>

#include "core/topology/nearest_name.h"
#include "study/report/table.h"

namespace linkstudy {
namespace {

namespace po = boost::program_options;

struct Verb {
  const char* name;
  const char* inputs;  // as in the usage line
  std::size_t fewest;
  std::size_t most;
  const char* does;
  std::vector<std::string> options;
};

constexpr std::size_t kMany = 1000000;

const std::vector<std::string>& run_options() {
  static const std::vector<std::string> names = {
      "output,o", "set,s", "seed",     "on-failure", "max-failures", "timeout",
      "walltime", "fresh", "progress", "log-level",  "json"};
  return names;
}

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> table = [] {
    std::vector<std::string> tune = run_options();
    tune.insert(tune.begin() + 3, "batch");
    return std::vector<Verb>{
        {"init",
         "KIND",
         1,
         1,
         "writes a commented input to start from: model, study or tune",
         {"output,o", "slurm", "fresh"}},
        {"check", "FILE...", 1, kMany, "validates files; lists all problems in one pass", {"json"}},
        {"describe",
         "[PATH | channels [MODEL] | units]",
         0,
         2,
         "prints the reference of the keys, of the channels of a model, or of units",
         {"markdown"}},
        {"simulate",
         "MODEL",
         1,
         1,
         "runs a model once: statics if asked, then time histories",
         {"set,s", "timeout", "csv", "signals", "progress", "json"}},
        {"statics",
         "MODEL",
         1,
         1,
         "finds the static equilibrium and the closure forces there",
         {"set,s", "json"}},
        {"kinematics",
         "MODEL",
         1,
         1,
         "finds mobility, redundant joints, and the motion over a driven cycle",
         {"set,s", "drive", "from", "to", "positions", "speed", "csv", "h5", "json"}},
        {"study", "FILE", 1, 1, "runs a parameter study; starts or continues", run_options()},
        {"tune", "FILE", 1, 1, "finds the lowest value that matches the reference", tune},
        {"status", "DIR", 1, 1, "tells how far a study is, running or dead", {"json"}},
        {"export", "DIR", 1, 1, "prints the results as a table", {"output,o", "format", "traces"}},
    };
  }();
  return table;
}

// Verbs that later versions have.
constexpr std::array kPlanned = {"plan", "converge", "report", "verify"};

template <class Type>
auto optional_value(std::optional<Type>& target) {
  return po::value<Type>()->notifier([&target](const Type& value) { target = value; });
}

void add_run_options(const std::string& name, CommandLine& line, po::options_description& out) {
  if (name == "seed") {
    out.add_options()("seed", optional_value(line.seed)->value_name("N"), "seed of random numbers");
  } else if (name == "batch") {
    out.add_options()("batch", optional_value(line.batch)->value_name("N"),
                      "points asked for together; changes the path of the search");
  } else if (name == "on-failure") {
    out.add_options()("on-failure", optional_value(line.on_failure)->value_name("WHAT"),
                      "record: note a failed evaluation and go on; abort: stop");
  } else if (name == "max-failures") {
    out.add_options()("max-failures", optional_value(line.max_failures)->value_name("N|P%"),
                      "failed evaluations accepted, a count or a share of all");
  } else if (name == "timeout") {
    out.add_options()("timeout", optional_value(line.timeout_s)->value_name("S"),
                      "longest time of one run in seconds");
  } else if (name == "walltime") {
    out.add_options()("walltime", optional_value(line.walltime_s)->value_name("S"),
                      "end in time, resumable, before S seconds are over (default: from Slurm)");
  } else if (name == "fresh") {
    out.add_options()(
        "fresh", po::bool_switch(&line.fresh),
        line.verb == "init" ? "overwrite files that exist" : "overwrite what DIR holds");
  } else if (name == "progress") {
    out.add_options()("progress", po::value(&line.progress)->value_name("HOW"),
                      "auto, bar, line or none");
  } else if (name == "log-level") {
    out.add_options()("log-level", po::value(&line.log_level)->value_name("LEVEL"),
                      "of DIR/linkstudy.log: debug, info, warning, error or off");
  }
}

void add_course_options(const std::string& name, CommandLine& line, po::options_description& out) {
  if (name == "drive") {
    out.add_options()(
        "drive", po::value(&line.drives)->composing()->value_name("joint.NAME[=FROM:TO]"),
        "driven coordinate; repeatable; default: the model's [kinematics], else the joint of the "
        "first drive load, else the first on ground");
  } else if (name == "from") {
    out.add_options()("from", optional_value(line.from)->value_name("Q"),
                      "first position of the drive, such as 0 or \"90 deg\"; default: the start");
  } else if (name == "to") {
    out.add_options()("to", optional_value(line.to)->value_name("Q"),
                      "last position; default: a full turn on");
  } else if (name == "h5") {
    out.add_options()("h5", optional_value(line.h5)->value_name("FILE"),
                      "write everything as HDF5: positions, poses, singular positions, loops");
  } else if (name == "positions") {
    out.add_options()("positions", optional_value(line.positions)->value_name("N"),
                      "number of positions, both ends included (73)");
  } else if (name == "speed") {
    out.add_options()("speed", optional_value(line.speed)->value_name("V"),
                      "constant speed of a single drive (1 rad/s or m/s)");
  } else {
    add_run_options(name, line, out);
  }
}

void add_option(const std::string& name, CommandLine& line, po::options_description& out) {
  if (name == "output,o") {
    const bool is_file = line.verb == "export" || line.verb == "init";
    out.add_options()(name.c_str(),
                      optional_value(line.output)->value_name(is_file ? "FILE" : "DIR"),
                      is_file ? "write to this file" : "results directory");
  } else if (name == "set,s") {
    out.add_options()(name.c_str(), po::value(&line.set)->composing()->value_name("PATH=VALUE"),
                      "set a value of the input; repeatable; * for a name: everywhere");
  } else if (name == "json") {
    out.add_options()("json", po::bool_switch(&line.json), "one JSON object on standard output");
  } else if (name == "markdown") {
    out.add_options()("markdown", po::bool_switch(&line.markdown), "the text of configs/README.md");
  } else if (name == "traces") {
    out.add_options()("traces", po::bool_switch(&line.traces),
                      "time histories, and their differences from the reference");
  } else if (name == "slurm") {
    out.add_options()("slurm", po::bool_switch(&line.slurm),
                      "write a batch script beside FILE as well");
  } else if (name == "csv") {
    out.add_options()("csv", optional_value(line.csv)->value_name("FILE"),
                      line.verb == "kinematics" ? "write the positions; - is standard output"
                                                : "write time histories; - is standard output");
  } else if (name == "signals") {
    out.add_options()("signals", optional_value(line.signals)->value_name("A,B"),
                      "channels of --csv, or groups: closure.S.force, joint.A, energy; default: "
                      "all; linkstudy describe channels MODEL");
  } else if (name == "format") {
    out.add_options()("format", po::value(&line.format)->value_name("FORM"),
                      "text, csv, md, json or latex");
  } else {
    add_course_options(name, line, out);
  }
}

po::options_description describe_options(const Verb& verb, CommandLine& line) {
  po::options_description options("Options");
  line.verb = verb.name;
  for (const std::string& name : verb.options) add_option(name, line, options);
  options.add_options()("help,h", po::bool_switch(&line.help), "print this");
  return options;
}

std::vector<std::string> verb_names() {
  std::vector<std::string> names;
  for (const Verb& verb : verbs()) names.emplace_back(verb.name);
  return names;
}

const Verb& find_verb(const std::string& name) {
  for (const Verb& verb : verbs()) {
    if (name == verb.name) return verb;
  }
  if (std::ranges::find(kPlanned, name) != kPlanned.end()) {
    throw UsageError(fmt::format("'{}' is not supported in this version; verbs: {}", name,
                                 fmt::join(verb_names(), ", ")));
  }
  throw UsageError(
      fmt::format("there is no verb '{}'; {}", name, suggest_name(name, verb_names())));
}

// "--csv" of another verb deserves a better answer than "unrecognised".
std::string explain_unknown(const Verb& verb, const std::string& option) {
  std::vector<std::string> known;
  std::vector<std::string> elsewhere;
  const std::string bare = option.substr(std::min(option.find_first_not_of('-'), option.size()));
  for (const Verb& other : verbs()) {
    for (const std::string& name : other.options) {
      const std::string full = name.substr(0, name.find(','));
      if (&other == &verb) known.push_back("--" + full);
      if (full == bare || (name.size() > full.size() && name.substr(full.size() + 1) == bare)) {
        elsewhere.emplace_back(other.name);
      }
    }
  }
  if (!elsewhere.empty()) {
    return fmt::format("option '{}' does not apply to '{}' (it does to: {})", option, verb.name,
                       fmt::join(elsewhere, ", "));
  }
  return fmt::format("there is no option '{}'; {}", option, suggest_name("--" + bare, known));
}

po::variables_map parse_options(const Verb& verb, const std::vector<std::string>& arguments,
                                CommandLine& line) {
  po::options_description all = describe_options(verb, line);
  all.add_options()("input", po::value(&line.inputs));
  po::positional_options_description positions;
  positions.add("input", -1);
  const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  po::variables_map values;
  try {
    po::store(
        po::command_line_parser(arguments).options(all).positional(positions).style(style).run(),
        values);
    po::notify(values);
  } catch (const po::unknown_option& error) {
    throw UsageError(explain_unknown(verb, error.get_option_name()));
  } catch (const po::error& error) {
    throw UsageError(error.what());
  }
  return values;
}

void require(bool holds, const std::string& message) {
  if (!holds) throw UsageError(message);
}

void check_values(const CommandLine& line) {
  const auto is_positive = [](const std::optional<double>& value) {
    return !value || (*value > 0.0 && std::isfinite(*value));
  };
  require(is_positive(line.timeout_s), "--timeout must be a positive number of seconds");
  require(is_positive(line.walltime_s), "--walltime must be a positive number of seconds");
  require(!line.positions || (*line.positions >= 2 && *line.positions <= 1000000),
          "--positions must be from 2 to 1000000");
  require(!line.batch || *line.batch > 0, "--batch must be positive");
  require(find_word<ProgressMode>(line.progress).has_value(),
          fmt::format("--progress must be auto, bar, line or none, got '{}'", line.progress));
  const std::vector<std::string> levels = {"debug", "info", "warning", "error", "off"};
  require(std::ranges::find(levels, line.log_level) != levels.end(),
          fmt::format("--log-level must be {}, got '{}'", fmt::join(levels, ", "), line.log_level));
  require(!line.on_failure || *line.on_failure == "record" || *line.on_failure == "abort",
          fmt::format("--on-failure must be record or abort (refine is not supported in this "
                      "version), got '{}'",
                      line.on_failure.value_or("")));
  require(!(line.json && line.csv == "-"), "--json and --csv - both want standard output");
  require(!line.signals || line.csv, "--signals chooses what --csv writes; add --csv FILE");
  try {
    table_format(line.format);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--format: {}", error.what()));
  }
}

void check_inputs(const Verb& verb, const CommandLine& line) {
  const std::size_t count = line.inputs.size();
  if (count >= verb.fewest && count <= verb.most) return;
  throw UsageError(fmt::format("usage: linkstudy {} [options] {}", verb.name, verb.inputs));
}

}  // namespace

CommandLine parse_command_line(const std::vector<std::string>& arguments) {
  CommandLine line;
  line.command = fmt::format("linkstudy {}", fmt::join(arguments, " "));
  require(!arguments.empty(), "a verb is missing; try 'linkstudy --help'");
  const std::string& first = arguments.front();
  const bool is_version = first == "--version" || first == "version";
  if (is_version || first == "--help" || first == "-h" || first == "help") {
    if (first == "help" && arguments.size() == 2) {
      line.verb = find_verb(arguments.back()).name;
      line.help = true;
      return line;
    }
    require(arguments.size() == 1,
            fmt::format("{} stands alone{}", first, first == "help" ? ", or before a verb" : ""));
    line.verb = is_version ? "version" : "help";
    return line;
  }
  require(!first.starts_with('-'), fmt::format("a verb comes first, got '{}'", first));
  const Verb& verb = find_verb(first);
  parse_options(verb, {arguments.begin() + 1, arguments.end()}, line);
  if (line.help) return line;
  check_inputs(verb, line);
  check_values(line);
  return line;
}

std::string usage() {
  std::string text = "usage: linkstudy VERB [options] INPUT\n\n";
  for (const Verb& verb : verbs()) {
    const bool fits = std::string_view(verb.inputs).size() < 10;
    text += fmt::format("  {:<11}{:<10}{}\n", verb.name, fits ? verb.inputs : "[...]", verb.does);
  }
  return text +
         "\n'linkstudy help VERB' lists the options of a verb; 'linkstudy --version'.\n"
         "'linkstudy describe' lists every key of the input files, 'describe channels' what a run\n"
         "can tell, 'describe units' how quantities may be written.\n"
         "A joint of the tree moves along or about its local z; a closure has its axis along the\n"
         "local x of its frames.\n"
         "Exit codes: 0 done, 1 internal error, 2 usage or input error, 3 too many cases failed,\n"
         "4 tuning found nothing or was refuted, 75 interrupted and resumable.\n";
}

std::string usage_of(const std::string& name) {
  const Verb& verb = find_verb(name);
  CommandLine line;
  std::ostringstream text;
  text << fmt::format("usage: linkstudy {} [options] {}\n{}\n\n", verb.name, verb.inputs, verb.does)
       << describe_options(verb, line);
  return text.str();
}

}  // namespace linkstudy
