// Keys of what is compared with measurements, in experiments and as a reference.
#pragma once

#include "study/config/fields.h"
#include "study/config/study_input.h"

namespace linkstudy {

void add_file(Fields<MeasuredInput>& measured, KeyRow row);

// results, evaluation and load_case.
void add_results(Fields<MeasuredInput>& measured, KeyRow row);

// Path of a channel = head.
void add_columns(Fields<MeasuredInput>& measured, const char* meaning);

void add_time_offset(Fields<MeasuredInput>& measured, KeyRow row, bool can_be_fitted);

// file or results, columns and time_offset in place of a run.
void add_reference_data(Fields<ReferenceInput>& reference);

}  // namespace linkstudy
