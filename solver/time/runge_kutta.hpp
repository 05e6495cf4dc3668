/// Heun's two-stage TVD Runge-Kutta method on the fields of a formulation, (3.99).
#pragma once

#include "core/parallel.hpp"

#include <tuple>
#include <utility>
#include <vector>

namespace tessera::solver {

/// u <- u + dt r: the first stage, U* = U^n + dt R(U^n).
template <class T>
void advance(std::vector<T>& u, double dt, const std::vector<T>& r) {
  for_each(static_cast<std::int64_t>(u.size()), [&](std::int64_t a) { u[a] += dt * r[a]; });
}

/// u <- (u^n + u + dt r) / 2: the second stage and the average, U^(n+1) = (U^n + U* + dt R(U*)) / 2.
template <class T>
void average(std::vector<T>& u, const std::vector<T>& u_n, double dt, const std::vector<T>& r) {
  for_each(static_cast<std::int64_t>(u.size()),
           [&](std::int64_t a) { u[a] = 0.5 * (u_n[a] + u[a] + dt * r[a]); });
}

/// The first stage for every field of a formulation.
template <class Formulation>
void advance(Formulation& U, double dt, const Formulation& R) {
  const auto each = [&]<std::size_t... i>(std::index_sequence<i...>) {
    (advance(std::get<i>(U.fields()), dt, std::get<i>(R.fields())), ...);
  };
  each(std::make_index_sequence<std::tuple_size_v<decltype(U.fields())>>{});
}

} // namespace tessera::solver
