#include "study/config/measured_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "study/config/earlier_data.h"

namespace linkstudy {
namespace {

std::ptrdiff_t count_times(const MeasuredInput& measured) {
  return std::ranges::count(measured.columns, "time", &WantedColumn::channel);
}

// What is missing has been reported.
bool is_readable(const MeasuredInput& measured) {
  if (measured.results) {
    const bool names_any = !measured.signals.empty() || !measured.columns.empty();
    return !measured.results->directory.empty() && names_any && count_times(measured) == 0;
  }
  return !measured.file.empty() && count_times(measured) == 1 && measured.columns.size() > 1;
}

// Of a const study and of another.
template <class Measured, class Study>
std::vector<Measured*> list_measured(Study& input) {
  std::vector<Measured*> all;
  const auto add_reference = [&](auto& reference) {
    if (reference && reference->measured) all.push_back(&*reference->measured);
  };
  add_reference(input.reference);
  for (auto& one : input.load_case) {
    if (one.measured && !one.reference) all.push_back(&*one.measured);
    add_reference(one.reference);
  }
  return all;
}

// What results keep the text under: of one evaluation there may be several, of other channels.
std::string kept_name(const MeasuredInput& measured) {
  if (!measured.results) return measured.file;
  return fmt::format("{}: {}", source_name(measured), fmt::join(earlier_heads(measured), ", "));
}

// References take of results what the matches compare.
void name_compared(const StudyInput& input, MeasuredInput& measured, Diagnostics& diagnostics) {
  if (!measured.results || !measured.columns.empty() || !measured.signals.empty()) return;
  if (input.kind != FileKind::calibrate && input.match.empty()) {
    diagnostics.add(measured.file_at, "no [[match]] compares anything with these results",
                    "take the reference out, or add [[match]]");
  }
  for (const MatchInput& match : input.match) {
    const auto is_known =
        std::ranges::count(measured.signals, match.reference_signal, &TraceInput::signal) > 0;
    if (is_known) continue;
    measured.signals.push_back({match.reference_signal, match.reference_at});
  }
}

class DataReader {
 public:
  DataReader(const StudyInput& input, const std::vector<DataText>* kept,
             const ReadEarlierRun& earlier, Diagnostics& diagnostics)
      : folder_(std::filesystem::path(input.file).parent_path()),
        kept_(kept),
        earlier_(earlier),
        diagnostics_(diagnostics) {}

  std::shared_ptr<const MeasuredData> read(MeasuredInput& measured) const {
    const std::optional<std::string> text =
        kept_ != nullptr ? find_kept(measured) : text_of(measured);
    if (!text) return nullptr;
    const std::string name = measured.results ? source_name(measured) : path_of(measured.file);
    return measured.results
               ? parse_earlier_data(*text, name, measured, diagnostics_)
               : parse_measured_data(*text, name, measured.file_at, measured.columns, diagnostics_);
  }

 private:
  std::string path_of(const std::string& written) const {
    return kept_ != nullptr ? written : (folder_ / written).lexically_normal().string();
  }

  std::optional<std::string> text_of(MeasuredInput& measured) const {
    if (!measured.results) {
      return read_data_text(path_of(measured.file), measured.file_at, diagnostics_);
    }
    if (!earlier_) {
      diagnostics_.add(measured.file_at, "earlier results cannot be read here", "name a file");
      return std::nullopt;
    }
    const std::optional<EarlierRun> run =
        earlier_(path_of(measured.results->directory), measured, diagnostics_);
    if (!run) return std::nullopt;
    measured.results->digest = run->digest;
    return write_earlier_data(*run, source_name(measured), measured, diagnostics_);
  }

  std::optional<std::string> find_kept(const MeasuredInput& measured) const {
    const auto found = std::ranges::find(*kept_, kept_name(measured), &DataText::name);
    if (found != kept_->end()) return found->text;
    diagnostics_.add(
        measured.file_at,
        fmt::format("the results do not hold the data '{}' of their input", kept_name(measured)),
        "run them again");
    return std::nullopt;
  }

  std::filesystem::path folder_;
  const std::vector<DataText>* kept_;
  const ReadEarlierRun& earlier_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::vector<MeasuredInput*> measured_inputs(StudyInput& input) {
  return list_measured<MeasuredInput>(input);
}

std::vector<const MeasuredInput*> measured_inputs(const StudyInput& input) {
  return list_measured<const MeasuredInput>(input);
}

std::vector<DataText> data_texts(const StudyInput& input) {
  std::vector<DataText> texts;
  for (const MeasuredInput* one : measured_inputs(input)) {
    const std::string name = kept_name(*one);
    const bool is_known = std::ranges::find(texts, name, &DataText::name) != texts.end();
    if (!one->data || is_known) continue;
    texts.push_back({name, one->data->text, one->results ? one->results->digest : ""});
  }
  return texts;
}

std::string source_name(const MeasuredInput& measured) {
  if (!measured.results) return measured.file;
  const ResultsInput& results = *measured.results;
  std::string name = results.directory;
  if (results.evaluation) name += fmt::format(", evaluation {}", *results.evaluation);
  if (!results.load_case.empty()) name += fmt::format(", load case {}", results.load_case);
  return name;
}

void check_data(const MeasuredInput& measured, const std::string& owner, const Location& at,
                Diagnostics& diagnostics) {
  const std::ptrdiff_t times = count_times(measured);
  if (measured.results) {
    if (times == 0) return;
    const auto time = std::ranges::find(measured.columns, "time", &WantedColumn::channel);
    diagnostics.add(time->channel_at, "results have a time of their own, which needs no column",
                    "take it out");
    return;
  }
  if (times == 1 && measured.columns.size() > 1) return;
  diagnostics.add(at,
                  times == 1 ? fmt::format("{} compares no channel", owner)
                             : fmt::format("{} does not say which column is the time", owner),
                  "columns = { time = \"t [s]\", \"closure.S.force.x\" = \"Fx [N]\" }");
}

void read_measured(StudyInput& input, const std::vector<DataText>* kept,
                   const ReadEarlierRun& earlier, Diagnostics& diagnostics) {
  const DataReader reader(input, kept, earlier, diagnostics);
  for (MeasuredInput* one : measured_inputs(input)) {
    name_compared(input, *one, diagnostics);
    if (is_readable(*one)) one->data = reader.read(*one);
  }
}

}  // namespace linkstudy
