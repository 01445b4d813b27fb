#include "study/metrics/response_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "study/record/column_names.h"

namespace linkstudy {
namespace {

struct RunNumberText {
  const char* name;
  const char* unit;
  const char* meaning;
};

constexpr std::array<RunNumberText, kRunNumbers> kTexts = {{
    {"gap_max", "m", "largest distance between the two points of a closure"},
    {"drift_max", "", "largest norm of the cut-joint residuals, m and 1"},
    {"energy_residual_max", "J", "largest residual of the energy ledger"},
    {"omega_max", "rad/s", "highest eigenfrequency along the run"},
    {"step_limit", "s", "largest stable step of RK4, the least along the run"},
    {"h_omega_max", "", "step times highest eigenfrequency"},
    {"steps", "", "accepted steps"},
    {"end_time", "s", "time reached"},
    {"contacts", "", "contacts begun, of journals with bearings and of joints with end stops"},
    {"least_contact_steps", "", "steps in the shortest contact that ended, 0: none; rk4 needs 20"},
}};

constexpr std::string_view kMaxMeaning = "largest relative error of ";
constexpr std::string_view kRmsMeaning = "root-mean-square relative error of ";

std::string to_name(std::string text) {
  std::ranges::replace(text, '.', '_');
  return text;
}

// The part of a channel's name that its group does not have: "x" of "closure.S.force.x".
std::string component_of(const std::string& channel, const std::string& group) {
  return channel.size() > group.size() ? channel.substr(group.size()) : std::string();
}

bool is_calibration(const StudyInput& input) {
  return input.kind == FileKind::calibrate;
}

struct NameClash {
  std::size_t response;  // [[response]]
  std::string name;
};

class Lister {
 public:
  Lister(const StudyInput& input, const StudySignals& signals) : input_(input), signals_(signals) {}

  // A name that only the program gives.
  void reserve(const std::string& name) { owners_.emplace(name, kOurs); }

  std::vector<Response> run() {
    for (const LoadCaseInput& load_case : load_cases_of(input_)) add_case(load_case.name);
    return std::move(responses_);
  }

  const std::vector<NameClash>& clashes() const { return clashes_; }

 private:
  void add_case(const std::string& load_case) {
    prefix_ = load_case.empty() ? "" : load_case + "_";
    for (std::size_t i = 0; i < input_.match.size(); ++i) {
      add_errors("max", kMaxMeaning, i);
      add_errors("rms", kRmsMeaning, i);
    }
    owner_ = kOurs;
    if (is_calibration(input_)) {
      add("residual_rms", "", "root mean square of the weighted residuals");
    }
    for (std::size_t i = 0; i < input_.response.size(); ++i) add_response(i);
    owner_ = kOurs;
    for (const RunNumberText& text : kTexts) add(text.name, text.unit, text.meaning);
  }

  void add_errors(const char* norm, std::string_view meaning, std::size_t i) {
    owner_ = kOurs;
    for (const Channel& channel : signals_.match[i]) {
      add(fmt::format("error_{}_{}", norm, to_name(channel.name)), "1",
          fmt::format("{}{}", meaning, channel.name));
    }
  }

  void add_response(std::size_t i) {
    owner_ = static_cast<std::ptrdiff_t>(i);
    constexpr std::array kReductions = {"max", "min", "max_abs", "rms", "mean", "last"};
    const ResponseInput& response = input_.response[i];
    const auto add_each = [&](const std::string& ending, const std::string& unit,
                              const std::string& what) {
      for (const Channel& channel : signals_.response[i]) {
        add(response_name(response, channel) + ending, unit.empty() ? channel.unit : unit,
            fmt::format("{}{} of {}", what, kReductions[static_cast<std::size_t>(response.reduce)],
                        channel.name));
      }
    };
    add_each("", "", "");
    if (!response.where) return;
    add_each("_at", "s", "time of the ");
    for (const Channel& place : signals_.response_place[i]) {
      add_each("_where", place.unit, place.name + " at the ");
    }
  }

  // Two matches of one signal (other windows, say) get "_2", "_3". Another name that is taken is
  // a clash.
  void add(const std::string& name, const std::string& unit, const std::string& meaning) {
    std::string unique = prefix_ + name;
    note_clash(unique);
    for (int k = 2; owners_.contains(unique); ++k)
      unique = fmt::format("{}{}_{}", prefix_, name, k);
    owners_.emplace(unique, owner_);
    responses_.push_back({unique, unit, meaning});
  }

  void note_clash(const std::string& name) {
    const auto taken = owners_.find(name);
    if (taken == owners_.end() || (owner_ == kOurs && taken->second == kOurs)) return;
    const std::ptrdiff_t response = owner_ == kOurs ? taken->second : owner_;
    clashes_.push_back({static_cast<std::size_t>(response), name});
  }

  static constexpr std::ptrdiff_t kOurs = -1;

  const StudyInput& input_;
  const StudySignals& signals_;
  std::string prefix_;
  std::ptrdiff_t owner_ = kOurs;  // [[response]] that is being added
  std::map<std::string, std::ptrdiff_t> owners_;
  std::vector<Response> responses_;
  std::vector<NameClash> clashes_;
};

// The name of a run number behind that of the load case, empty where it is none: a [[response]] may
// end in the same words, with another meaning.
std::string_view run_number_of(const Response& response) {
  for (const RunNumberText& text : kTexts) {
    const bool is_it = response.name.ends_with(text.name) && response.long_name == text.meaning;
    if (is_it) return text.name;
  }
  return {};
}

// Reads one load case after the other.
class Splitter {
 public:
  explicit Splitter(const std::vector<Response>& responses) : responses_(responses) {}

  std::vector<StoredCase> run() {
    while (at_ < responses_.size()) {
      StoredCase one;
      while (meaning_starts(kMaxMeaning)) one.matches.push_back(read_errors());
      while (at_ < responses_.size() && run_number().empty()) one.responses.push_back(at_++);
      one.always = at_;
      if (at_ < responses_.size()) one.load_case = load_case();
      do {
        ++at_;
      } while (at_ < responses_.size() && !run_number().empty() &&
               run_number() != kTexts.front().name);
      cases_.push_back(std::move(one));
    }
    return std::move(cases_);
  }

 private:
  std::string_view run_number() const { return run_number_of(responses_[at_]); }

  bool meaning_starts(std::string_view meaning) const {
    return at_ < responses_.size() && responses_[at_].long_name.starts_with(meaning);
  }

  // "fast" of "fast_gap_max".
  std::string load_case() const {
    const std::string& name = responses_[at_].name;
    const std::size_t own = run_number().size();
    return name.size() == own ? "" : name.substr(0, name.size() - own - 1);
  }

  StoredErrors read_errors() {
    StoredErrors errors;
    errors.max = at_;
    for (; meaning_starts(kMaxMeaning); ++at_) {
      errors.channels.push_back(responses_[at_].long_name.substr(kMaxMeaning.size()));
    }
    errors.rms = at_;
    while (meaning_starts(kRmsMeaning)) ++at_;
    errors.name = group_of_names(errors);
    return errors;
  }

  // "closure_S_force", and "closure_S_force_2" of a second match of that signal.
  std::string group_of_names(const StoredErrors& errors) const {
    const std::string& first = responses_[errors.max].name;
    const std::string channel = to_name(errors.channels.front());
    const std::string group = to_name(group_of(errors.channels));
    const std::size_t found = first.rfind(channel);
    return found == std::string::npos ? group : group + first.substr(found + channel.size());
  }

  const std::vector<Response>& responses_;
  std::size_t at_ = 0;
  std::vector<StoredCase> cases_;
};

}  // namespace

std::vector<StoredCase> split_responses(const std::vector<Response>& responses) {
  return Splitter(responses).run();
}

std::vector<std::size_t> error_columns(const StoredCase& stored) {
  std::vector<std::size_t> columns;
  for (const StoredErrors& errors : stored.matches) {
    for (std::size_t c = 0; c < errors.channels.size(); ++c) columns.push_back(errors.max + c);
  }
  return columns;
}

std::string group_of(const std::vector<std::string>& channels) {
  if (channels.size() == 1) return channels.front();
  return channels.front().substr(0, channels.front().rfind('.'));
}

std::size_t numbers_of_each(const ResponseInput& response) {
  if (!response.where) return 1;
  return response.where->channel.empty() ? 2 : 3;
}

std::string response_name(const ResponseInput& response, const Channel& channel) {
  return response.name + to_name(component_of(channel.name, response.signal));
}

std::vector<Response> list_responses(const StudyInput& input, const StudySignals& signals) {
  return Lister(input, signals).run();
}

void check_response_names(const StudyInput& input, const StudySignals& signals,
                          const std::vector<Parameter>& parameters, Diagnostics& diagnostics) {
  Lister lister(input, signals);
  for (const char* column : kEvaluationColumns) lister.reserve(column);
  for (const Parameter& parameter : parameters) {
    lister.reserve(parameter.path);
    lister.reserve(to_name(parameter.path));
  }
  lister.run();
  for (const NameClash& clash : lister.clashes()) {
    const ResponseInput& response = input.response[clash.response];
    diagnostics.add(response.name_at,
                    fmt::format("response '{}' has the name of another column, '{}'", response.name,
                                clash.name),
                    "choose another name");
  }
}

std::vector<LoadCaseInput> load_cases_of(const StudyInput& input) {
  if (input.load_case.empty()) return {LoadCaseInput{}};
  return input.load_case;
}

ResponseLayout layout_of(const StudyInput& input, const StudySignals& signals) {
  ResponseLayout layout;
  for (const auto& channels : signals.match) {
    layout.match.push_back(layout.width);
    layout.width += 2 * channels.size();
  }
  if (is_calibration(input)) ++layout.width;
  for (std::size_t i = 0; i < signals.response.size(); ++i) {
    layout.width += signals.response[i].size() * numbers_of_each(input.response[i]);
  }
  layout.always = layout.width;
  layout.width += kRunNumbers;
  return layout;
}

}  // namespace linkstudy
