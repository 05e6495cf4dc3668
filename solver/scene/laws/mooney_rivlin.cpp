#include "solver/physics/materials/mooney_rivlin.hpp"
#include "solver/scene/run_law_definition.hpp"

namespace tessera::solver {

template Summary run_law(const MooneyRivlin&, const SceneSpec&, const ParticleCloud&, const Outputs&,
                         Progress&);
template Forecast forecast_law(const MooneyRivlin&, const SceneSpec&, const ParticleCloud&);

} // namespace tessera::solver
