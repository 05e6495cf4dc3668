#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/outlook.hpp"
#include "app/stages.hpp"
#include "core/interrupt.hpp"
#include "core/temporary_folder.hpp"
#include "io/field_series.hpp"

namespace tessera::app {
namespace {

/// Frames are written to a folder that is gone again, to see what they cost.
solver::Forecast forecast_with_frames(const solver::SceneSpec& scene, const ParticleCloud& cloud) {
  const TemporaryFolder nowhere;
  io::FrameSeries series(nowhere.path());
  solver::Outputs outputs;
  outputs.frame = [&](const Frame& frame) { series.write(frame); };
  return solver::forecast(scene, cloud, outputs);
}

} // namespace

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
  if (the_case.has_scene) {
    const solver::SceneSpec scene = scene_with_surfaces(the_case, console);
    outlook.setup_seconds = spent_so_far();
    outlook.forecast = forecast_with_frames(scene, prepared.cloud);
    outlook.setup_seconds += outlook.forecast->setup_seconds;
    outlook.rehearsal =
        rehearse(the_case, scene, domain, prepared.cloud, *outlook.forecast, console.progress());
  }
  console.answer(outlook_text(the_case, outlook, options.explain),
                 outlook_json(the_case, outlook, options.explain));
}

} // namespace tessera::app
