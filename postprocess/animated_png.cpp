#include "postprocess/animated_png.hpp"

#include "core/error.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tessera::post {
namespace {

constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";

struct Chunk {
  std::string_view type, data;
};

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

std::string bytes_of(std::uint32_t value, int count = 4) {
  std::string bytes;
  for (int k = count - 1; k >= 0; --k)
    bytes += static_cast<char>(value >> (8 * k) & 0xff);
  return bytes;
}

/// CRC-32 of ISO 3309, as PNG has it.
std::uint32_t checksum(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> entries{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      entries[n] = n;
      for (int bit = 0; bit < 8; ++bit)
        entries[n] = (entries[n] & 1) != 0 ? 0xedb88320u ^ entries[n] >> 1 : entries[n] >> 1;
    }
    return entries;
  }();
  std::uint32_t sum = 0xffffffffu;
  for (const char c : bytes)
    sum = table[(sum ^ static_cast<unsigned char>(c)) & 0xff] ^ sum >> 8;
  return ~sum;
}

std::vector<Chunk> chunks_of(std::string_view png) {
  require(png.starts_with(signature), "a frame of the animation is no PNG", "", "");
  std::vector<Chunk> chunks;
  for (std::size_t at = signature.size(); at < png.size();) {
    require(png.size() - at >= 12 && number_at(png, at) <= png.size() - at - 12,
            "a frame of the animation is truncated", "", "");
    const std::size_t length = number_at(png, at);
    chunks.push_back({png.substr(at + 4, 4), png.substr(at + 8, length)});
    at += length + 12;
  }
  return chunks;
}

class Animation {
 public:
  /// `header` is the first frame's.
  Animation(std::string_view header, std::size_t frames) : header_(header), text_(signature) {
    add("IHDR", header_);
    add("acTL", bytes_of(static_cast<std::uint32_t>(frames)) + bytes_of(0)); // for ever
  }

  void add(std::string_view type, const std::string& data) {
    const std::string content = std::string(type) + data;
    text_ += bytes_of(static_cast<std::uint32_t>(data.size())) + content + bytes_of(checksum(content));
  }

  /// The picture of programs that know no animation.
  void add_still(const std::vector<Chunk>& png) {
    for (const Chunk& chunk : png)
      if (chunk.type == "IDAT")
        add("IDAT", std::string(chunk.data));
  }

  void add_frame(const std::vector<Chunk>& png, double seconds) {
    const auto milliseconds = static_cast<std::uint32_t>(std::lround(1000 * seconds));
    add("fcTL", bytes_of(sequence_++) + header_.substr(0, 8) + bytes_of(0) + bytes_of(0) +
                    bytes_of(milliseconds, 2) + bytes_of(1000, 2) + bytes_of(0, 2));
    for (const Chunk& chunk : png)
      if (chunk.type == "IDAT")
        add("fdAT", bytes_of(sequence_++) + std::string(chunk.data));
  }

  std::string finished() {
    add("IEND", "");
    return std::move(text_);
  }

 private:
  std::string header_, text_;
  std::uint32_t sequence_ = 0;
};

} // namespace

std::string animated_png(std::span<const std::string> frames, double seconds) {
  require(!frames.empty(), "an animation has no frames", "", "");
  std::vector<std::vector<Chunk>> pngs;
  for (const std::string& frame : frames) {
    pngs.push_back(chunks_of(frame));
    require(!pngs.back().empty() && pngs.back().front().type == "IHDR" &&
                pngs.back().front().data == pngs.front().front().data,
            "the frames of an animation differ in size", "", "");
  }
  Animation animation(pngs.front().front().data, frames.size());
  animation.add_still(pngs.back());
  for (std::size_t i = 0; i < pngs.size(); ++i)
    animation.add_frame(pngs[i], i + 1 < pngs.size() ? seconds : 10 * seconds);
  return animation.finished();
}

} // namespace tessera::post
