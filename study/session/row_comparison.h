// The rows of earlier results beside what another input asks for: which of them are rows of it too
// (evaluate/case_key.h), and why not.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "study/evaluate/case_key.h"
#include "study/store/results.h"

namespace linkstudy {

// Earlier results with the evaluator of their own input. Throws as make_stored_evaluator.
struct EarlierStudy {
  explicit EarlierStudy(StudyResults stored);

  StudyResults results;
  std::unique_ptr<Evaluator> evaluator;
  CaseKeys keys;
};

struct RowComparison {
  // Why rows of the earlier results are none of the new input, with the first of them; empty: all
  // have their place in its design, or in the ranges of its search.
  std::string lost;
  std::size_t kept = 0;        // rows that have one
  bool asks_the_same = false;  // the inputs differ in values of models alone
  bool is_in_place = false;    // of a design: all keep their ids and values
  CapChange caps = CapChange::none;
  std::vector<std::uint64_t> ended_by_caps;  // rows that wider limits may let go on
};

RowComparison compare_rows(const EarlierStudy& before, const Evaluator& now);

}  // namespace linkstudy
