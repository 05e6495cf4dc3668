/// The columns every history has, before those of a scene's probes; names end in their units.
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
// clang-format on

} // namespace tessera
