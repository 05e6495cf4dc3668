#include "app/stability_report.hpp"

#include "app/complex_curve.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tessera::app {
namespace {

using Json = nlohmann::ordered_json;
using solver::Spectrum;
using solver::StabilityFindings;

double spectral_radius(const Spectrum& spectrum) {
  double most = 0;
  for (const auto& lambda : spectrum.eigenvalues)
    most = std::max(most, std::abs(lambda));
  return most;
}

bool is_heun(const StabilityFindings& findings) {
  return findings.integrator == "heun";
}

std::string line(const std::string& what, const std::string& value) {
  return fmt::format("  {:<31}{}\n", what, value);
}

std::string largest_step_text(const StabilityFindings& findings, const std::optional<double>& step) {
  if (!step)
    return fmt::format("left out: operators that are not symmetric, or a J of its own, on more than {} rows",
                       solver::largest_step_matrix);
  if (*step == 0 || !std::isfinite(*step))
    return *step == 0 ? "none: every step adds some" : "any";
  return fmt::format("{:.4g} s, {:.4g} of a wave's time; a run's step is {:.3g} of it", *step,
                     *step / findings.step.by_wave, findings.dt / *step);
}

std::string spectrum_text(const StabilityFindings& findings, const Spectrum& spectrum) {
  std::string text =
      line("fastest field", fmt::format("{:.4g} 1/s, of {} eigenvalues", spectral_radius(spectrum),
                                        spectrum.eigenvalues.size()));
  text += line("growth at any step",
               spectrum.grows
                   ? fmt::format("{:.3g} 1/s: the operators feed a field, {:.2g} of it in a run's step",
                                 spectrum.growth_rate, std::expm1(spectrum.growth_rate * findings.dt))
                   : "none");
  return text + line(spectrum.grows ? "step that adds up to a tenth" : "largest stable step",
                     largest_step_text(findings, spectrum.largest_step));
}

/// The part of the method's region that the eigenvalues lie in: dissipation keeps them near the imaginary
/// axis.
post::Chart chart_at(const std::string& title, const StabilityFindings& findings, const Spectrum& spectrum,
                     double dt) {
  constexpr std::size_t points = 4000;
  std::vector<solver::Complex> region =
      is_heun(findings) ? solver::heun_region(points) : solver::verlet_region(points);
  double leftmost = 0;
  for (const auto& lambda : spectrum.eigenvalues)
    leftmost = std::min(leftmost, dt * lambda.real());
  if (!is_heun(findings)) // pairs that do not swing: the faster one down to -2 where the other is slow
    region.emplace_back(-2);
  std::erase_if(region, [&](solver::Complex z) { return z.real() < 1.3 * leftmost - 1e-9; });
  if (region.back().real() < region.front().real()) // from the left, so that the cut edge stays open
    std::reverse(region.begin(), region.end());
  post::Chart chart{title, "Real part", "Imaginary part", false, false, {}};
  chart.curves.push_back(closed_curve(is_heun(findings) ? "Heun: |z| = 1" : "Verlet's bound", region, true));
  chart.curves.push_back(dots("eigenvalues", spectrum.eigenvalues, dt));
  return chart;
}

} // namespace

std::string stability_text(const Case& the_case, const Vec3& stretch, const StabilityFindings& findings) {
  std::string text = fmt::format(
      "{}: {} particles with {:.1f} neighbours, {}, scheme {}, dissipation {}, {}{}\n", the_case.title,
      findings.particles, findings.neighbours_mean, findings.formulation, findings.scheme,
      findings.dissipation, is_heun(findings) ? "Heun's method" : "Verlet's method",
      stretch == Vec3::Ones()
          ? std::string(", undeformed")
          : fmt::format(", stretched to {:g}, {:g}, {:g}", stretch[0], stretch[1], stretch[2]));
  text += line("a wave's time",
               fmt::format("{:.4g} s, over the smallest particle distance", findings.step.by_wave));
  text += line("a run's step", fmt::format("{:.4g} s, {:.3g} of a wave's time, bound by the {}", findings.dt,
                                           findings.dt / findings.step.by_wave,
                                           findings.step.bound == "wave" ? "wave" : "critical step"));
  text += line("critical step", fmt::format("{:.4g} s, by power iteration{}", findings.step.critical,
                                            is_heun(findings) ? ": of the roughest fields alone" : ""));
  if (findings.spectrum)
    text += spectrum_text(findings, *findings.spectrum);
  else
    text += line("eigenvalues", fmt::format("left out: {} unknowns are more than {}", findings.unknowns,
                                            solver::largest_matrix));
  return text;
}

std::string stability_json(const Case& the_case, const Vec3& stretch, const StabilityFindings& findings) {
  Json json = {{"case", the_case.path.string()},
               {"title", the_case.title},
               {"formulation", findings.formulation},
               {"scheme", findings.scheme},
               {"dissipation", findings.dissipation},
               {"integrator", findings.integrator},
               {"stretch", {stretch[0], stretch[1], stretch[2]}},
               {"particles", findings.particles},
               {"neighbours_mean", findings.neighbours_mean},
               {"unknowns", findings.unknowns},
               {"dt", findings.dt},
               {"dt_by_wave", findings.step.by_wave},
               {"dt_critical", findings.step.critical},
               {"bound", findings.step.bound},
               {"spectrum", nullptr}};
  if (const auto& spectrum = findings.spectrum) {
    const auto step = spectrum->largest_step;
    json["spectrum"] = {{"eigenvalues", spectrum->eigenvalues.size()},
                        {"radius_per_s", spectral_radius(*spectrum)},
                        {"growth_rate_per_s", spectrum->growth_rate},
                        {"grows", spectrum->grows},
                        {"largest_step", step && std::isfinite(*step) ? Json(*step) : Json()},
                        {"tolerated_growth", solver::tolerated_growth}};
  }
  return json.dump(1) + "\n";
}

std::string eigenvalues_csv(const Spectrum& spectrum) {
  std::string text = "real_per_s,imaginary_per_s\n";
  for (const auto& lambda : spectrum.eigenvalues)
    text += fmt::format("{:.9g},{:.9g}\n", lambda.real(), lambda.imag());
  return text;
}

post::Plot eigenvalue_plot(const StabilityFindings& findings, const Spectrum& spectrum,
                           const std::filesystem::path& file) {
  post::Plot plot;
  plot.file = std::filesystem::absolute(file).string();
  plot.charts = {chart_at("Eigenvalues times a run's step", findings, spectrum, findings.dt)};
  if (spectrum.largest_step && *spectrum.largest_step > 0 && std::isfinite(*spectrum.largest_step))
    plot.charts.push_back(chart_at(spectrum.grows
                                       ? "Eigenvalues times the step that adds up to a tenth to the growth"
                                       : "Eigenvalues times the largest stable step",
                                   findings, spectrum, *spectrum.largest_step));
  return plot;
}

} // namespace tessera::app
