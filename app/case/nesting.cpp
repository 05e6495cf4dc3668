#include "app/case/nesting.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <cctype>

namespace tessera::app {
namespace {

constexpr int deepest = 16;

/// Walks the text once, stepping over strings and comments.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& origin) : text_(text), origin_(origin) {}

  void scan() {
    int brackets = 0, dots = 0;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        skip_string(c);
        continue;
      }
      if (c == '#') {
        while (at_ < text_.size() && text_[at_] != '\n')
          ++at_;
        continue;
      }
      if (c == '[' || c == '{')
        ++brackets;
      if (c == ']' || c == '}')
        --brackets;
      if (c == '.')
        ++dots;
      else if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-' && c != ' ' && c != '\t')
        dots = 0;
      if (brackets > deepest)
        refuse("brackets nest");
      if (dots >= deepest)
        refuse("a key has parts");
      advance();
    }
  }

 private:
  void advance() {
    if (text_[at_] == '\n') {
      ++line_;
      line_start_ = at_ + 1;
    }
    ++at_;
  }

  void skip_string(char quote) {
    const std::string_view triple = quote == '"' ? R"(""")" : "'''";
    const bool multiline = text_.substr(at_, 3) == triple;
    for (int i = 0; i < (multiline ? 3 : 1); ++i)
      advance();
    while (at_ < text_.size()) {
      if (multiline ? text_.substr(at_, 3) == triple : text_[at_] == quote) {
        for (int i = 0; i < (multiline ? 3 : 1); ++i)
          advance();
        return;
      }
      if (!multiline && text_[at_] == '\n')
        return; // unterminated: the parser's business
      if (quote == '"' && text_[at_] == '\\' && at_ + 1 < text_.size())
        advance();
      advance();
    }
  }

  [[noreturn]] void refuse(const char* what) const {
    throw InputError(fmt::format("{} more than {} deep", what, deepest),
                     fmt::format("{}:{}:{}", origin_, line_, at_ - line_start_ + 1),
                     "no key of a case lies deeper than four");
  }

  std::string_view text_;
  const std::string& origin_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
};

} // namespace

void refuse_deep_nesting(std::string_view text, const std::string& origin) {
  Scanner(text, origin).scan();
}

} // namespace tessera::app
