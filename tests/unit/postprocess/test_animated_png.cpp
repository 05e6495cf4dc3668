#include "core/error.hpp"
#include "postprocess/animated_png.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace tessera::post {
namespace {

using namespace std::string_literals;

std::string chunk(const std::string& type, const std::string& data, const std::string& sum) {
  return "\0\0\0"s + static_cast<char>(data.size()) + type + data + sum;
}

/// 1 x 1 pixels of grey: header and end with the checksums that libpng writes; the pixel's is not looked at.
std::string png(const std::string& pixel, char width = 1) {
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", "\0\0\0"s + width + "\0\0\0\x01\x08\0\0\0\0"s, "\x3a\x7e\x9b\x55") +
         chunk("IDAT", pixel, "sum!") + chunk("IEND", "", "\xae\x42\x60\x82");
}

struct Chunk {
  std::string type, data, sum;
};

std::vector<Chunk> chunks_of(const std::string& file) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 8; at < file.size();) {
    const auto length = static_cast<std::size_t>(static_cast<unsigned char>(file.at(at + 3)));
    chunks.push_back({file.substr(at + 4, 4), file.substr(at + 8, length), file.substr(at + 8 + length, 4)});
    at += length + 12;
  }
  return chunks;
}

TEST(AnimatedPng, HoldsAStillAndAllFrames) {
  const std::vector<std::string> frames{png("first"), png("second"), png("third")};
  const std::string file = animated_png(frames, 0.25);
  EXPECT_EQ(file.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const auto chunks = chunks_of(file);
  std::string types;
  for (const Chunk& chunk : chunks)
    types += chunk.type + " ";
  EXPECT_EQ(types, "IHDR acTL IDAT fcTL fdAT fcTL fdAT fcTL fdAT IEND ");
  EXPECT_EQ(chunks[0].sum, "\x3a\x7e\x9b\x55") << "of libpng";
  EXPECT_EQ(chunks.back().sum, "\xae\x42\x60\x82") << "of libpng";
  EXPECT_EQ(chunks[1].data, "\0\0\0\x03\0\0\0\0"s) << "three frames, for ever";
  EXPECT_EQ(chunks[2].data, "third") << "what a still shows";
  EXPECT_EQ(chunks[4].data, "\0\0\0\x01"s + "first");
  EXPECT_EQ(chunks[8].data, "\0\0\0\x05"s + "third");
  // Number, width, height, place, 250 of 1000 seconds, nothing blended.
  EXPECT_EQ(chunks[3].data, "\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0\0\0\0\0\0\0\xfa\x03\xe8\0\0"s);
  EXPECT_EQ(chunks[7].data.substr(20, 2), "\x09\xc4"s) << "2.5 s";
}

TEST(AnimatedPng, RefusesWhatIsNone) {
  const auto of = [](std::vector<std::string> frames) { return animated_png(frames, 0.1); };
  EXPECT_THROW(of({}), InputError);
  EXPECT_THROW(of({"GIF89a"}), InputError);
  EXPECT_THROW(of({png("a"), png("a", 2)}), InputError);
  EXPECT_THROW(of({png("a").substr(0, 40)}), InputError);
}

} // namespace
} // namespace tessera::post
