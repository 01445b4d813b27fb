// What an input file describes: one kind, one set of keys, and (but for a model) one verb of its
// name.
#pragma once

#include "core/base/words.h"

namespace linkstudy {

enum class FileKind { model, study, tune, calibrate, converge };

template <>
inline constexpr auto kWords<FileKind> = make_words<FileKind>(
    {{FileKind::model, "model", "one mechanism"},
     {FileKind::study, "study", "a parameter study of a model"},
     {FileKind::tune, "tune", "the lowest value that matches a reference"},
     {FileKind::calibrate, "calibrate", "the values with which the model fits measured data best"},
     {FileKind::converge, "converge", "how results change with refinement"}});

// Whether its evaluations are a design, known before the first runs.
constexpr bool has_design(FileKind kind) {
  return kind == FileKind::study || kind == FileKind::converge;
}

}  // namespace linkstudy
