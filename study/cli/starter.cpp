#include "study/cli/starter.h"

#include <fmt/format.h>

#include <boost/algorithm/string/replace.hpp>
#include <sstream>
#include <stdexcept>

#include "study/config/key_reference.h"
#include "study/record/lines.h"

namespace linkstudy {
namespace {

using boost::algorithm::replace_all_copy;

constexpr std::size_t kCommentColumn = 44;

// The part of the batch script that must be there for its replacement to mean anything.
std::string replace_part(const std::string& text, const std::string& from, const std::string& to,
                         const std::string& with) {
  const std::size_t begin = text.find(from);
  const std::size_t end = begin == std::string::npos ? begin : text.find(to, begin);
  if (end == std::string::npos) throw std::logic_error("the batch script lacks '" + from + "'");
  return text.substr(0, begin) + with + text.substr(end);
}

// "# words\n", in lines.
std::string comment_lines(const std::string& words) {
  std::string text;
  for (const std::string& line : words_in_lines(words, kPageWidth - 2)) text += "# " + line + "\n";
  return text;
}

std::string beside(const std::string& line, const std::string& comment) {
  return fmt::format("{:<{}} # {}", line, kCommentColumn - 1, comment);
}

// The comment beside the key where it fits, or else above it.
std::string comment_on(const std::string& line, const std::string& comment) {
  const std::string together = beside(line, comment);
  return together.size() <= kPageWidth ? together + "\n" : comment_lines(comment) + line + "\n";
}

std::string expand(const std::string& line, const std::string& kind) {
  const std::size_t mark = line.find(" #@ ");
  if (mark != std::string::npos) {
    return comment_on(line.substr(0, mark), describe_key(kind, line.substr(mark + 4)).comment);
  }
  if (!line.starts_with("#? ")) return line + "\n";
  const KeyDescription key = describe_key(kind, line.substr(3));
  return comment_on("#" + key.written, key.comment);
}

const std::string& text_of(const std::string& kind) {
  const StarterTexts& texts = starter_texts();
  if (kind == "model") return texts.model;
  if (kind == "study") return texts.study;
  if (kind == "tune") return texts.tune;
  if (kind == "converge") return texts.converge;
  throw std::logic_error("no starter of kind " + kind);
}

std::string fill_in(std::string text, const StarterNames& names) {
  text = replace_all_copy(text, "FILE_NAME", names.file);
  text = replace_all_copy(text, "MODEL_NAME", names.model);
  return replace_all_copy(text, "RESULTS_NAME", names.results);
}

}  // namespace

std::vector<std::string> starter_kinds() {
  return {"model", "study", "tune", "converge"};
}

std::string make_starter(const std::string& kind, const StarterNames& names) {
  std::string text;
  std::istringstream stream(fill_in(text_of(kind), names));
  for (std::string line; std::getline(stream, line);) text += expand(line, kind);
  return text;
}

std::string make_batch_script(const std::string& verb, const std::string& script,
                              const StarterNames& names, const std::string& program) {
  std::string text = starter_texts().batch;
  text = replace_part(text, "# usage:", "#SBATCH",
                      fmt::format("# usage: sbatch -N 2 -n 16 --time 1:00:00 {} [options of "
                                  "linkstudy]\n#        from any folder; {} lies beside it\n"
                                  "#        LINKSTUDY=path      another program\n"
                                  "#        LINKSTUDY_LEAD=S    with another lead: sbatch "
                                  "--signal=B:USR1@S ...\n",
                                  script, names.file));
  text = replace_part(text, "if [ \"${1:-}\" = queue ]", "\nlinkstudy=",
                      fmt::format("results=$here/'{}'; work=({} \"$here\"/'{}' -o \"$results\")\n",
                                  names.results, verb, names.file));
  return replace_part(text, "linkstudy=", "\n",
                      fmt::format("linkstudy=${{LINKSTUDY:-{}}}", program));
}

}  // namespace linkstudy
