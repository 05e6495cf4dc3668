#include "postprocess/render/plot.hpp"

#include "postprocess/render/canvas.hpp"
#include "postprocess/render/ticks.hpp"

#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotBar.h>
#include <vtkPlotPoints.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace tessera::post {
namespace {

constexpr int width = 1600, legend_width = 330;

void style_axis(vtkAxis& axis, const std::string& title) {
  axis.SetTitle(title);
  axis.GetTitleProperties()->SetFontSize(28);
  axis.GetTitleProperties()->BoldOff();
  axis.GetLabelProperties()->SetFontSize(24);
  axis.GetGridPen()->SetColor(225, 225, 225);
  axis.GetPen()->SetWidth(2);
}

bool shown(double value, bool logarithmic) {
  return std::isfinite(value) && (!logarithmic || value > 0);
}

bool can_be_shown(const Curve& curve, const Chart& chart, std::size_t i) {
  return shown(curve.x[i], chart.log_x) && shown(curve.y[i], chart.log_y);
}

bool has_bars(const Chart& chart) {
  return std::any_of(chart.curves.begin(), chart.curves.end(), [](const Curve& c) { return c.bars; });
}

/// Fits the axis to what is shown of the curves, with round numbers beside it.
void fit_axis(vtkAxis& axis, const Chart& chart, bool horizontal) {
  const bool logarithmic = horizontal ? chart.log_x : chart.log_y;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Curve& curve : chart.curves)
    for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
      if (!can_be_shown(curve, chart, i))
        continue;
      const double value = horizontal ? curve.x[i] : curve.y[i];
      // Bars stand on zero and reach half a class to both sides.
      const double reach =
          curve.bars && horizontal && curve.x.size() > 1 ? 0.5 * (curve.x[1] - curve.x[0]) : 0;
      low = std::min(low, curve.bars ? std::min(0.0, value) : value - reach);
      high = std::max(high, value + reach);
    }
  if (low > high)
    return;
  axis.SetBehavior(vtkAxis::FIXED);
  if (logarithmic) {
    axis.SetLogScale(true);
    axis.SetRange(low / 1.5, high * 1.5);
    return;
  }
  if (has_bars(chart)) {
    high += horizontal ? 0 : 0.05 * (high - low);
  } else if (high - low <= 1e-9 * std::max(std::abs(low), std::abs(high)) || high == low) { // constant
    const double half = low == 0 ? 1 : 0.1 * std::abs(low);
    low -= half;
    high += half;
  } else if (!horizontal ||
             std::any_of(chart.curves.begin(), chart.curves.end(), [](const Curve& c) { return c.dots; })) {
    const double air = 0.05 * (high - low);
    low = low >= 0 && low < air ? 0 : low - air;
    high += air;
  }
  axis.SetRange(low, high);
  const vtkNew<vtkDoubleArray> places;
  const vtkNew<vtkStringArray> labels;
  for (const double tick : round_ticks(low, high, 7)) {
    places->InsertNextValue(tick);
    labels->InsertNextValue(fmt::format("{:.6g}", std::abs(tick) < 1e-9 * (high - low) ? 0.0 : tick));
  }
  axis.SetCustomTickPositions(places, labels);
}

/// The runs of points that can be shown: a line has a gap where it has no value.
std::vector<vtkSmartPointer<vtkTable>> pieces_of(const Curve& curve, const Chart& chart) {
  std::vector<vtkSmartPointer<vtkTable>> pieces;
  const std::size_t points = std::min(curve.x.size(), curve.y.size());
  for (std::size_t i = 0; i < points; ++i) {
    const vtkNew<vtkDoubleArray> x, y;
    x->SetName("x");
    y->SetName(curve.label.c_str());
    for (; i < points && can_be_shown(curve, chart, i); ++i) {
      x->InsertNextValue(curve.x[i]);
      y->InsertNextValue(curve.y[i]);
    }
    if (x->GetNumberOfTuples() == 0)
      continue;
    auto& table = pieces.emplace_back(vtkSmartPointer<vtkTable>::New());
    table->AddColumn(x);
    table->AddColumn(y);
  }
  return pieces;
}

Colour colour_of(const Curve& curve, int index) {
  return curve_colour(curve.colour == Curve::by_place ? index : curve.colour);
}

int marker_of(const Curve& curve) {
  constexpr std::array styles{vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE, vtkPlotPoints::DIAMOND,
                              vtkPlotPoints::PLUS, vtkPlotPoints::CROSS};
  return styles[static_cast<std::size_t>(curve.marker) % styles.size()];
}

void add_piece(vtkChartXY& chart, const Curve& curve, vtkTable* table, Colour colour) {
  vtkPlot* plot = chart.AddPlot(curve.bars ? vtkChart::BAR : curve.dots ? vtkChart::POINTS : vtkChart::LINE);
  plot->SetInputData(table, 0, 1);
  plot->SetColor(colour[0], colour[1], colour[2], 255);
  if (curve.bars) {
    chart.SetBarWidthFraction(1); // classes side by side, told apart by their white rims
    plot->GetPen()->SetColor(255, 255, 255);
    plot->GetPen()->SetWidth(1.5f);
    return;
  }
  constexpr std::size_t many = 200;
  plot->SetWidth(!curve.dots ? 3.5f : curve.x.size() < many ? 11.0f : 6.0f);
  plot->GetPen()->SetLineType(curve.dashed ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE);
  if (auto* points = vtkPlotPoints::SafeDownCast(plot); points && curve.dots)
    points->SetMarkerStyle(marker_of(curve));
}

void add_curve(vtkChartXY& chart, const Curve& curve, const Chart& spec, int index) {
  for (const auto& piece : pieces_of(curve, spec))
    add_piece(chart, curve, piece, colour_of(curve, index));
}

/// As the chart draws it.
void draw_marker(Canvas& canvas, Pixel at, int style, Colour colour) {
  constexpr double reach = 9;
  const auto turned = [&](int corners, double first) {
    std::vector<Pixel> ring;
    for (int i = 0; i < corners; ++i) {
      const double angle = first + 2 * std::numbers::pi * i / corners;
      ring.push_back({at.x + reach * std::cos(angle), at.y + reach * std::sin(angle)});
    }
    return ring;
  };
  const auto stroke = [&](double x, double y) {
    canvas.line({at.x - x, at.y - y}, {at.x + x, at.y + y}, colour, 4);
  };
  switch (style) {
  case vtkPlotPoints::SQUARE:
    return canvas.polygon(turned(4, std::numbers::pi / 4), colour);
  case vtkPlotPoints::DIAMOND:
    return canvas.polygon(turned(4, 0), colour);
  case vtkPlotPoints::PLUS:
    stroke(reach, 0);
    return stroke(0, reach);
  case vtkPlotPoints::CROSS:
    stroke(0.7 * reach, 0.7 * reach);
    return stroke(0.7 * reach, -0.7 * reach);
  default:
    return canvas.polygon(turned(24, 0), colour);
  }
}

/// Names of the curves to the right of the chart, where they hide nothing.
void draw_legend(Canvas& canvas, const Chart& chart, double top, double height) {
  const double left = width - legend_width + 20;
  const auto named = std::count_if(chart.curves.begin(), chart.curves.end(),
                                   [](const Curve& curve) { return !curve.label.empty(); });
  const double step = std::min(44.0, height / static_cast<double>(std::max<std::ptrdiff_t>(named, 1)));
  const int size = std::clamp(static_cast<int>(0.7 * step), 10, 25);
  double y = top - 110;
  for (std::size_t c = 0; c < chart.curves.size(); ++c) {
    const Curve& curve = chart.curves[c];
    if (curve.label.empty())
      continue;
    const Colour colour = colour_of(curve, static_cast<int>(c));
    if (curve.dots)
      draw_marker(canvas, {left + 27, y}, marker_of(curve), colour);
    else if (curve.dashed)
      for (const double part : {0.0, 22.0, 44.0})
        canvas.line({left + part, y}, {left + part + 12, y}, colour, 5);
    else
      canvas.line({left, y}, {left + 54, y}, colour, 5);
    canvas.text({left + 70, y}, curve.label, {.size = size, .width = legend_width - 100.0});
    y -= step;
  }
}

} // namespace

void draw_plot(const Plot& plot) {
  const auto count = static_cast<int>(plot.charts.size());
  // Many charts become lower: renderers draw no picture above 16384 pixels.
  const int height = plot.beside ? 560 : std::clamp(12000 / std::max(count, 1), 260, 800);
  const int columns = plot.beside ? std::max(count, 1) : 1, rows = plot.beside ? 1 : count;
  const int chart_room = plot.beside ? 800 : width;
  Canvas canvas(chart_room * columns, height * rows);
  for (int i = 0; i < count; ++i) {
    const Chart& spec = plot.charts[static_cast<std::size_t>(i)];
    const double left = plot.beside ? chart_room * i : 0, low = plot.beside ? 0 : height * (count - 1 - i);
    const bool legend = !plot.beside && spec.curves.size() > 1;
    const int chart_width = legend ? chart_room - legend_width : chart_room - 40;
    vtkRenderer& renderer = canvas.scene({left, low}, {left + chart_width, low + height});
    const vtkNew<vtkChartXY> chart;
    style_axis(*chart->GetAxis(vtkAxis::BOTTOM), spec.x_title);
    style_axis(*chart->GetAxis(vtkAxis::LEFT), "");
    for (std::size_t c = 0; c < spec.curves.size(); ++c)
      add_curve(*chart, spec.curves[c], spec, static_cast<int>(c));
    fit_axis(*chart->GetAxis(vtkAxis::BOTTOM), spec, true);
    fit_axis(*chart->GetAxis(vtkAxis::LEFT), spec, false);
    chart->SetAutoSize(false);
    chart->SetSize(vtkRectf(60, 15, static_cast<float>(chart_width) - 80, height - 95));
    canvas.text({left + chart_width / 2.0, low + height - 45}, spec.title,
                {.size = 32, .anchor = Anchor::centre, .bold = true, .width = chart_width - 40.0});
    // VTK would set it into the numbers beside the axis.
    canvas.text({left + 32, low + height / 2.0 - 20}, spec.y_title,
                {.size = 28, .anchor = Anchor::centre, .upwards = true});
    if (legend)
      draw_legend(canvas, spec, low + height, height - 150);
    const vtkNew<vtkContextActor> actor;
    actor->GetScene()->AddItem(chart);
    actor->GetScene()->SetRenderer(&renderer);
    renderer.AddViewProp(actor);
  }
  canvas.save(plot.file);
}

} // namespace tessera::post
