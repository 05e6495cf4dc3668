#include "solver/scene/forecast_definition.hpp"
#include "solver/scene/run_formulation_definition.hpp"
#include "solver/scene/stability_definition.hpp"

namespace tessera::solver {

template Summary run_formulation<Displacement<2>>(const SceneSpec&, const ParticleCloud&, const Outputs&,
                                                  Progress&);
template Summary run_formulation<Displacement<3>>(const SceneSpec&, const ParticleCloud&, const Outputs&,
                                                  Progress&);
template Forecast forecast_formulation<Displacement<2>>(const SceneSpec&, const ParticleCloud&,
                                                        const Outputs&);
template Forecast forecast_formulation<Displacement<3>>(const SceneSpec&, const ParticleCloud&,
                                                        const Outputs&);
template StabilityFindings stability_formulation<Displacement<2>>(const SceneSpec&, const ParticleCloud&,
                                                                  const Vec3&);
template StabilityFindings stability_formulation<Displacement<3>>(const SceneSpec&, const ParticleCloud&,
                                                                  const Vec3&);

} // namespace tessera::solver
