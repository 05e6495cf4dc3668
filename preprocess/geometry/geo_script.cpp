#include "preprocess/geometry/geo_script.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

namespace tessera::preprocess {
namespace {

/// Lower case: gmsh tells case apart, so a different case is no danger, but neither is it a loss.
const std::set<std::string, std::less<>> forbidden{"systemcall",
                                                   "system",
                                                   "nonblockingsystemcall",
                                                   "onelabrun",
                                                   "onelabaction",
                                                   "plugin",
                                                   "externalprocess",
                                                   "solver",
                                                   "include",
                                                   "merge",
                                                   "mergewithboundingbox",
                                                   "open",
                                                   "save",
                                                   "print",
                                                   "write",
                                                   "createdir",
                                                   "shapefromfile",
                                                   "listfromfile",
                                                   "getenv",
                                                   "stringtoname",
                                                   "s2n",
                                                   "setstring",
                                                   "setnumber",
                                                   "sendtoserver",
                                                   "parsestring",
                                                   "generateevent",
                                                   "adaptmesh",
                                                   "copyoptions",
                                                   "alias",
                                                   "aliaswithoptions",
                                                   "combine"};

/// Words of geometry that may stand before another word or a text.
const std::set<std::string, std::less<>> plain{
    "physical",      "line",           "curve",      "plane",       "ruled",
    "surface",       "volume",         "point",      "transfinite", "compound",
    "recombine",     "using",          "in",         "for",         "mesh",
    "background",    "delete",         "recursive",  "coherence",   "characteristic",
    "periodic",      "setname",        "bspline",    "bezier",      "wire",
    "reverse",       "smoother",       "hide",       "show",        "macro",
    "function",      "call",           "else",       "endif",       "endfor",
    "return",        "struct",         "alternated", "left",        "right",
    "alternateleft", "alternateright", "parent",     "affine",      "elliptic",
    "color",         "circle",         "ellipse",    "spline",      "layers",
    "knots",         "order",          "attractor",  "name",        "help",
    "label",         "units",          "kind",       "highlight"}; // the last line: attributes of
                                                                   // DefineConstant

struct Token {
  enum class Kind { word, number, text, symbol, bad, end };
  Kind kind = Kind::end;
  std::string value;
  int line = 0;
};

/// Cuts the script as gmsh's own scanner does: longest numbers first, so that "1e5System" is a number and a
/// word.
class Scanner {
 public:
  explicit Scanner(std::string_view script) : script_(script) {}

  Token next() {
    for (;;) {
      if (at_ >= script_.size())
        return token(Token::Kind::end, at_);
      const char c = script_[at_];
      if (c == '\n')
        ++line_;
      if (std::isspace(static_cast<unsigned char>(c))) {
        ++at_;
      } else if (starts("//")) {
        at_ = std::min(script_.find('\n', at_), script_.size());
      } else if (starts("/*")) {
        const std::size_t end = script_.find("*/", at_ + 2);
        if (end == std::string_view::npos)
          return bad("a comment that is not closed");
        line_ += static_cast<int>(std::count(script_.begin() + static_cast<long>(at_),
                                             script_.begin() + static_cast<long>(end), '\n'));
        at_ = end + 2;
      } else {
        break;
      }
    }
    const std::size_t start = at_;
    const char c = script_[at_];
    if (c == '\0')
      return bad("a zero byte");
    if (c == '"' || c == '\'')
      return text(c);
    if (digit(at_) || (c == '.' && digit(at_ + 1))) {
      skip_number();
      return token(Token::Kind::number, start);
    }
    if (letter(at_)) {
      while (letter(at_) || digit(at_))
        ++at_;
      return token(Token::Kind::word, start);
    }
    ++at_;
    return token(Token::Kind::symbol, start);
  }

 private:
  bool starts(std::string_view head) const { return script_.substr(at_, head.size()) == head; }
  bool digit(std::size_t i) const { return i < script_.size() && script_[i] >= '0' && script_[i] <= '9'; }
  bool letter(std::size_t i) const {
    return i < script_.size() && (std::isalpha(static_cast<unsigned char>(script_[i])) || script_[i] == '_');
  }
  void skip_number() {
    while (digit(at_))
      ++at_;
    if (at_ < script_.size() && script_[at_] == '.')
      ++at_;
    while (digit(at_))
      ++at_;
    std::size_t exponent = at_;
    if (exponent < script_.size() && (script_[exponent] == 'e' || script_[exponent] == 'E')) {
      ++exponent;
      if (exponent < script_.size() && (script_[exponent] == '+' || script_[exponent] == '-'))
        ++exponent;
      if (digit(exponent)) {
        at_ = exponent;
        while (digit(at_))
          ++at_;
      }
    }
  }
  Token text(char quote) {
    const std::size_t end = script_.find(quote, at_ + 1);
    if (end == std::string_view::npos)
      return bad("a text that is not closed");
    const std::string_view inside = script_.substr(at_ + 1, end - at_ - 1);
    if (inside.size() > 1000)
      return bad("a text of more than 1000 characters");
    if (inside.find('\0') != std::string_view::npos)
      return bad("a zero byte");
    Token result{Token::Kind::text, std::string(inside), line_};
    line_ += static_cast<int>(std::count(inside.begin(), inside.end(), '\n'));
    at_ = end + 1;
    return result;
  }
  Token token(Token::Kind kind, std::size_t start) const {
    return {kind, std::string(script_.substr(start, at_ - start)), line_};
  }
  Token bad(const char* why) const { return {Token::Kind::bad, why, line_}; }

  std::string_view script_;
  std::size_t at_ = 0;
  int line_ = 1;
};

std::string lower(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word;
}

} // namespace

GeoFinding forbidden_in_geo(std::string_view script) {
  if (script.find('\0') != std::string_view::npos)
    return {"a zero byte", 1};
  Scanner scanner(script);
  Token before;
  bool named = false;    // `before` is the name of a macro: a new statement follows
  bool printing = false; // inside a Printf statement
  for (Token token = scanner.next(); token.kind != Token::Kind::end; before = token, token = scanner.next()) {
    if (token.kind == Token::Kind::bad)
      return {token.value, token.line};
    const std::string word = token.kind == Token::Kind::word ? lower(token.value) : std::string{};
    if (forbidden.contains(word))
      return {token.value, token.line};
    const bool operand = token.kind == Token::Kind::word || token.kind == Token::Kind::text;
    const std::string previous = before.kind == Token::Kind::word ? lower(before.value) : std::string{};
    if (operand && !previous.empty() && !named && word != "in" && !plain.contains(previous))
      return {before.value + " (an unknown command)", before.line};
    named = previous == "macro" || previous == "function" || previous == "call";
    if (word == "printf" || word == "error" || word == "warning")
      printing = true;
    if (token.value == ";" && token.kind == Token::Kind::symbol)
      printing = false;
    if (printing && token.value == ">" && token.kind == Token::Kind::symbol)
      return {"Printf into a file", token.line};
  }
  return {};
}

} // namespace tessera::preprocess
