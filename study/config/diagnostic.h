// What a user can mend in an input: where, what is wrong, and the remedy, printed like a compiler's
//   FILE:LINE:COLUMN: error: MESSAGE
//       REMEDY
// and remarks (warning, note), with which the program goes on.
// Lines and columns count from 1, columns in code points. Line 0: the whole file, or a --set text.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace linkstudy {

struct Location {
  std::shared_ptr<const std::string> file;  // shared by all values of one file
  int line = 0;
  int column = 0;
};

Location make_location(std::string file, int line = 0, int column = 0);

enum class Severity { error, warning, note };

struct Diagnostic {
  std::string file;
  int line = 0;
  int column = 0;
  std::string message;
  std::string remedy;
  Severity severity = Severity::error;
};

std::string to_string(const Diagnostic& diagnostic);

// Collects the problems of one pass.
class Diagnostics {
 public:
  void add(const Location& at, std::string message, std::string remedy);
  void add(const Diagnostic& diagnostic);
  void remark(Severity severity, const Location& at, std::string message, std::string remedy);
  void append(const Diagnostics& other);
  // Of errors alone.
  bool empty() const { return entries_.empty(); }
  std::size_t size() const { return entries_.size(); }
  // By order of the files' first appearance, then by line and column; exact repetitions once.
  std::vector<Diagnostic> sorted() const;
  std::vector<Diagnostic> sorted_remarks() const;

 private:
  std::vector<Diagnostic> entries_;
  std::vector<Diagnostic> remarks_;
};

// All of them, one after the other, ending in a newline; empty when there is none.
std::string to_string(const Diagnostics& diagnostics);

}  // namespace linkstudy
