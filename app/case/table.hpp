/// One table of a case file, read strictly: every key is declared by asking for it, and finish() complains
/// about the rest.
#pragma once

#include "app/case/document.hpp"
#include "core/tensor.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tessera::app {

/// What a number must fulfil, with the words that say so.
struct Range {
  bool (*holds)(double);
  const char* rule;
};
inline constexpr Range any_number{[](double) { return true; }, ""};
inline constexpr Range positive{[](double x) { return x > 0; }, "greater than 0"};
inline constexpr Range not_negative{[](double x) { return x >= 0; }, "0 or more"};
inline constexpr Range not_positive{[](double x) { return x <= 0; }, "0 or less"};
inline constexpr Range zero_to_one{[](double x) { return x >= 0 && x <= 1; }, "between 0 and 1"};

/// Getters named like their type want the key; `..._or` and `optional_...` do not. A value of the wrong type
/// or out of range throws at once; a missing key waits for finish(), so that a misspelt one is reported as
/// what it is. What a getter returns for a missing key is a stand-in that must not be judged before finish().
class Table {
 public:
  explicit Table(const Document& document);

  double number(const std::string& key, Range range = any_number);
  double number_or(const std::string& key, double otherwise, Range range = any_number);
  std::optional<double> optional_number(const std::string& key, Range range = any_number);
  std::int64_t integer_or(const std::string& key, std::int64_t otherwise, std::int64_t lowest,
                          std::int64_t highest);
  bool boolean_or(const std::string& key, bool otherwise);

  std::string text(const std::string& key);
  std::string text_or(const std::string& key, const std::string& otherwise);
  std::string choice(const std::string& key, const std::vector<std::string>& allowed);
  std::string choice_or(const std::string& key, const std::string& otherwise,
                        const std::vector<std::string>& allowed);
  /// A non-empty list of distinct words out of `allowed`.
  std::vector<std::string> choices(const std::string& key, const std::vector<std::string>& allowed);
  /// A name that files and columns can carry: letters, digits, '_', '-', '.' and at most 64 of them.
  std::string name(const std::string& key);

  Vec3 vector(const std::string& key);
  std::optional<Vec3> optional_vector(const std::string& key);
  /// A list of that many numbers.
  std::vector<double> numbers(const std::string& key, int count, Range range = any_number);
  /// A list of one or more numbers.
  std::vector<double> number_list(const std::string& key);
  /// A list of two or more pairs of numbers.
  std::vector<Vec<2>> points(const std::string& key);
  /// A formula: a string or a number.
  std::string formula(const std::string& key);
  /// Three of them.
  std::array<std::string, 3> formulas(const std::string& key);
  std::optional<std::array<std::string, 3>> optional_formulas(const std::string& key);
  /// A number or a word.
  std::string number_or_word(const std::string& key, const std::string& otherwise);

  Table table(const std::string& key);
  std::optional<Table> optional_table(const std::string& key);
  /// [[key]]: none, one or many.
  std::vector<Table> tables(const std::string& key);

  /// A plain value as TOML writes it, and as people read it.
  struct Literal {
    std::string toml, plain;
  };
  /// A list of one or more values none of which is a table; one that stands alone counts as a list.
  std::vector<Literal> literals(const std::string& key);
  /// What the table holds beside the keys asked for so far, as assignments "key.key=value": what a Document
  /// takes as overrides. finish() then has nothing more to complain about.
  std::vector<std::string> assignments();
  /// The names of all keys.
  std::vector<std::string> keys() const;

  /// A key somebody else may ask for: finish() lets it pass.
  void allow(const std::string& key) { declared_.push_back(key); }

  /// InputError on a key nobody asked for (with the nearest one and the list), then on a wanted one that is
  /// missing.
  void finish() const;

  /// InputError about one of this table's keys (or, where it is absent, the table).
  [[noreturn]] void refuse(const std::string& key, const std::string& what, const std::string& remedy) const;
  bool has(const std::string& key) const;
  bool is_text(const std::string& key) const;
  bool is_table(const std::string& key) const;
  bool is_list(const std::string& key) const;
  bool is_overridden(const std::string& key) const { return document_->is_overridden(path_of(key)); }
  const std::string& path() const { return path_; }
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  /// file:line:column of a key, or the argument that sets it.
  std::string place_of(const std::string& key) const { return document_->where(path_of(key)); }
  std::string where() const { return document_->where(path_); }

 private:
  Table(const Document& document, const toml::table* table, std::string path);
  const toml::node* declare(const std::string& key);
  const toml::node* declare_wanted(const std::string& key);
  [[noreturn]] void wrong_type(const std::string& key, const toml::node& node, const char* wanted) const;
  double number_in(const std::string& key, const toml::node& node, Range range) const;
  std::string formula_in(const std::string& key, const toml::node& node) const;
  std::array<std::string, 3> formulas_in(const std::string& key, const toml::node& node) const;
  std::string text_in(const std::string& key, const toml::node& node) const;
  std::string one_of(const std::string& key, const std::string& word,
                     const std::vector<std::string>& allowed) const;
  Vec3 vector_in(const std::string& key, const toml::node& node) const;

  const Document* document_;
  const toml::table* table_; ///< null for a wanted table that is missing: its parent's finish() reports it
  std::string path_;
  std::vector<std::string> declared_, missing_;
};

} // namespace tessera::app
