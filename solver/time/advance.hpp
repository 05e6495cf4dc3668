/// One field, or all fields of a formulation, along their rates.
#pragma once

#include "core/parallel.hpp"

#include <tuple>
#include <utility>
#include <vector>

namespace tessera::solver {

/// u <- u + dt r.
template <class T>
void advance(std::vector<T>& u, double dt, const std::vector<T>& r) {
  for_each(static_cast<std::int64_t>(u.size()), [&](std::int64_t a) { u[a] += dt * r[a]; });
}

/// u <- (u^n + u + dt r) / 2: what ends a step of Heun's method, (3.99).
template <class T>
void average(std::vector<T>& u, const std::vector<T>& u_n, double dt, const std::vector<T>& r) {
  for_each(static_cast<std::int64_t>(u.size()),
           [&](std::int64_t a) { u[a] = 0.5 * (u_n[a] + u[a] + dt * r[a]); });
}

/// Calls use(u, others...) for each field of a tuple of them and its namesakes in other tuples.
template <class Use, class Fields, class... Others>
void for_each_field(Use&& use, Fields fields, Others... others) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    const auto one = [&](auto index) { use(std::get<index>(fields), std::get<index>(others)...); };
    (one(std::integral_constant<std::size_t, i>{}), ...);
    static_cast<void>(one); // displacements have no strain fields
  }
  (std::make_index_sequence<std::tuple_size_v<Fields>>{});
}

/// Every field of a formulation.
template <class Formulation>
void advance(Formulation& U, double dt, const Formulation& R) {
  advance(U.x, dt, R.x);
  advance(U.p, dt, R.p);
  for_each_field([&](auto& u, const auto& r) { advance(u, dt, r); }, U.strains(), R.strains());
}

/// The strains of a formulation.
template <class Formulation>
void average_strains(Formulation& U, const Formulation& U_n, double dt, const Formulation& R) {
  for_each_field([&](auto& u, const auto& u_n, const auto& r) { average(u, u_n, dt, r); }, U.strains(),
                 U_n.strains(), R.strains());
}

} // namespace tessera::solver
