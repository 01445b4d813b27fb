#include "study/session/identity.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "core/base/isa.h"
#include "study/config/measured_reader.h"
#include "study/config/toml_reader.h"
#include "study/config/toml_writer.h"
#include "study/record/digest.h"
#include "study/record/version.h"
#include "study/schedule/batch_job.h"
#include "study/session/version_text.h"
#include "study/store/status.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

constexpr const char* kResolvedStudy = "resolved_study";
constexpr const char* kResolvedModel = "resolved_model";
constexpr const char* kResolvedReference = "resolved_reference";
constexpr const char* kDigestSuffix = "_digest";
constexpr const char* kFileSuffix = "_file";
constexpr const char* kModelFile = "model_file";
constexpr const char* kCourse = "course";

// Settings that change how a study is run and not what it computes.
Tree without_run_settings(Tree resolved) {
  if (Tree* run = resolved.find("run")) {
    for (const char* key : {"timeout", "max_failures", "on_failure"}) run->erase(key);
  }
  return resolved;
}

std::string text_of_file(const std::string& path) {
  Diagnostics ignored;  // it was read before; if it has gone since, the text is left empty
  return read_text_file(path, ignored).value_or("");
}

std::string commented(const std::string& text) {
  std::string result;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    result += "# " + text.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return result;
}

std::string set_comments(const SessionOptions& options) {
  std::string text;
  for (const std::string& set : options.set) text += fmt::format("\n# --set {}\n", set);
  return text;
}

// A run of another model.
bool has_own_reference(const StudyInput& input) {
  return input.reference && input.reference->is_run() && input.reference->model != input.model;
}

// The study with all defaults; what --set changed and the models follow as comments, so that the
// text is a study file again.
std::string resolved_text(const SessionOptions& options, const StudyInput& input) {
  std::string text = write_toml(input.resolved) + set_comments(options);
  text += fmt::format("\n# Model of the cases, {}, with --set in it:\n", input.model->file());
  text += commented(write_toml(input.model->tree()));
  if (has_own_reference(input)) {
    text += fmt::format("\n# Model of the reference, {}:\n", input.reference->model->file());
    text += commented(write_toml(input.reference->model->tree()));
  }
  return text;
}

std::string data_name(std::size_t i) {
  return fmt::format("data_{}", i);
}

// The texts of measured data, and the files or earlier results they are of.
void add_data(const StudyInput& input, std::vector<NamedText>& texts) {
  const std::vector<DataText> data = data_texts(input);
  for (std::size_t i = 0; i < data.size(); ++i) {
    texts.push_back({data_name(i), data[i].text});
    texts.push_back({data_name(i) + kFileSuffix, data[i].name});
    if (!data[i].digest.empty()) texts.push_back({data_name(i) + kDigestSuffix, data[i].digest});
  }
}

std::string machine_text(const Transport& transport) {
  utsname name{};
  uname(&name);
  return fmt::format("{} {} {}, {} processors, {} nodes", name.sysname, name.release, name.machine,
                     std::thread::hardware_concurrency(), transport.nodes());
}

ProvenanceRow start_of(const SessionOptions& options, std::uint64_t total,
                       const Transport& transport) {
  const BatchJob job = find_batch_job(read_environment);
  return {"",
          unix_time_s(),
          total,
          static_cast<std::uint32_t>(transport.size()),
          transport.host(),
          program_version(),
          git_revision(),
          options.command,
          std::string(name_of(simd_level().isa)),
          static_cast<std::uint32_t>(simd_level().lanes),
          job.id,
          job.restart};
}

const std::string* find_text(const StudyResults& results, const std::string& name) {
  const auto found = std::ranges::find(results.texts, name, &NamedText::name);
  return found == results.texts.end() ? nullptr : &found->text;
}

std::string text_of(const StudyResults& results, const std::string& name) {
  const std::string* found = find_text(results, name);
  return found == nullptr ? std::string() : *found;
}

[[noreturn]] void throw_without_input() {
  throw StoreError("these results do not hold their models as they were run; run them again");
}

}  // namespace

StudyIdentity make_identity(const SessionOptions& options, const Evaluator& evaluator,
                            std::uint64_t total, const Transport& transport) {
  const StudyInput& input = evaluator.input();
  StudyIdentity identity;
  identity.description = {input.name, std::string(name_of(input.kind)), input.run.seed,
                          evaluator.parameters(), evaluator.responses()};
  std::vector<std::string> texts = {write_toml(without_run_settings(input.resolved)),
                                    write_toml(input.model->tree())};
  if (input.reference && input.reference->is_run()) {
    texts.push_back(write_toml(input.reference->model->tree()));
  }
  for (const MeasuredInput* one : measured_inputs(input)) {
    if (one->data) texts.push_back(one->data->text);
  }
  identity.input_sha256 = input_sha256(texts);
  identity.texts = {{"input", text_of_file(input.file)},
                    {"model", text_of_file(input.model->file())},
                    {"resolved", resolved_text(options, input)},
                    {"build", version_text()},
                    {"machine", machine_text(transport)},
                    {kResolvedStudy, write_toml(input.resolved)},
                    {kResolvedModel, write_toml(input.model->tree())}};
  if (has_own_reference(input)) {
    identity.texts.push_back({kResolvedReference, write_toml(input.reference->model->tree())});
  }
  add_data(input, identity.texts);
  identity.start = start_of(options, total, transport);
  return identity;
}

StudyIdentity make_model_identity(const SessionOptions& options, const std::string& verb,
                                  const ModelDocument& document, const ModelInput& input,
                                  const std::string& course, std::vector<Response> responses) {
  const LocalTransport alone;
  const std::string model = write_toml(document.tree());
  StudyIdentity identity;
  identity.description = {input.name, verb, 0, {}, std::move(responses)};
  identity.input_sha256 = input_sha256({verb, model, course});
  identity.texts = {{"model", text_of_file(document.file())},
                    {"resolved", write_toml(input.resolved) + set_comments(options)},
                    {"build", version_text()},
                    {"machine", machine_text(alone)},
                    {kResolvedModel, model},
                    {kModelFile, document.file()}};
  if (!course.empty()) identity.texts.push_back({kCourse, course});
  identity.start = start_of(options, 1, alone);
  return identity;
}

AnalysedTexts analysed_texts(const StudyResults& results) {
  AnalysedTexts texts{text_of(results, kResolvedModel), text_of(results, kCourse)};
  if (texts.model.empty()) throw_without_input();
  return texts;
}

ResolvedTexts resolved_texts(const StudyResults& results) {
  ResolvedTexts texts{text_of(results, kResolvedStudy),
                      text_of(results, kResolvedModel),
                      text_of(results, kResolvedReference),
                      {}};
  for (std::size_t i = 0; const std::string* data = find_text(results, data_name(i)); ++i) {
    texts.data.push_back({text_of(results, data_name(i) + kFileSuffix), *data});
  }
  if (texts.study.empty() || texts.model.empty()) throw_without_input();
  return texts;
}

std::string directory_of(const SessionOptions& options, const StudyInput& input) {
  if (options.output) return *options.output;
  const bool has_name = input.name != "unnamed";
  const std::string name =
      has_name ? input.name : std::filesystem::path(input.file).stem().string();
  return "results/" + slug_of(name);
}

}  // namespace linkstudy
