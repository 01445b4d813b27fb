#include "study/cli/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <map>
#include <set>

#include "study/cli/option_table.h"
#include "study/cli/starter.h"
#include "study/cli/verb_table.h"
#include "study/config/key_reference.h"
#include "study/record/version.h"
#include "study/session/exit_code.h"

namespace linkstudy {
namespace {

using boost::algorithm::replace_all_copy;

// A backslash, a minus and what would be a request at the head of a line.
std::string roff(const std::string& text) {
  const std::string quoted = replace_all_copy(replace_all_copy(text, "\\", "\\e"), "-", "\\-");
  std::string lines = replace_all_copy(quoted, "\n.", "\n\\&.");
  lines = replace_all_copy(lines, "\n'", "\n\\&'");
  return lines.starts_with('.') || lines.starts_with('\'') ? "\\&" + lines : lines;
}

std::string page_head(int section, const std::string& title) {
  return fmt::format(".TH LINKSTUDY {} \"\" \"linkstudy {}\"\n.SH NAME\nlinkstudy \\- {}\n",
                     section, program_version(), roff(title));
}

// ".TP .B \-\-output, \-o DIR meaning"
std::string option_entry(const OptionRow& row) {
  std::string names = "--" + row.full_name();
  if (!row.short_name().empty()) names += ", -" + row.short_name();
  const std::string value = *row.value == '\0' ? "" : fmt::format(" \\fI{}\\fR", roff(row.value));
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(names), value, roff(row.meaning));
}

std::string verb_section(const VerbRow& verb) {
  std::string text = fmt::format(".SS linkstudy {} [options] {}\n{}\n", verb.name,
                                 roff(verb.inputs), roff(verb.does));
  for (const std::string& name : verb.options) text += option_entry(find_option(name, verb.name));
  return text;
}

std::string program_page() {
  std::string text = page_head(1, "batch studies and tuning of spatial linkages");
  text += ".SH SYNOPSIS\n";
  for (const VerbRow& verb : verb_rows()) {
    text += fmt::format(".B linkstudy {}\n[options] {}\n.br\n", verb.name, roff(verb.inputs));
  }
  text +=
      ".SH DESCRIPTION\n" +
      roff(
          "Simulates closed spatial linkages with exact cut joints or with stiff replacement "
          "joints, "
          "runs parameter studies over MPI ranks, and finds the lowest stiffness of a replacement "
          "joint whose joint forces match the exact joint within a tolerance. study and tune run "
          "under mpirun or srun as they are, and continue where they were interrupted.") +
      "\n";
  text += ".SH VERBS\n";
  for (const VerbRow& verb : verb_rows()) text += verb_section(verb);
  text += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : kExitStatuses) {
    text += fmt::format(".TP\n.B {}\n{}\n", code, roff(meaning));
  }
  return text +
         ".SH SEE ALSO\n.BR linkstudy (5)\nfor the keys of the input files, "
         "linkstudy describe channels, linkstudy describe units, mpirun(1).\n";
}

std::string keys_page() {
  return page_head(5, "input files: keys of models, studies and tunes") +
         ".SH DESCRIPTION\nInputs are TOML. The same text is printed by\n.B linkstudy describe\n"
         "and, for a part of it, by\n.B linkstudy describe PATH\n.SH KEYS\n.nf\n" +
         roff(*describe("")) + ".fi\n.SH SEE ALSO\n.BR linkstudy (1)\n";
}

// Paths such as link.*.mass: the lines of the reference that are not indented.
std::string key_paths() {
  std::set<std::string> paths;
  const std::string text = *describe("");
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const bool is_path = !line.empty() && line.find(' ') == std::string::npos;
    if (is_path) paths.insert(line);
    begin = end + 1;
  }
  return fmt::format("{}", fmt::join(paths, " "));
}

std::string words_case() {
  std::string text;
  std::set<std::string> done;
  for (const VerbRow& verb : verb_rows()) {
    for (const std::string& name : verb.options) {
      const OptionRow& row = find_option(name, verb.name);
      if (row.words.empty() || !done.insert(row.full_name()).second) continue;
      text +=
          fmt::format("    --{}) words=\"{}\" ;;\n", row.full_name(), fmt::join(row.words, " "));
    }
  }
  return text;
}

std::string options_case() {
  std::string text;
  for (const VerbRow& verb : verb_rows()) {
    std::vector<std::string> names;
    for (const std::string& name : verb.options) {
      names.push_back("--" + find_option(name, verb.name).full_name());
    }
    text += fmt::format("    {}) options=\"{} --help\" ;;\n", verb.name, fmt::join(names, " "));
  }
  return text;
}

constexpr const char* kCompletion =
    R"(# Completion of linkstudy for bash; written by linkstudy describe.
_linkstudy() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]}
  local verbs="@VERBS@" keys="@KEYS@" options= words=
  COMPREPLY=()
  set -f
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "$verbs help --help --version" -- "$word"))
    set +f
    return
  fi
  case $before in
@WORDS@    --set|-s) words=$keys ;;
  esac
  case $verb in
@OPTIONS@    help) words=$verbs ;;
  esac
  if [ -z "$words" ] && [ "$verb" = init ]; then words="@KINDS@"; fi
  if [ -z "$words" ] && [ "$verb" = describe ]; then words="channels units $keys"; fi
  case $word in
    -*) COMPREPLY=($(compgen -W "$options" -- "$word")) ;;
    *) if [ -n "$words" ]; then COMPREPLY=($(compgen -W "$words" -- "$word")); fi ;;
  esac
  set +f
}
complete -o default -o bashdefault -F _linkstudy linkstudy
)";

}  // namespace

std::string manual_page(int section) {
  return section == 1 ? program_page() : keys_page();
}

std::string bash_completion() {
  std::vector<std::string> verbs;
  for (const VerbRow& verb : verb_rows()) verbs.emplace_back(verb.name);
  const std::map<std::string, std::string> texts = {
      {"@VERBS@", fmt::format("{}", fmt::join(verbs, " "))},
      {"@KEYS@", key_paths()},
      {"@WORDS@", words_case()},
      {"@OPTIONS@", options_case()},
      {"@KINDS@", fmt::format("{}", fmt::join(starter_kinds(), " "))}};
  std::string text = kCompletion;
  for (const auto& [mark, value] : texts) text = replace_all_copy(text, mark, value);
  return text;
}

}  // namespace linkstudy
