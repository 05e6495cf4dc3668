#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/stages.hpp"
#include "app/summary.hpp"
#include "core/interrupt.hpp"

namespace tessera::app {

void check(const Options& options) {
  Console console(options);
  const Case the_case = read_case(options.case_file, options.overrides);
  require_cad_file(the_case);
  const preprocess::Domain domain = preprocess::import_geometry(the_case.geometry, console.progress());
  stop_if_interrupted("import");
  const preprocess::Prepared prepared = preprocess::prepare(domain, the_case.particles, console.progress());
  require_places(the_case, prepared.cloud);
  stop_if_interrupted("preparation");

  Outlook outlook;
  outlook.lower = domain.lower;
  outlook.upper = domain.upper;
  outlook.quality = prepared.quality;
  outlook.spacing = prepared.cloud.spacing;
  for (const ParticleSet& set : prepared.cloud.sets)
    outlook.sets.push_back(set.name);
  if (the_case.has_scene)
    outlook.forecast = solver::forecast(scene_with_surfaces(the_case, console), prepared.cloud);
  console.answer(outlook_text(the_case, outlook), outlook_json(the_case, outlook));
}

} // namespace tessera::app
