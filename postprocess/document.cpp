#include "postprocess/document.hpp"

#include "io/bytes.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <string_view>

namespace tessera::post {
namespace {

namespace fs = std::filesystem;

/// A relative link that survives spaces and brackets in the name.
std::string link(const std::string& file) {
  std::string out;
  for (const char c : file)
    out += std::string_view(" ()<>%\"#?").find(c) == std::string_view::npos
               ? std::string(1, c)
               : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return out;
}

std::string with_each(const std::string& text, char special, const std::string& instead) {
  std::string out;
  for (const char c : text)
    out += c == special ? instead : std::string(1, c);
  return out;
}

struct Markdown {
  std::string operator()(const Heading& heading) const {
    return fmt::format("{} {}\n\n", std::string(static_cast<std::size_t>(heading.level), '#'), heading.text);
  }
  std::string operator()(const Paragraph& paragraph) const { return paragraph.text + "\n\n"; }
  std::string operator()(const Verbatim& verbatim) const {
    std::string out = "    ";
    for (const char c : verbatim.text)
      out += c == '\n' ? std::string("\n    ") : std::string(1, c);
    return out + "\n\n";
  }
  std::string operator()(const Image& image) const {
    return fmt::format("![{}]({})\n\n", image.file.stem().string(), link(image.file.string()));
  }
  std::string operator()(const Table& table) const {
    const auto line = [](const std::vector<std::string>& cells) {
      std::string out = "|";
      for (const std::string& cell : cells)
        out += cell.empty() ? " |" : fmt::format(" {} |", with_each(cell, '|', "\\|"));
      return out + "\n";
    };
    std::string out = line(table.header) + "|";
    for (std::size_t i = 0; i < table.header.size(); ++i)
      out += i < table.words ? ":--|" : "--:|";
    out += "\n";
    for (const auto& row : table.rows)
      out += line(row);
    return out + "\n";
  }
  std::string operator()(const FileList& list) const {
    std::string out;
    for (const auto& [file, meaning] : list.files)
      out += fmt::format("- [{}]({}): {}\n", file, link(file), meaning);
    return out + "\n";
  }
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    switch (c) {
    case '&':
      out += "&amp;";
      break;
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '"':
      out += "&quot;";
      break;
    default:
      out += c;
    }
  return out;
}

/// `code` and *stressed words* of a paragraph as tags; a mark without its partner stays as it is.
std::string marked_up(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const char mark = text[i];
    const std::size_t end = mark == '`' || mark == '*' ? text.find(mark, i + 1) : std::string::npos;
    if (end == std::string::npos) {
      out += escaped(std::string(1, text[i++]));
      continue;
    }
    const char* tag = mark == '`' ? "code" : "em";
    out += fmt::format("<{0}>{1}</{0}>", tag, escaped(text.substr(i + 1, end - i - 1)));
    i = end + 1;
  }
  return out;
}

std::string base64_of(const fs::path& file) {
  const std::string bytes = io::read_bytes(file);
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0'); // and the null that OpenSSL ends it with
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

struct Html {
  const fs::path& folder;

  std::string operator()(const Heading& heading) const {
    return fmt::format("<h{0}>{1}</h{0}>\n", heading.level, escaped(heading.text));
  }
  std::string operator()(const Paragraph& paragraph) const {
    return fmt::format("<p>{}</p>\n", marked_up(paragraph.text));
  }
  std::string operator()(const Verbatim& verbatim) const {
    return fmt::format("<pre>{}</pre>\n", escaped(verbatim.text));
  }
  std::string operator()(const Image& image) const {
    return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n",
                       escaped(image.file.stem().string()), base64_of(folder / image.file));
  }
  std::string operator()(const Table& table) const {
    std::string out = "<table>\n";
    const auto line = [&](const std::vector<std::string>& cells, const char* tag) {
      out += "<tr>";
      for (std::size_t i = 0; i < cells.size(); ++i)
        out += fmt::format("<{0}{1}>{2}</{0}>", tag, i < table.words ? " class=\"words\"" : "",
                           escaped(cells[i]));
      out += "</tr>\n";
    };
    bool headed = false;
    for (const std::string& cell : table.header)
      headed = headed || !cell.empty();
    if (headed)
      line(table.header, "th");
    for (const auto& row : table.rows)
      line(row, "td");
    return out + "</table>\n";
  }
  std::string operator()(const FileList& list) const {
    std::string out = "<ul>\n";
    for (const auto& [file, meaning] : list.files)
      out += fmt::format("<li><a href=\"{}\">{}</a>: {}</li>\n", link(file), escaped(file), escaped(meaning));
    return out + "</ul>\n";
  }
};

constexpr const char* style =
    "body{font:16px/1.5 sans-serif;color:#222;max-width:60rem;margin:2rem auto;padding:0 1rem}"
    "img{max-width:100%;display:block;margin:1rem 0}"
    "table{border-collapse:collapse;margin:1rem 0}"
    "th,td{padding:.15rem .8rem;border-bottom:1px solid #ddd;text-align:right}"
    ".words{text-align:left}"
    "pre{background:#f5f5f5;padding:.8rem;overflow-x:auto;font-size:.85rem}"
    "h2{margin-top:2.5rem;border-bottom:2px solid #ddd}";

} // namespace

std::string markdown(const Document& document) {
  std::string out = fmt::format("# {}\n\n", document.title);
  for (const Block& block : document.blocks)
    out += std::visit(Markdown{}, block);
  out.pop_back(); // one line's end is enough
  return out;
}

std::string html(const Document& document, const fs::path& folder) {
  const std::string title = escaped(document.title);
  std::string out = fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                                "<meta name=\"viewport\" content=\"width=device-width\">\n"
                                "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
                                title, style);
  for (const Block& block : document.blocks)
    out += std::visit(Html{folder}, block);
  return out + "</body>\n</html>\n";
}

} // namespace tessera::post
