/// A picture as a test sees it.
#pragma once

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>

namespace tessera::test {

/// What can be said of a picture without looking at it.
struct Seen {
  int width = 0, height = 0;
  std::set<std::array<int, 3>> colours;
  double white = 0;               ///< share of the pixels
  int largest_patch = 0;          ///< pixels of the most frequent saturated colour
  int left = 1 << 30, right = -1; ///< columns of the saturated pixels, that is of the body and the colour bar

  explicit Seen(const std::filesystem::path& file) {
    const vtkNew<vtkPNGReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkImageData* image = reader->GetOutput();
    width = image->GetDimensions()[0];
    height = image->GetDimensions()[1];
    std::map<std::array<int, 3>, int> saturated;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const auto* p = static_cast<const unsigned char*>(image->GetScalarPointer(x, y, 0));
        colours.insert({p[0], p[1], p[2]});
        white += p[0] == 255 && p[1] == 255 && p[2] == 255;
        const auto [low, high] = std::minmax({p[0], p[1], p[2]});
        if (high - low < 60)
          continue;
        largest_patch = std::max(largest_patch, ++saturated[{p[0], p[1], p[2]}]);
        left = std::min(left, x);
        right = std::max(right, x);
      }
    white /= static_cast<double>(width) * height;
  }
};

} // namespace tessera::test
