#include "solver/physics/plasticity/von_mises.hpp"
#include "solver/physics/plasticity/hardening.hpp"
#include "solver/scene/run_law_definition.hpp"

namespace tessera::solver {

template Summary run_law(const VonMises<LinearHardening>&, const SceneSpec&, const ParticleCloud&,
                         const Outputs&, Progress&);
template Forecast forecast_law(const VonMises<LinearHardening>&, const SceneSpec&, const ParticleCloud&);
template Summary run_law(const VonMises<PowerHardening>&, const SceneSpec&, const ParticleCloud&,
                         const Outputs&, Progress&);
template Forecast forecast_law(const VonMises<PowerHardening>&, const SceneSpec&, const ParticleCloud&);

} // namespace tessera::solver
