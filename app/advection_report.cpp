#include "app/advection_report.hpp"

#include "app/complex_curve.hpp"
#include "solver/time/advection.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace tessera::app {
namespace {

using Json = nlohmann::ordered_json;
using solver::AdvectionScheme;
using solver::Complex;

constexpr double shown_courant = 0.5, shown_kappa4 = 1.0 / 16; // those of the thesis' figures
constexpr std::array shown = {AdvectionScheme{2, 0}, AdvectionScheme{3, 0}, AdvectionScheme{2, shown_kappa4},
                              AdvectionScheme{3, shown_kappa4}};
constexpr std::array limited_kappa4 = {0.0, 1.0 / 64, 1.0 / 32, 1.0 / 16, 1.0 / 8, 1.0 / 4};
constexpr std::array sides = {2, 3};
constexpr int waves = 720; ///< from Phi = 0 to pi

double wave(int i) {
  return std::numbers::pi * i / waves;
}

std::string label_of(const AdvectionScheme& scheme) {
  return fmt::format("{} per side{}", scheme.per_side, scheme.kappa4 > 0 ? ", JST" : "");
}

std::string kappa_text(double kappa4) {
  return kappa4 == 0 ? "none" : fmt::format("1/{:g}", 1 / kappa4);
}

/// An eighth is more telling than 0.125.
std::string fraction_text(double value) {
  for (int denominator = 1; denominator <= 746; ++denominator) {
    const double numerator = value * denominator;
    if (std::abs(numerator - std::round(numerator)) < 1e-12 * denominator)
      return denominator == 1 ? fmt::format("{:g}", std::round(numerator))
                              : fmt::format("{:g}/{}", std::round(numerator), denominator);
  }
  return fmt::format("{:.6g}", value);
}

/// The upper half from `leftmost` on with its mirror image, in one line through the real axis.
post::Curve detail(const std::string& label, std::vector<Complex> upper, bool dashed, double leftmost) {
  std::erase_if(upper, [&](Complex z) { return z.real() < leftmost; });
  post::Curve curve;
  curve.label = label;
  curve.dashed = dashed;
  for (std::size_t i = 0; i < 2 * upper.size(); ++i) {
    const Complex z = i < upper.size() ? std::conj(upper[upper.size() - 1 - i]) : upper[i - upper.size()];
    curve.x.push_back(z.real());
    curve.y.push_back(z.imag());
  }
  return curve;
}

std::vector<Complex> over_waves(const std::function<Complex(double)>& value) {
  std::vector<Complex> values;
  for (int i = 0; i <= waves; ++i)
    values.push_back(value(-wave(i))); // the waves that run backwards are the upper half
  return values;
}

using Drawn = std::function<post::Curve(const std::string&, const std::vector<Complex>&, bool dashed)>;

post::Chart eigenvalue_chart(const std::string& title, double kappa4, const Drawn& drawn) {
  post::Chart chart{title, "Real part", "Imaginary part", false, false, {}};
  chart.curves.push_back(drawn("Heun: |z| = 1", solver::heun_region(4000), true));
  for (const int per_side : sides) {
    const AdvectionScheme scheme{per_side, kappa4};
    chart.curves.push_back(drawn(label_of(scheme), over_waves([&](double Phi) {
                                   return shown_courant * solver::advection_eigenvalue(scheme, Phi);
                                 }),
                                 false));
  }
  return chart;
}

post::Chart amplification_chart(const std::string& title, double kappa4, const Drawn& drawn) {
  post::Chart chart{title, "Real part", "Imaginary part", false, false, {}};
  chart.curves.push_back(
      drawn("|z| = 1", over_waves([](double Phi) { return std::polar(1.0, -Phi); }), true));
  for (const int per_side : sides) {
    const AdvectionScheme scheme{per_side, kappa4};
    chart.curves.push_back(drawn(label_of(scheme), over_waves([&](double Phi) {
                                   return solver::advection_amplification(scheme, shown_courant, Phi);
                                 }),
                                 false));
  }
  return chart;
}

post::Chart error_chart(const std::string& title, const std::string& y_title, double kappa4,
                        const std::function<double(const AdvectionScheme&, double)>& error) {
  post::Chart chart{title, "Phase angle of the wave over pi", y_title, false, false, {}};
  for (const int per_side : sides) {
    const AdvectionScheme scheme{per_side, kappa4};
    post::Curve curve{label_of(scheme), {}, {}};
    for (int i = 0; i <= waves; ++i) {
      curve.x.push_back(static_cast<double>(i) / waves);
      curve.y.push_back(error(scheme, wave(i)));
    }
    chart.curves.push_back(std::move(curve));
  }
  post::Curve exact{"exact", {0, 1}, {1, 1}};
  exact.dashed = true;
  chart.curves.push_back(std::move(exact));
  return chart;
}

double dissipation_error(const AdvectionScheme& scheme, double Phi) {
  return std::abs(solver::advection_amplification(scheme, shown_courant, Phi));
}

double lag(const AdvectionScheme& scheme, double Phi) {
  return solver::dispersion_error(scheme, shown_courant, Phi);
}

std::string markdown_table(int per_side, bool corrected) {
  std::string text = "| |";
  std::string rule = "|:--|";
  const std::vector<solver::KernelRow> rows = solver::kernel_table(per_side);
  for (const solver::KernelRow& row : rows) {
    text += row.offset == 0 ? " a |" : fmt::format(" a{:+d} |", row.offset);
    rule += "--:|";
  }
  text += "\n" + rule + "\n";
  const std::array names = {"W", "∇W", "∇²W", "∇³W", "∇⁴W"};
  for (std::size_t m = 0; m < (corrected ? 3U : 5U); ++m) {
    text += fmt::format("| {} |", names[m]);
    for (const solver::KernelRow& row : rows)
      text += fmt::format(" {} |", fraction_text(corrected ? row.corrected[m] : row.derivative[m]));
    text += "\n";
  }
  return text;
}

} // namespace

std::string advection_csv() {
  std::string text = "per_side,kappa4,courant,phi_rad,eigenvalue_re,eigenvalue_im,z_re,z_im,"
                     "dissipation_error,dispersion_error\n";
  for (const AdvectionScheme& scheme : shown)
    for (int i = 0; i <= waves; ++i) {
      const double Phi = wave(i);
      const Complex step = shown_courant * solver::advection_eigenvalue(scheme, Phi);
      const Complex z = solver::heun_amplification(step);
      text += fmt::format("{},{:.9g},{:.9g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g}\n",
                          scheme.per_side, scheme.kappa4, shown_courant, Phi, step.real(), step.imag(),
                          z.real(), z.imag(), std::abs(z), lag(scheme, Phi));
    }
  return text;
}

std::string kernel_tables_csv() {
  std::string text = "per_side,offset,W,W1,W2,W3,W4,corrected_W,corrected_W1,corrected_W2\n";
  for (const int per_side : sides)
    for (const solver::KernelRow& row : solver::kernel_table(per_side)) {
      text += fmt::format("{},{}", per_side, row.offset);
      for (const double value : row.derivative)
        text += fmt::format(",{:.12g}", value);
      for (const double value : row.corrected)
        text += fmt::format(",{:.12g}", value);
      text += "\n";
    }
  return text;
}

std::string advection_json() {
  Json json = {{"tables", Json::array()}, {"limits", Json::array()}};
  for (const int per_side : sides) {
    Json table = {{"per_side", per_side}, {"rows", Json::array()}};
    for (const solver::KernelRow& row : solver::kernel_table(per_side))
      table["rows"].push_back(
          {{"offset", row.offset}, {"kernel", row.derivative}, {"corrected", row.corrected}});
    json["tables"].push_back(std::move(table));
  }
  for (const double kappa4 : limited_kappa4)
    for (const int per_side : sides) {
      const AdvectionScheme scheme{per_side, kappa4};
      json["limits"].push_back({{"per_side", per_side},
                                {"kappa4", kappa4},
                                {"courant", solver::largest_courant(scheme)},
                                {"first_to_grow_rad", solver::first_to_grow(scheme)}});
    }
  return json.dump(1) + "\n";
}

std::string courant_table() {
  std::string text =
      fmt::format("largest stable courant number c dt/dx, and the wave that grows first beyond it\n"
                  "{:>8}{:>26}{:>26}\n",
                  "kappa4", "2 per side", "3 per side");
  for (const double kappa4 : limited_kappa4) {
    text += fmt::format("{:>8}", kappa_text(kappa4));
    for (const int per_side : sides) {
      const AdvectionScheme scheme{per_side, kappa4};
      const double Phi = solver::first_to_grow(scheme);
      text += fmt::format("{:>12.4f}{:>14}", solver::largest_courant(scheme),
                          kappa4 == 0 ? "all"
                          : Phi == 0  ? "long"
                                      : fmt::format("{:.3f} pi", Phi / std::numbers::pi));
    }
    text += "\n";
  }
  return text;
}

std::string advection_report(const std::vector<std::filesystem::path>& pictures) {
  std::string text =
      "# Stability and accuracy of the one-dimensional model\n\n"
      "A wave is carried along a line of particles: u_t + c u_x = -c κ4/Δx ∇⁴u, corrected quintic kernel, "
      "Heun's method.\n\n";
  for (const int per_side : sides)
    text += fmt::format("## {} particles per side\n\nKernel as it is (α = 1/8; by powers of Δx):\n\n{}\n"
                        "Corrected:\n\n{}\n",
                        per_side, markdown_table(per_side, false), markdown_table(per_side, true));
  text += "## Limits of stability\n\n| κ4 | 2 per side: c Δt/Δx | first to grow | 3 per side: c Δt/Δx | "
          "first to grow |\n"
          "|--:|--:|--:|--:|--:|\n";
  for (const double kappa4 : limited_kappa4) {
    text += fmt::format("| {} |", kappa_text(kappa4));
    for (const int per_side : sides) {
      const AdvectionScheme scheme{per_side, kappa4};
      const double Phi = solver::first_to_grow(scheme);
      text += fmt::format(" {:.4f} | {} |", solver::largest_courant(scheme),
                          kappa4 == 0 ? "all waves"
                          : Phi == 0  ? "the longest"
                                      : fmt::format("Φ = {:.3f} π", Phi / std::numbers::pi));
    }
    text += "\n";
  }
  text += "\n## Errors at courant 1/2\n\n| wave | 2 per side | 3 per side | 2, κ4 = 1/16 | 3, κ4 = 1/16 |\n"
          "|:--|--:|--:|--:|--:|\n";
  for (const double part : {12.0, 4.0, 2.0}) {
    const double Phi = std::numbers::pi / part;
    text += fmt::format("| amplitude a step, Φ = π/{:g} |", part);
    for (const AdvectionScheme& scheme : shown)
      text += fmt::format(" {:.6f} |", dissipation_error(scheme, Phi));
    text += fmt::format("\n| speed over c, Φ = π/{:g} |", part);
    for (const AdvectionScheme& scheme : shown)
      text += fmt::format(" {:.6f} |", lag(scheme, Phi));
    text += "\n";
  }
  for (const auto& picture : pictures)
    text += fmt::format("\n![{}]({})\n", picture.stem().string(), picture.filename().string());
  return text;
}

std::vector<post::Plot> advection_plots(const std::filesystem::path& folder) {
  const auto file = [&](const char* name) { return std::filesystem::absolute(folder / name).string(); };
  post::Plot eigenvalues, amplification, errors;
  eigenvalues.file = file("eigenvalues.png");
  const auto near = [](double leftmost) {
    return [leftmost](const std::string& label, const std::vector<Complex>& upper, bool dashed) {
      return detail(label, upper, dashed, leftmost);
    };
  };
  eigenvalues.charts = {
      eigenvalue_chart("Eigenvalues times the step at courant 1/2, no dissipation: detail", 0, near(-0.03)),
      eigenvalue_chart("Eigenvalues times the step at courant 1/2, dissipation 1/16", shown_kappa4,
                       closed_curve)};
  amplification.file = file("amplification.png");
  amplification.charts = {
      amplification_chart("Amplification factors at courant 1/2, no dissipation: detail", 0, near(0.86)),
      amplification_chart("Amplification factors at courant 1/2, dissipation 1/16", shown_kappa4,
                          closed_curve)};
  errors.file = file("errors.png");
  errors.charts = {
      error_chart("Amplitude after a step, no dissipation", "Over the exact", 0, dissipation_error),
      error_chart("Amplitude after a step, dissipation 1/16", "Over the exact", shown_kappa4,
                  dissipation_error),
      error_chart("Speed, no dissipation", "Over the exact", 0, lag),
      error_chart("Speed, dissipation 1/16", "Over the exact", shown_kappa4, lag)};
  return {eigenvalues, amplification, errors};
}

} // namespace tessera::app
