#include "core/error.hpp"
#include "postprocess/render_job.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace tessera::post {
namespace {

using nlohmann::json;

/// JSON has no NaN: null stands for it.
double number(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

std::vector<double> numbers(const json& values) {
  std::vector<double> out;
  for (const json& value : values)
    out.push_back(number(value));
  return out;
}

json of(const Vec3& x) {
  return {x[0], x[1], x[2]};
}

Vec3 vector_of(const json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

json of(const Tool& tool) {
  json line = json::array();
  for (const Vec3& x : tool.line)
    line.push_back(of(x));
  return {{"point", of(tool.point)},
          {"normal", of(tool.normal)},
          {"line", line},
          {"velocity", of(tool.velocity)}};
}

Tool tool_of(const json& value) {
  Tool tool{vector_of(value.at("point")), vector_of(value.at("normal")), {}, vector_of(value.at("velocity"))};
  for (const json& x : value.at("line"))
    tool.line.push_back(vector_of(x));
  return tool;
}

json of(const Panel& panel) {
  return {{"file", panel.file},       {"label", panel.label}, {"time", panel.time},
          {"spacing", panel.spacing}, {"clip", panel.clip},   {"cells", panel.cells},
          {"body", panel.body},       {"cloud", panel.cloud}, {"clip_at", panel.clip_at},
          {"magnify", panel.magnify}};
}

json of(const Drawing& drawing) {
  json panels = json::array(), tools = json::array();
  for (const Tool& tool : drawing.tools)
    tools.push_back(of(tool));
  for (const Panel& panel : drawing.panels)
    panels.push_back(of(panel));
  return {{"file", drawing.file},
          {"title", drawing.title},
          {"field", drawing.field},
          {"view", drawing.view},
          {"minimum", drawing.minimum},
          {"maximum", drawing.maximum},
          {"outline", drawing.outline},
          {"skin", drawing.skin},
          {"one_place", drawing.one_place},
          {"one_by_one", drawing.one_by_one},
          {"columns", drawing.columns},
          {"cloud", drawing.cloud},
          {"tools", tools},
          {"panels", panels}};
}

json of(const Chart& chart) {
  json curves = json::array();
  for (const Curve& curve : chart.curves)
    curves.push_back({{"label", curve.label},
                      {"x", curve.x},
                      {"y", curve.y},
                      {"dots", curve.dots},
                      {"dashed", curve.dashed},
                      {"bars", curve.bars},
                      {"colour", curve.colour},
                      {"marker", curve.marker}});
  return {{"title", chart.title}, {"x_title", chart.x_title}, {"y_title", chart.y_title},
          {"log_x", chart.log_x}, {"log_y", chart.log_y},     {"curves", curves}};
}

Drawing drawing_of(const json& value) {
  Drawing drawing{value.at("file"),
                  value.at("title"),
                  value.at("field"),
                  value.at("view"),
                  number(value.at("minimum")),
                  number(value.at("maximum")),
                  value.at("outline"),
                  value.at("skin"),
                  value.at("one_place"),
                  value.at("one_by_one"),
                  value.at("columns"),
                  value.at("cloud"),
                  {},
                  {}};
  for (const json& tool : value.at("tools"))
    drawing.tools.push_back(tool_of(tool));
  for (const json& panel : value.at("panels"))
    drawing.panels.push_back({panel.at("file"), panel.at("label"), number(panel.at("time")),
                              panel.at("spacing"), panel.at("clip"), panel.at("cells"), panel.at("body"),
                              panel.at("cloud"), number(panel.at("clip_at")), panel.at("magnify")});
  return drawing;
}

Chart chart_of(const json& value) {
  Chart chart{value.at("title"), value.at("x_title"), value.at("y_title"),
              value.at("log_x"), value.at("log_y"),   {}};
  for (const json& curve : value.at("curves"))
    chart.curves.push_back({curve.at("label"), numbers(curve.at("x")), numbers(curve.at("y")),
                            curve.at("dots"), curve.at("dashed"), curve.at("bars"), curve.at("colour"),
                            curve.at("marker")});
  return chart;
}

json of(const CellChart& chart) {
  json panels = json::array();
  for (const CellChart::Panel& panel : chart.panels) {
    json cells = json::array();
    for (const CellChart::Cell& cell : panel.cells)
      cells.push_back({static_cast<int>(cell.kind), cell.decades, cell.words});
    panels.push_back({{"title", panel.title}, {"cells", cells}});
  }
  return {{"file", chart.file},           {"title", chart.title},
          {"row_title", chart.row_title}, {"column_title", chart.column_title},
          {"rows", chart.rows},           {"columns", chart.columns},
          {"within", chart.within},       {"beyond", chart.beyond},
          {"failed", chart.failed},       {"panels", panels}};
}

CellChart cell_chart_of(const json& value) {
  CellChart chart{value.at("file"),      value.at("title"),
                  value.at("row_title"), value.at("column_title"),
                  value.at("rows"),      value.at("columns"),
                  value.at("within"),    value.at("beyond"),
                  value.at("failed"),    {}};
  for (const json& item : value.at("panels")) {
    CellChart::Panel panel{item.at("title"), {}};
    for (const json& cell : item.at("cells"))
      panel.cells.push_back({static_cast<CellChart::Cell::Kind>(std::clamp(cell.at(0).get<int>(), 0, 3)),
                             number(cell.at(1)), cell.at(2)});
    if (panel.cells.size() != chart.rows.size() * chart.columns.size())
      throw InputError("a panel has not a cell for each row and column", chart.file, "");
    chart.panels.push_back(std::move(panel));
  }
  return chart;
}

} // namespace

std::string to_json(const RenderJob& job) {
  json drawings = json::array(), plots = json::array(), cell_charts = json::array();
  for (const Drawing& drawing : job.drawings)
    drawings.push_back(of(drawing));
  for (const Plot& plot : job.plots) {
    json charts = json::array();
    for (const Chart& chart : plot.charts)
      charts.push_back(of(chart));
    plots.push_back({{"file", plot.file}, {"charts", charts}, {"beside", plot.beside}});
  }
  for (const CellChart& chart : job.cell_charts)
    cell_charts.push_back(of(chart));
  // Labels come from folder names, which need not be UTF-8.
  return json{{"drawings", drawings}, {"plots", plots}, {"cell_charts", cell_charts}}.dump(
      1, ' ', false, json::error_handler_t::replace);
}

RenderJob render_job_from_json(const std::string& text) {
  RenderJob job;
  try {
    const json root = json::parse(text);
    for (const json& drawing : root.at("drawings"))
      job.drawings.push_back(drawing_of(drawing));
    for (const json& value : root.at("plots")) {
      Plot plot{value.at("file"), {}, value.at("beside")};
      for (const json& chart : value.at("charts"))
        plot.charts.push_back(chart_of(chart));
      job.plots.push_back(std::move(plot));
    }
    for (const json& value : root.at("cell_charts"))
      job.cell_charts.push_back(cell_chart_of(value));
  } catch (const json::exception& error) {
    throw InputError(std::string("not a list of pictures: ") + error.what(), "", "");
  }
  return job;
}

} // namespace tessera::post
