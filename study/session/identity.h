// What makes a study the same study when it is started again, and what its results say about where
// they come from.
#pragma once

#include "study/evaluate/evaluator.h"
#include "study/schedule/transport.h"
#include "study/session/options.h"
#include "study/session/study_record.h"

namespace linkstudy {

// The digest covers the resolved study, the models it names as far as they are written, and the
// seed; not how long it may run or how many failures are accepted.
StudyIdentity make_identity(const SessionOptions& options, const Evaluator& evaluator,
                            std::uint64_t total, const Transport& transport);

// The same of an analysis of one model; `verb` is its kind, `course` what else it was asked (empty:
// nothing). One evaluation is all of it.
StudyIdentity make_model_identity(const SessionOptions& options, const std::string& verb,
                                  const ModelDocument& document, const ModelInput& input,
                                  const std::string& course, std::vector<Response> responses);

// The model, with what --set changed, and the course that an analysis was asked for.
struct AnalysedTexts {
  std::string model;
  std::string course;
};
// Throws StoreError where they are missing.
AnalysedTexts analysed_texts(const StudyResults& results);

// What make_identity keeps of the resolved input. Throws StoreError where older results have none.
ResolvedTexts resolved_texts(const StudyResults& results);

// -o, or results/<name of the study> under the current directory.
std::string directory_of(const SessionOptions& options, const StudyInput& input);

}  // namespace linkstudy
