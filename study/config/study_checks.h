// Values of a study that are read by more than their row, and what its tables say together.
#pragma once

#include "study/config/study_input.h"

namespace linkstudy {

// Nothing when it was reported.
std::optional<TimeWindow> read_window(Tree& value, const Reading& reading);

// "-closure.S.force": a channel and its sign.
void read_reference_signal(MatchInput& match, Tree& value, const Reading& reading);

// Where an extreme is wanted: true, false, or a channel.
void read_place(ResponseInput& response, Tree& value, const Reading& reading);

// Extremes alone are reached somewhere.
void check_place(const ResponseInput& response, Tree& table, const Reading& reading);

// One entry of the study's list for each signal of a [[trace]].
void read_trace(StudyInput& study, Tree& value, const Reading& reading);

// A count, or a share of all.
void read_failure_limit(RunOptions& run, Tree& value, const Reading& reading);

// Names once each, a reference where something is compared.
void check_study(const Tree& study, FileKind kind, Diagnostics& diagnostics);

}  // namespace linkstudy
