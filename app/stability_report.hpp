/// How long a step a case's body bears, for people and programs.
#pragma once

#include "app/case/case.hpp"
#include "postprocess/render_job.hpp"
#include "solver/scene/stability.hpp"

#include <filesystem>
#include <string>

namespace tessera::app {

std::string stability_text(const Case& the_case, const Vec3& stretch,
                           const solver::StabilityFindings& findings);
std::string stability_json(const Case& the_case, const Vec3& stretch,
                           const solver::StabilityFindings& findings);

/// real_per_s, imaginary_per_s: a line an eigenvalue.
std::string eigenvalues_csv(const solver::Spectrum& spectrum);

/// The eigenvalues times a run's step and times the largest stable one, in the method's region.
post::Plot eigenvalue_plot(const solver::StabilityFindings& findings, const solver::Spectrum& spectrum,
                           const std::filesystem::path& file);

} // namespace tessera::app
