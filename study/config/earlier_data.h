// Histories of earlier results as measured data. What is taken of them becomes the text of a CSV
// file with SI units and all digits: from there on results and files are one.
#pragma once

#include "study/config/measured_input.h"

namespace linkstudy {

// What is asked of the results, as written: signals, or heads of columns.
std::vector<std::string> earlier_heads(const MeasuredInput& measured);

// The time and what is asked for. Signals and heads that the run does not have are reported at
// their places; `source` names it in messages.
std::optional<std::string> write_earlier_data(const EarlierRun& run, const std::string& source,
                                              const MeasuredInput& measured,
                                              Diagnostics& diagnostics);

// Of such a text. Nothing when anything was reported.
std::shared_ptr<const MeasuredData> parse_earlier_data(const std::string& text,
                                                       const std::string& source,
                                                       const MeasuredInput& measured,
                                                       Diagnostics& diagnostics);

}  // namespace linkstudy
