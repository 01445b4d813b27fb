#include "wrong_text.h"

#include <gmock/gmock.h>

#include <ostream>
#include <stdexcept>

#include "config_text.h"

namespace linkstudy::test {
namespace {

using testing::HasSubstr;

struct Marked {
  std::string text;
  int line = 1;
  int column = 1;
};

Marked without_mark(const std::string& text) {
  const std::size_t at = text.find('@');
  if (at == std::string::npos || text.find('@', at + 1) != std::string::npos) {
    throw std::logic_error("test text: one mark is needed: " + text);
  }
  Marked marked{text, 1, 1};
  for (std::size_t i = 0; i < at; ++i) {
    marked.column = text[i] == '\n' ? 1 : marked.column + 1;
    marked.line += text[i] == '\n' ? 1 : 0;
  }
  marked.text.erase(at, 1);
  return marked;
}

}  // namespace

void PrintTo(const Wrong& wrong, std::ostream* out) {
  *out << wrong.what;
}

void expect_one_error(const std::string& right, const Wrong& wrong) {
  const Marked marked = without_mark(replaced(right, wrong.from, wrong.to));
  Diagnostics diagnostics;
  EXPECT_FALSE(read_text(marked.text, diagnostics));
  const std::vector<Diagnostic> found = diagnostics.sorted();
  ASSERT_EQ(found.size(), 1u) << to_string(diagnostics);
  EXPECT_EQ(found[0].line, marked.line) << to_string(diagnostics);
  EXPECT_EQ(found[0].column, marked.column) << to_string(diagnostics);
  EXPECT_THAT(found[0].message, HasSubstr(wrong.message));
  EXPECT_THAT(found[0].remedy, HasSubstr(wrong.remedy));
  EXPECT_FALSE(found[0].remedy.empty());
  EXPECT_EQ(found[0].file, "model.toml");
}

void expect_one_message(const std::string& right, const WrongFile& wrong, const ReadsText& reads) {
  Diagnostics diagnostics;
  EXPECT_FALSE(reads(replaced(right, wrong.before, wrong.after), diagnostics));
  EXPECT_EQ(1u, diagnostics.size()) << to_string(diagnostics);
  EXPECT_THAT(to_string(diagnostics), HasSubstr(wrong.message));
}

}  // namespace linkstudy::test
