#include "study/config/toml_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/record/utf8.h"

namespace linkstudy {
namespace {

// Follows a text byte by byte: what of it is string or comment, and how deep the rest is.
class DepthScan {
 public:
  explicit DepthScan(std::string_view text) : text_(text) {}

  // Takes the byte at `i`; false where a key or a value is too deep.
  bool take(std::size_t i) {
    if (i < resume_) return true;  // taken with the quotes before it
    const char c = text_[i];
    if (c == '\n' && !is_long_) quote_ = 0;
    if (quote_ == '#') return true;
    if (quote_ != 0) {
      take_quoted(i);
      return true;
    }
    switch (c) {
      case '#':
        quote_ = c;
        return true;
      case '"':
      case '\'':
        open(i);
        return true;
      case '.':
        return ++names_ < kDeepestKey;
      case '[':
      case '{':
        names_ = 0;
        return ++brackets_ <= kDeepestValue;
      case ']':
      case '}':
        brackets_ = std::max(0, brackets_ - 1);
        names_ = 0;
        return true;
      case '\n':
      case '=':
      case ',':
        names_ = 0;
        return true;
      default:
        return true;
    }
  }

 private:
  std::size_t quotes_at(std::size_t i, std::size_t most) const {
    std::size_t count = 0;
    while (count < most && i + count < text_.size() && text_[i + count] == quote_) ++count;
    return count;
  }

  void open(std::size_t i) {
    quote_ = text_[i];
    const std::size_t count = quotes_at(i, 3);
    is_long_ = count == 3;
    if (count == 2) quote_ = 0;  // an empty string
    resume_ = i + count;
  }

  void take_quoted(std::size_t i) {
    if (text_[i] == '\\' && quote_ == '"') {
      resume_ = i + 2;
    } else if (text_[i] == quote_ && (!is_long_ || quotes_at(i, 3) == 3)) {
      // Two more quotes before the end of a long string belong to it.
      resume_ = i + (is_long_ ? quotes_at(i, 5) : 1);
      quote_ = 0;
      is_long_ = false;
    }
  }

  std::string_view text_;
  std::size_t resume_ = 0;
  char quote_ = 0;  // of the string we are in, # in a comment
  bool is_long_ = false;
  int names_ = 0;
  int brackets_ = 0;
};

}  // namespace

bool check_toml_text(std::string_view text, const std::shared_ptr<const std::string>& file,
                     Diagnostics& diagnostics) {
  DepthScan scan(text);
  int line = 1, column = 1;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    if (length == 0) {
      diagnostics.add({file, line, column},
                      fmt::format("the file is not UTF-8 text, got byte 0x{:02X}",
                                  static_cast<unsigned char>(text[i])),
                      "save it as UTF-8; results and archives are not inputs");
      return false;
    }
    if (!scan.take(i)) {
      diagnostics.add({file, line, column},
                      text[i] == '.'
                          ? fmt::format("a key has more than {} names", kDeepestKey)
                          : fmt::format("values are nested more than {} deep", kDeepestValue),
                      "keys and values of inputs are a few levels deep; see configs/README.md");
      return false;
    }
    column = text[i] == '\n' ? 1 : column + 1;
    line += text[i] == '\n' ? 1 : 0;
    i += length;
  }
  return true;
}

}  // namespace linkstudy
