#include "solver/physics/materials/saint_venant_kirchhoff.hpp"
#include "solver/scene/run_law_definition.hpp"

namespace tessera::solver {

template Summary run_law(const SaintVenantKirchhoff&, const SceneSpec&, const ParticleCloud&, const Outputs&,
                         Progress&);
template Forecast forecast_law(const SaintVenantKirchhoff&, const SceneSpec&, const ParticleCloud&);

} // namespace tessera::solver
