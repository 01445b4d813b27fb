#include "study/config/measured_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace linkstudy {
namespace {

std::ptrdiff_t count_times(const MeasuredInput& measured) {
  return std::ranges::count(measured.columns, "time", &WantedColumn::channel);
}

// What is missing has been reported.
bool is_readable(const MeasuredInput& measured) {
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
    const bool is_known = std::ranges::find(texts, one->file, &DataText::name) != texts.end();
    if (one->data && !is_known) texts.push_back({one->file, one->data->text});
  }
  return texts;
}

void check_columns(const MeasuredInput& measured, const std::string& owner, const Location& at,
                   Diagnostics& diagnostics) {
  const bool has_time = count_times(measured) == 1;
  if (has_time && measured.columns.size() > 1) return;
  diagnostics.add(at,
                  has_time ? fmt::format("{} compares no channel", owner)
                           : fmt::format("{} does not say which column is the time", owner),
                  "columns = { time = \"t [s]\", \"closure.S.force.x\" = \"Fx [N]\" }");
}

void read_measured(StudyInput& input, const std::vector<DataText>* kept, Diagnostics& diagnostics) {
  const auto folder = std::filesystem::path(input.file).parent_path();
  for (MeasuredInput* one : measured_inputs(input)) {
    if (!is_readable(*one)) continue;
    if (kept == nullptr) {
      const std::string path = (folder / one->file).lexically_normal().string();
      one->data = read_measured_data(path, one->file_at, one->columns, diagnostics);
      continue;
    }
    const auto found = std::ranges::find(*kept, one->file, &DataText::name);
    if (found != kept->end()) {
      one->data =
          parse_measured_data(found->text, one->file, one->file_at, one->columns, diagnostics);
    } else {
      diagnostics.add(
          one->file_at,
          fmt::format("the results do not hold the data '{}' of their input", one->file),
          "run them again");
    }
  }
}

}  // namespace linkstudy
