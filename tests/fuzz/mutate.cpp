#include "tests/fuzz/mutate.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace tessera::test {
namespace {

/// SplitMix64: Steele, Lea, Flood, OOPSLA 2014.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15ull) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  std::size_t below(std::size_t n) { return n == 0 ? 0 : next() % n; }

 private:
  std::uint64_t state_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1);
    lines.push_back(text.substr(at, end + 1 - at));
    at = end + 1;
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines)
    text += line;
  return text;
}

void flip_bytes(std::string& file, Random& random) {
  for (std::size_t n = 1 + random.below(8); n > 0; --n)
    file[random.below(file.size())] ^= static_cast<char>(1 << random.below(8));
}

void shift_lines(std::string& file, Random& random, std::size_t how) {
  auto lines = lines_of(file);
  const std::size_t a = random.below(lines.size()), b = random.below(lines.size());
  const auto at = lines.begin() + static_cast<std::ptrdiff_t>(a);
  if (how == 0)
    lines.erase(at);
  else if (how == 1)
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(b), std::string(*at));
  else
    std::swap(lines[a], lines[b]);
  file = joined(lines);
}

/// Another number where one stands.
void change_number(std::string& file, Random& random) {
  const auto part_of_number = [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+' || c == 'e' ||
           c == 'E';
  };
  std::size_t at = random.below(file.size());
  while (at < file.size() && !std::isdigit(static_cast<unsigned char>(file[at])))
    ++at;
  if (at == file.size())
    return;
  std::size_t end = at;
  while (end < file.size() && part_of_number(file[end]))
    ++end;
  static const std::vector<std::string> others{"0",      "-1",         "1",      "1e308", "-1e300",
                                               "1e-300", "nan",        "0.5.",   "1e99",  "99999",
                                               "1e6",    "4294967296", "-0.001", "3.7"};
  file.replace(at, end - at, others[random.below(others.size())]);
}

/// Another digit where one stands: a slip of the hand.
void change_digit(std::string& file, Random& random) {
  std::size_t at = random.below(file.size());
  while (at < file.size() && !std::isdigit(static_cast<unsigned char>(file[at])))
    ++at;
  if (at < file.size())
    file[at] = static_cast<char>('0' + random.below(10));
}

} // namespace

std::string mutate(const std::string& file, std::uint64_t seed) {
  Random random(seed);
  std::string other = file;
  for (std::size_t faults = 1 + random.below(2); faults > 0 && !other.empty(); --faults) {
    switch (random.below(10)) {
    case 0:
      other.resize(random.below(other.size()));
      break;
    case 1: {
      const std::size_t from = random.below(other.size());
      other.erase(from, random.below(other.size() - from) / 4);
      break;
    }
    case 2:
    case 3:
      flip_bytes(other, random);
      break;
    case 4:
    case 5:
      shift_lines(other, random, random.below(3));
      break;
    case 6:
    case 7:
      for (std::size_t n = 1 + random.below(4); n > 0; --n)
        change_digit(other, random);
      break;
    default:
      for (std::size_t n = 1 + random.below(4); n > 0; --n)
        change_number(other, random);
    }
  }
  return other;
}

} // namespace tessera::test
