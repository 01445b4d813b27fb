#include "study/config/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace linkstudy {
namespace {

const char* word_of(Severity severity) {
  if (severity == Severity::error) return "error";
  return severity == Severity::warning ? "warning" : "note";
}

std::vector<Diagnostic> in_order(const std::vector<Diagnostic>& entries) {
  std::vector<std::string> files;
  const auto rank_of = [&](const std::string& file) {
    return std::find(files.begin(), files.end(), file) - files.begin();
  };
  for (const Diagnostic& d : entries) {
    if (rank_of(d.file) == static_cast<std::ptrdiff_t>(files.size())) files.push_back(d.file);
  }
  const auto key = [&](const Diagnostic& d) {
    return std::make_tuple(rank_of(d.file), d.line, d.column);
  };
  std::vector<Diagnostic> result;
  for (const Diagnostic& d : entries) {
    const bool repeated = std::any_of(result.begin(), result.end(), [&](const Diagnostic& other) {
      return key(other) == key(d) && other.message == d.message;
    });
    if (!repeated) result.push_back(d);
  }
  std::stable_sort(result.begin(), result.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
  return result;
}

}  // namespace

Location make_location(std::string file, int line, int column) {
  return {std::make_shared<const std::string>(std::move(file)), line, column};
}

std::string to_string(const Diagnostic& d) {
  const std::string at = d.line > 0 ? fmt::format(":{}:{}", d.line, d.column) : std::string();
  std::string text = fmt::format("{}{}: {}: {}", d.file, at, word_of(d.severity), d.message);
  if (!d.remedy.empty()) text += "\n    " + d.remedy;
  return text;
}

void Diagnostics::add(const Location& at, std::string message, std::string remedy) {
  add({at.file ? *at.file : std::string(), at.line, at.column, std::move(message),
       std::move(remedy), Severity::error});
}

void Diagnostics::add(const Diagnostic& diagnostic) {
  entries_.push_back(diagnostic);
}

void Diagnostics::remark(Severity severity, const Location& at, std::string message,
                         std::string remedy) {
  remarks_.push_back({at.file ? *at.file : std::string(), at.line, at.column, std::move(message),
                      std::move(remedy), severity});
}

void Diagnostics::append(const Diagnostics& other) {
  entries_.insert(entries_.end(), other.entries_.begin(), other.entries_.end());
  remarks_.insert(remarks_.end(), other.remarks_.begin(), other.remarks_.end());
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  return in_order(entries_);
}

std::vector<Diagnostic> Diagnostics::sorted_remarks() const {
  return in_order(remarks_);
}

std::string to_string(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics.sorted()) text += to_string(d) + "\n";
  return text;
}

}  // namespace linkstudy
