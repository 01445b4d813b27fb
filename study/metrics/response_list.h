// The names, units and meanings of everything an evaluation answers, in the order of
// RunMetrics::reduce: per load case the errors of every [[match]], the root mean square of the
// residuals of a calibration, every [[response]], and what is always kept. With load cases their
// names stand in front ("fast_error_max_closure_S_force_x").
#pragma once

#include <string>
#include <vector>

#include "study/metrics/study_signals.h"

namespace linkstudy {

// What is always kept of a run, in this order.
enum class RunNumber {
  gap_max,
  drift_max,
  energy_residual_max,
  omega_max,
  step_limit,
  h_omega_max,
  steps,
  end_time,
  contacts,
  least_contact_steps
};
inline constexpr std::size_t kRunNumbers = 10;

// Numbers that a [[response]] keeps of each of its channels: the value; where it asks for it, when
// it is reached, and what another channel has there. First all values, then all instants.
std::size_t numbers_of_each(const ResponseInput& response);

// Of a channel of a [[response]], without the load case: "peak.x" as "peak_x".
std::string response_name(const ResponseInput& response, const Channel& channel);

std::vector<Response> list_responses(const StudyInput& input, const StudySignals& signals);

// Names of [[response]] that are taken: by another response, by an error, by what is always kept,
// by a parameter (dots written as _ or not), by a column of its own. Reported at the names.
void check_response_names(const StudyInput& input, const StudySignals& signals,
                          const std::vector<Parameter>& parameters, Diagnostics& diagnostics);

// Load cases of a study; one without a name when there are none.
std::vector<LoadCaseInput> load_cases_of(const StudyInput& input);

// Where the numbers of a load case are in the list.
struct ResponseLayout {
  std::size_t width = 0;           // numbers of a load case
  std::vector<std::size_t> match;  // first number of every match: n max, then n rms
  std::size_t always = 0;          // first of the RunNumbers
  std::size_t index_of(RunNumber number) const { return always + static_cast<std::size_t>(number); }
};
ResponseLayout layout_of(const StudyInput& input, const StudySignals& signals);

// The list of responses, read back from its names and meanings alone: what tables of stored results
// have to go by.
struct StoredErrors {
  std::string name;                   // "closure_S_force", as in the names of its errors
  std::vector<std::string> channels;  // "closure.S.force.x"
  std::size_t max = 0, rms = 0;       // where its errors of either norm begin in the list
};
struct StoredCase {
  std::string load_case;  // empty without load cases
  std::vector<StoredErrors> matches;
  std::vector<std::size_t> responses;  // of [[response]]
  std::size_t always = 0;              // first of the RunNumbers
};
std::vector<StoredCase> split_responses(const std::vector<Response>& responses);

// Of all channels of all matches, by the norm max.
std::vector<std::size_t> error_columns(const StoredCase& stored);

// The part that a list of channels has in common: "closure.S.force".
std::string group_of(const std::vector<std::string>& channels);

}  // namespace linkstudy
