/// The part of a case that sets a body in motion: [[initial]], [[boundary]] and the [exact] solution of it.
#pragma once

#include "app/case/table.hpp"
#include "solver/scene/scene.hpp"

namespace tessera::app {

solver::InitialCondition read_initial(Table initial);

solver::BoundaryCondition read_boundary(Table boundary);

solver::ExactSolution read_exact(Table exact);

} // namespace tessera::app
