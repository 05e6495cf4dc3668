#include "postprocess/render/plot.hpp"

#include "postprocess/render/canvas.hpp"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace tessera::post {
namespace {

constexpr int chart_width = 1500, chart_height = 850;

void style_axis(vtkAxis& axis, const std::string& title, bool logarithmic) {
  axis.SetTitle(title);
  axis.GetTitleProperties()->SetFontSize(28);
  axis.GetTitleProperties()->BoldOff();
  axis.GetLabelProperties()->SetFontSize(24);
  axis.GetGridPen()->SetColor(225, 225, 225);
  axis.GetPen()->SetWidth(2);
  axis.SetLogScale(logarithmic);
}

/// The points that can be shown: finite, and positive on logarithmic axes.
vtkSmartPointer<vtkTable> table_of(const Curve& curve, const Chart& chart) {
  const vtkNew<vtkDoubleArray> x, y;
  x->SetName("x");
  y->SetName(curve.label.c_str());
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i]))
      continue;
    if ((chart.log_x && curve.x[i] <= 0) || (chart.log_y && curve.y[i] <= 0))
      continue;
    x->InsertNextValue(curve.x[i]);
    y->InsertNextValue(curve.y[i]);
  }
  auto table = vtkSmartPointer<vtkTable>::New();
  table->AddColumn(x);
  table->AddColumn(y);
  return table;
}

void add_curve(vtkChartXY& chart, const Curve& curve, const Chart& spec, int index) {
  const auto table = table_of(curve, spec);
  if (table->GetNumberOfRows() == 0)
    return;
  const Colour colour = curve_colour(index);
  vtkPlot* plot = chart.AddPlot(curve.dots ? vtkChart::POINTS : vtkChart::LINE);
  plot->SetInputData(table, 0, 1);
  plot->SetColor(colour[0], colour[1], colour[2], 255);
  plot->SetWidth(curve.dots ? 11.0f : 3.5f);
  plot->GetPen()->SetLineType(curve.dashed ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE);
  if (auto* points = vtkPlotPoints::SafeDownCast(plot); points && curve.dots)
    points->SetMarkerStyle(vtkPlotPoints::CIRCLE);
}

} // namespace

void draw_plot(const Plot& plot) {
  const auto count = static_cast<int>(plot.charts.size());
  Canvas canvas(chart_width, chart_height * count);
  for (int i = 0; i < count; ++i) {
    const Chart& spec = plot.charts[static_cast<std::size_t>(i)];
    const double low = chart_height * (count - 1 - i);
    vtkRenderer& renderer = canvas.scene({0, low}, {chart_width, low + chart_height});
    const vtkNew<vtkChartXY> chart;
    chart->SetTitle(spec.title);
    chart->GetTitleProperties()->SetFontSize(32);
    chart->GetTitleProperties()->BoldOn();
    style_axis(*chart->GetAxis(vtkAxis::BOTTOM), spec.x_title, spec.log_x);
    style_axis(*chart->GetAxis(vtkAxis::LEFT), spec.y_title, spec.log_y);
    for (std::size_t c = 0; c < spec.curves.size(); ++c)
      add_curve(*chart, spec.curves[c], spec, static_cast<int>(c));
    chart->SetShowLegend(spec.curves.size() > 1);
    chart->GetLegend()->SetLabelSize(24);
    chart->GetLegend()->SetSymbolWidth(60);
    chart->SetAutoSize(false);
    chart->SetSize(vtkRectf(10, 10, chart_width - 40, chart_height - 25));
    const vtkNew<vtkContextActor> actor;
    actor->GetScene()->AddItem(chart);
    actor->GetScene()->SetRenderer(&renderer);
    renderer.AddViewProp(actor);
    canvas.window().Render();
  }
  canvas.save(plot.file);
}

} // namespace tessera::post
