#include "study/cli/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <sstream>
#include <string_view>

#include "core/topology/nearest_name.h"
#include "study/cli/option_table.h"
#include "study/cli/verb_table.h"
#include "study/session/exit_code.h"

namespace linkstudy {
namespace {

namespace po = boost::program_options;

po::options_description describe_options(const VerbRow& verb, CommandLine& line) {
  po::options_description options("Options");
  line.verb = verb.name;
  for (const std::string& name : verb.options) {
    const OptionRow& row = find_option(name, verb.name);
    options.add_options()(row.name, row.bind(line, row.value), row.meaning);
  }
  options.add_options()("help,h", po::bool_switch(&line.help), "print this");
  return options;
}

// "--csv" of another verb deserves a better answer than "unrecognised".
std::string explain_unknown(const VerbRow& verb, const std::string& option) {
  std::vector<std::string> known;
  std::vector<std::string> elsewhere;
  const std::string bare = option.substr(std::min(option.find_first_not_of('-'), option.size()));
  for (const VerbRow& other : verb_rows()) {
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

po::variables_map parse_options(const VerbRow& verb, const std::vector<std::string>& arguments,
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

void check_inputs(const VerbRow& verb, const CommandLine& line) {
  const std::size_t count = line.inputs.size();
  if (count >= verb.fewest && count <= verb.most) return;
  throw UsageError(fmt::format("usage: linkstudy {} [options] {}", verb.name, verb.inputs));
}

}  // namespace

void require(bool holds, const std::string& message) {
  if (!holds) throw UsageError(message);
}

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
  const VerbRow& verb = find_verb(first);
  parse_options(verb, {arguments.begin() + 1, arguments.end()}, line);
  line.goes_on = std::ranges::find(verb.options, "retry-failed") != verb.options.end();
  if (line.help) return line;
  check_inputs(verb, line);
  check_values(line);
  return line;
}

std::string usage() {
  std::string text = "usage: linkstudy VERB [options] INPUT\n\n";
  for (const VerbRow& verb : verb_rows()) {
    const bool fits = std::string_view(verb.inputs).size() < 10;
    text += fmt::format("  {:<11}{:<10}{}\n", verb.name, fits ? verb.inputs : "[...]", verb.does);
  }
  text +=
      "\n'linkstudy help VERB' lists the options of a verb; 'linkstudy --version'.\n"
      "'linkstudy describe' lists every key of the input files, 'describe channels' what a run\n"
      "can tell, 'describe units' how quantities may be written.\n"
      "A joint of the tree moves along or about its local z; a closure has its axis along the\n"
      "local x of its frames.\n\nExit codes\n";
  for (const ExitStatus& status : kExitStatuses) {
    text += fmt::format("  {:<4}{}\n", status.code, status.meaning);
  }
  return text;
}

std::string usage_of(const std::string& name) {
  const VerbRow& verb = find_verb(name);
  CommandLine line;
  std::ostringstream text;
  text << fmt::format("usage: linkstudy {} [options] {}\n{}\n\n", verb.name, verb.inputs, verb.does)
       << describe_options(verb, line);
  return text.str();
}

}  // namespace linkstudy
