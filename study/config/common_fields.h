// Keys that several tables of a study have.
#pragma once

#include "study/config/fields.h"
#include "study/config/study_checks.h"

namespace linkstudy {

// Of a record with a member `window`.
template <class Record>
void add_window(Fields<Record>& record, const char* meaning, const char* group = "") {
  record.read("window",
              {.type = KeyType::numbers,
               .meaning = meaning,
               .unit = "s",
               .range = kNotNegative,
               .counts = {2},
               .group = group},
              [](Record& to, Tree& value, const Reading& reading) {
                to.window = read_window(value, reading);
              });
}

// { log = [lowest, highest] } or { lin = ... }: their values are of the units of the model, which
// the reader of the table knows.
template <class Record>
Fields<Record> range_fields(const char* log_meaning, const char* lin_meaning) {
  Fields<Record> range;
  const auto add = [&](const char* key, const char* meaning) {
    range.read(key,
               {.type = KeyType::scalars, .meaning = meaning, .required = true, .group = "range"});
    range.back().counts.push_back(2);
  };
  add("log", log_meaning);
  add("lin", lin_meaning);
  return range;
}

}  // namespace linkstudy
