#include "preprocess/geometry/iges_file.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <vector>

namespace tessera::preprocess {
namespace {

constexpr std::size_t letter_column = 72; // of the section, counted from 0; data fill the columns before it

/// Letter of the section a line belongs to; 0 when it is too short to have one.
char section_of(std::string_view line) {
  return line.size() > letter_column ? line[letter_column] : '\0';
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r'))
      line.remove_suffix(1);
    if (line.find_first_not_of(" \t") != std::string_view::npos)
      lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// Parameters of the global section. Its first two are the delimiters of parameters and records, "," and ";"
/// unless they say otherwise; texts are counted ("2HMM").
std::vector<std::string> global_parameters(std::string_view text) {
  std::string section;
  for (const std::string_view line : lines_of(text))
    if (section_of(line) == 'G')
      section += line.substr(0, letter_column);
  char comma = ',', semicolon = ';';
  std::vector<std::string> parameters;
  std::string word;
  for (std::size_t at = 0; at < section.size(); ++at) {
    const char c = section[at];
    std::size_t count = 0;
    if (c == 'H' && !word.empty() &&
        std::from_chars(word.data(), word.data() + word.size(), count).ptr == word.data() + word.size()) {
      word = section.substr(at + 1, count);
      at = std::min(at + count, section.size());
      if (parameters.size() == 0 && word.size() == 1)
        comma = word[0];
      if (parameters.size() == 1 && word.size() == 1)
        semicolon = word[0];
    } else if (c == comma || c == semicolon) {
      parameters.push_back(std::move(word));
      word.clear();
      if (c == semicolon)
        break;
    } else if (c != ' ') {
      word += c;
    }
  }
  return parameters;
}

} // namespace

void check_iges(std::string_view text, const std::string& origin) {
  const auto lines = lines_of(text);
  require(!lines.empty() && section_of(lines.front()) == 'S',
          "the file is not an IGES file in text form although it is called one", origin,
          "export it again as plain IGES (not compressed or binary) or as STEP");
  require(section_of(lines.back()) == 'T', "the IGES file is cut off: its terminate section is missing",
          origin, "export or copy it again");
}

std::string iges_length_unit(std::string_view text) {
  const auto parameters = global_parameters(text);
  constexpr std::size_t flag_place = 13, name_place = 14;
  if (parameters.size() <= flag_place)
    return {};
  static const std::map<std::string, std::string> by_flag{{"1", "in"}, {"2", "mm"}, {"4", "ft"},
                                                          {"6", "m"},  {"9", "um"}, {"10", "cm"}};
  static const std::map<std::string, std::string> by_name{
      {"IN", "in"}, {"INCH", "in"}, {"MM", "mm"}, {"FT", "ft"}, {"M", "m"}, {"UM", "um"}, {"CM", "cm"}};
  const std::string& flag = parameters[flag_place];
  const bool named = flag == "3" && parameters.size() > name_place;
  const auto& names = named ? by_name : by_flag;
  const auto it = names.find(named ? parameters[name_place] : flag);
  return it == names.end() ? std::string{} : it->second;
}

} // namespace tessera::preprocess
