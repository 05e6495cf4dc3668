#include "postprocess/render/canvas.hpp"

#include "io/atomic_file.hpp"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkPNGWriter.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

namespace tessera::post {
namespace {

constexpr double ink = 0.13; ///< grey of text on white

/// A filled polygon or a line in pixels.
vtkSmartPointer<vtkActor2D> shape(const std::vector<Pixel>& corners, bool filled, Colour colour,
                                  double thickness) {
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<vtkIdType>(corners.size()));
  for (const Pixel& p : corners)
    cells->InsertCellPoint(points->InsertNextPoint(p.x, p.y, 0));
  const vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  if (filled)
    data->SetPolys(cells);
  else
    data->SetLines(cells);
  const vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
  actor->GetProperty()->SetLineWidth(static_cast<float>(thickness));
  return actor;
}

} // namespace

Canvas::Canvas(int width, int height) : width_(width), height_(height) {
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(8);
  window_->SetSize(width, height);
  window_->SetNumberOfLayers(2);
  overlay_->SetLayer(1);
  overlay_->InteractiveOff();
  window_->AddRenderer(overlay_);
  // Layer 0 must cover the whole window for its background to do so.
  scene({0, 0}, {static_cast<double>(width), static_cast<double>(height)});
}

Canvas::~Canvas() = default;

vtkRenderer& Canvas::scene(Pixel lower, Pixel upper) {
  const vtkNew<vtkRenderer> renderer;
  renderer->SetViewport(lower.x / width_, lower.y / height_, upper.x / width_, upper.y / height_);
  renderer->SetBackground(1, 1, 1);
  window_->AddRenderer(renderer);
  return *renderer;
}

void Canvas::text(Pixel at, const std::string& words, const TextStyle& style) {
  if (words.empty())
    return;
  const vtkNew<vtkTextActor> actor;
  actor->SetTextScaleModeToNone();
  actor->SetInput(words.c_str());
  vtkTextProperty& property = *actor->GetTextProperty();
  property.SetFontFamilyToArial();
  property.SetBold(style.bold);
  const double grey = style.light ? 1 : ink;
  property.SetColor(grey, grey, grey);
  property.SetVerticalJustificationToCentered();
  if (style.anchor == Anchor::left)
    property.SetJustificationToLeft();
  if (style.anchor == Anchor::centre)
    property.SetJustificationToCentered();
  if (style.anchor == Anchor::right)
    property.SetJustificationToRight();
  int size = style.size;
  property.SetFontSize(size);
  for (double box[4]; style.width > 0 && size > 10; property.SetFontSize(--size)) {
    actor->GetBoundingBox(overlay_, box);
    if (box[1] - box[0] <= style.width)
      break;
  }
  if (style.upwards)
    actor->SetOrientation(90);
  actor->SetDisplayPosition(static_cast<int>(at.x), static_cast<int>(at.y));
  overlay_->AddViewProp(actor);
}

void Canvas::line(Pixel from, Pixel to, Colour colour, double thickness) {
  overlay_->AddViewProp(shape({from, to}, false, colour, thickness));
}

void Canvas::rectangle(Pixel lower, Pixel upper, Colour fill) {
  polygon({lower, {upper.x, lower.y}, upper, {lower.x, upper.y}}, fill);
}

void Canvas::polygon(const std::vector<Pixel>& corners, Colour fill) {
  overlay_->AddViewProp(shape(corners, true, fill, 1));
}

std::string Canvas::png() {
  window_->Render();
  const vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window_);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  const vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  const vtkUnsignedCharArray* png = writer->GetResult();
  const auto* bytes = reinterpret_cast<const char*>(const_cast<vtkUnsignedCharArray*>(png)->GetPointer(0));
  return {bytes, static_cast<std::size_t>(png->GetNumberOfValues())};
}

void Canvas::save(const std::filesystem::path& file) {
  io::write_text(file, png());
}

} // namespace tessera::post
