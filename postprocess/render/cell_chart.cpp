#include "postprocess/render/cell_chart.hpp"

#include "postprocess/render/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tessera::post {
namespace {

using Kind = CellChart::Cell::Kind;

constexpr double cell_width = 112, cell_height = 62, gap = 3, names_width = 330, between = 50, margin = 40;
constexpr double head = 110, panel_title = 60, panel_foot = 100, foot = 80;
constexpr double widest = 2400;

constexpr Colour failed_colour{52, 48, 62}, blank_colour{236, 236, 236};

/// From pale at the limit to full strength `reach` decades from it.
Colour faded(Colour full, Colour pale, double decades, double reach) {
  const double t = std::clamp(std::abs(decades) / reach, 0.0, 1.0);
  Colour mixed{};
  for (std::size_t c = 0; c < 3; ++c)
    mixed[c] = static_cast<std::uint8_t>(std::lround((1 - t) * pale[c] + t * full[c]));
  return mixed;
}

/// Blue and orange stay apart for colour-blind readers, and dark words stand out on all of both.
Colour colour_of(Kind kind, double decades) {
  switch (kind) {
  case Kind::within:
    return faded({86, 158, 220}, {212, 232, 247}, decades, 2);
  case Kind::beyond:
    return faded({226, 110, 40}, {253, 222, 176}, decades, 1);
  case Kind::failed:
    return failed_colour;
  default:
    return blank_colour;
  }
}

/// Where panels and their parts lie, in pixels.
struct Layout {
  int across, down;
  double panel_width, panel_head, panel_height;
  double width, height;

  explicit Layout(const CellChart& chart) {
    const auto panels = std::max<int>(1, static_cast<int>(chart.panels.size()));
    panel_width = cell_width * static_cast<double>(chart.columns.size());
    panel_head = std::all_of(chart.panels.begin(), chart.panels.end(),
                             [](const CellChart::Panel& panel) { return panel.title.empty(); })
                     ? 0
                     : panel_title;
    panel_height = panel_head + cell_height * static_cast<double>(chart.rows.size()) + panel_foot;
    const double room = widest - 2 * margin - names_width + between;
    across = std::clamp(static_cast<int>(room / (panel_width + between)), 1, panels);
    down = (panels + across - 1) / across;
    width = 2 * margin + names_width + across * (panel_width + between) - between;
    width = std::max(width, 1200.0); // room for title and legend
    height = head + down * panel_height + foot;
  }
  double left(int panel) const { return margin + names_width + panel % across * (panel_width + between); }
  double top(int panel) const { return height - head - panel / across * panel_height - panel_head; }
};

void draw_panel(Canvas& canvas, const CellChart& chart, const CellChart::Panel& panel, double left,
                double top, bool row_names) {
  const auto rows = chart.rows.size(), columns = chart.columns.size();
  const double width = cell_width * static_cast<double>(columns);
  const auto row_middle = [&](std::size_t r) { return top - (static_cast<double>(r) + 0.5) * cell_height; };
  canvas.text({left + width / 2, top + 30}, panel.title,
              {.size = 26, .anchor = Anchor::centre, .bold = true, .width = width});
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      const CellChart::Cell& cell = panel.cells[r * columns + c];
      const double x = left + static_cast<double>(c) * cell_width, y = row_middle(r);
      canvas.rectangle({x + gap / 2, y - (cell_height - gap) / 2},
                       {x + cell_width - gap / 2, y + (cell_height - gap) / 2},
                       colour_of(cell.kind, cell.decades));
      canvas.text({x + cell_width / 2, y}, cell.words,
                  {.size = 24,
                   .anchor = Anchor::centre,
                   .light = cell.kind == Kind::failed,
                   .width = cell_width - 12});
    }
  const double bottom = top - cell_height * static_cast<double>(rows);
  for (std::size_t c = 0; c < columns; ++c)
    canvas.text({left + (static_cast<double>(c) + 0.5) * cell_width, bottom - 22}, chart.columns[c],
                {.size = 24, .anchor = Anchor::centre, .width = cell_width - 6});
  canvas.text({left + width / 2, bottom - 62}, chart.column_title,
              {.size = 26, .anchor = Anchor::centre, .width = width});
  if (!row_names)
    return;
  for (std::size_t r = 0; r < rows; ++r)
    canvas.text({left - 14, row_middle(r)}, chart.rows[r],
                {.size = 24, .anchor = Anchor::right, .width = names_width - 70});
  canvas.text({left - names_width + 10, (top + bottom) / 2}, chart.row_title,
              {.size = 26, .anchor = Anchor::centre, .upwards = true});
}

void draw_legend(Canvas& canvas, const CellChart& chart, double width) {
  const struct {
    Kind kind;
    const std::string& words;
  } entries[] = {{Kind::within, chart.within}, {Kind::beyond, chart.beyond}, {Kind::failed, chart.failed}};
  constexpr double shares[] = {0.3, 0.22, 0.48}; // of the width, after what the words usually take
  double x = margin;
  for (std::size_t i = 0; i < std::size(entries); ++i) {
    const auto& entry = entries[i];
    const double room = shares[i] * (width - 2 * margin);
    // The whole range of a colour; from left to right it is getting worse.
    for (int part = 0; part < 3; ++part)
      canvas.rectangle({x + 20 * part, 30}, {x + 20 * (part + 1), 54},
                       colour_of(entry.kind, (entry.kind == Kind::within ? 2 - part : part) / 2.0));
    canvas.text({x + 72, 42}, entry.words, {.size = 23, .width = room - 90});
    x += room;
  }
}

} // namespace

void draw_cell_chart(const CellChart& chart) {
  const Layout layout(chart);
  Canvas canvas(static_cast<int>(layout.width), static_cast<int>(layout.height));
  canvas.text({layout.width / 2, layout.height - 45}, chart.title,
              {.size = 32, .anchor = Anchor::centre, .bold = true, .width = layout.width - 2 * margin});
  for (int p = 0; p < static_cast<int>(chart.panels.size()); ++p)
    draw_panel(canvas, chart, chart.panels[static_cast<std::size_t>(p)], layout.left(p), layout.top(p),
               p % layout.across == 0);
  draw_legend(canvas, chart, layout.width);
  canvas.save(chart.file);
}

} // namespace tessera::post
