#include "postprocess/point_data.hpp"

#include "postprocess/csv.hpp"
#include "postprocess/quantity.hpp"

#include <fmt/format.h>

namespace tessera::post {

std::string point_data_csv(const Snapshot& snapshot) {
  const ParticleCloud& cloud = snapshot.cloud;
  std::vector<std::string> cells{"reference_x_m",
                                 "reference_y_m",
                                 "reference_z_m",
                                 "x_m",
                                 "y_m",
                                 "z_m",
                                 cloud.dimension == 2 ? "volume_m2" : "volume_m3"};
  for (const io::StoredField& field : snapshot.frame.fields) {
    const auto& parts = component_names(field.components);
    for (std::size_t c = 0; c < static_cast<std::size_t>(field.components); ++c)
      cells.push_back(field_column(field.components == 1 ? field.name
                                   : parts.empty()       ? fmt::format("{}.{}", field.name, c + 1)
                                                         : field.name + "." + parts[c]));
  }
  std::string text = csv_line(cells);
  for (std::size_t a = 0; a < cloud.X.size(); ++a) {
    cells.clear();
    for (const Vec3& place : {cloud.X[a], snapshot.frame.x[a]})
      for (int c = 0; c < 3; ++c)
        cells.push_back(csv_number(place[c]));
    cells.push_back(csv_number(cloud.V[a]));
    for (const io::StoredField& field : snapshot.frame.fields) {
      const auto components = static_cast<std::size_t>(field.components);
      for (std::size_t c = 0; c < components; ++c)
        cells.push_back(csv_number(field.values[a * components + c]));
    }
    text += csv_line(cells);
  }
  return text;
}

} // namespace tessera::post
