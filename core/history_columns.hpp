/// The columns every history has, before those of a scene's walls, supports and probes; names end in their
/// units.
#pragma once

#include <array>
#include <string_view>

namespace tessera {

// clang-format off
inline constexpr std::array<std::string_view, 16> history_columns = {
    "time_s", "step", "dt_s",
    "kinetic_J", "internal_J", "plastic_J", "dissipated_J", "external_J", "total_J", "balance_error",
    "linear_momentum_x_kgm_s", "linear_momentum_y_kgm_s", "linear_momentum_z_kgm_s",
    "angular_momentum_x_kgm2_s", "angular_momentum_y_kgm2_s", "angular_momentum_z_kgm2_s"};

/// Of each wall and each support (a set that a boundary holds), after its name.
inline constexpr std::array<std::string_view, 5> wall_columns = {
    "_force_x_N", "_force_y_N", "_force_z_N", "_friction_N", "_pressure_Pa"};
inline constexpr std::array<std::string_view, 3> reaction_columns = {
    "_reaction_x_N", "_reaction_y_N", "_reaction_z_N"};
// clang-format on

} // namespace tessera
