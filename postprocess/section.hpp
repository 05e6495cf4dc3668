/// Sections: fields of runs along a straight line through the body.
#pragma once

#include "postprocess/render_job.hpp"
#include "postprocess/snapshot.hpp"

#include <string>
#include <vector>

namespace tessera::post {

struct Section {
  Vec3 from, to;         ///< m
  bool in_space = false; ///< given with z
};

/// "x0,y0,z0:x1,y1,z1", or without z in the plane. InputError saying how it is written.
Section section_from(const std::string& text);

/// What a section shows.
struct SectionCurves {
  struct Curve {
    std::string field;
    std::size_t run;
    std::vector<double> values; ///< SI, magnitudes of vectors; NaN where the point lies outside this body
  };
  std::vector<Vec3> points;     ///< m
  std::vector<double> distance; ///< from the first, m
  std::vector<Curve> curves;    ///< all runs of a field, then the next field
};

/// The fields of each run at `samples` >= 2 points, evenly from end to end. InputError where a run has no
/// such field and where no point lies inside any of the bodies.
SectionCurves cut(const Section& section, const std::vector<Snapshot>& runs,
                  const std::vector<std::string>& fields, Configuration configuration, int samples = 201);

/// One chart a field, one curve a run that the section meets, `names` beside them.
std::vector<Chart> charts_of(const SectionCurves& curves, const std::vector<std::string>& names,
                             const std::string& title);

/// Distance, place, and a column a curve: "PlasticStrain lattice". Empty where a run's body is not.
std::string csv_text(const SectionCurves& curves, const std::vector<std::string>& names);

} // namespace tessera::post
