/// A picture in the making: VTK's off-screen window with a layer of text, lines and bars in pixels on top.
#pragma once

#include "postprocess/render/palette.hpp"

#include <vtkNew.h>

#include <filesystem>
#include <string>
#include <vector>

class vtkRenderWindow;
class vtkRenderer;

namespace tessera::post {

/// Pixels from the picture's lower left corner.
struct Pixel {
  double x = 0, y = 0;
};

enum class Anchor { left, centre, right };

struct TextStyle {
  int size = 26;
  Anchor anchor = Anchor::left; ///< which part of the text lies at the given x; vertically its middle does
  bool bold = false;
  bool light = false;   ///< white, for dark grounds
  bool upwards = false; ///< turned to read from below to above; the anchor is then along y
  double width = 0;     ///< the size shrinks until the text fits; 0: no limit
};

class Canvas {
 public:
  Canvas(int width, int height);
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;
  ~Canvas();

  int width() const { return width_; }
  int height() const { return height_; }

  /// A renderer for three dimensions in that part of the picture; lives as long as the canvas.
  vtkRenderer& scene(Pixel lower, Pixel upper);
  vtkRenderWindow& window() { return *window_; }

  void text(Pixel at, const std::string& words, const TextStyle& style = {});
  void line(Pixel from, Pixel to, Colour colour, double thickness);
  void rectangle(Pixel lower, Pixel upper, Colour fill);
  void polygon(const std::vector<Pixel>& corners, Colour fill);

  /// Draws everything: the bytes of a PNG file.
  std::string png();
  /// The same as a file; RunError when the disk refuses.
  void save(const std::filesystem::path& file);

 private:
  int width_, height_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> overlay_;
};

} // namespace tessera::post
