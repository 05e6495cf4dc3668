#include "preprocess/cloud/quality.hpp"

#include "core/neighbours.hpp"
#include "core/parallel.hpp"
#include "preprocess/cloud/assess.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace tessera::preprocess {

void assess_cells(const Domain& domain, const ParticleCloud& cloud, Quality& quality) {
  const std::int64_t n = cloud.size();
  quality.particles = n;
  quality.dimension = cloud.dimension;
  quality.domain_volume = domain.volume;
  quality.cad_volume = domain.cad_volume;
  quality.seed = cloud.seed;

  quality.volume_sum = sum(n, 0.0, [&](std::int64_t i) { return cloud.V[i]; });
  quality.volume_error = std::abs(quality.volume_sum - domain.volume) / domain.volume;
  const double mean = quality.volume_sum / static_cast<double>(n);
  quality.volume_min = min_of(n, cloud.V[0], [&](std::int64_t i) { return cloud.V[i]; }) / mean;
  quality.volume_max = max_of(n, cloud.V[0], [&](std::int64_t i) { return cloud.V[i]; }) / mean;

  const Vec3 open = sum(n, Vec3(Vec3::Zero()), [&](std::int64_t i) { return cloud.A[i]; });
  const double area = sum(n, 0.0, [&](std::int64_t i) { return cloud.A[i].norm(); });
  quality.area_sum = area > 0 ? open.norm() / area : 0;

  // About the middle of the body, so that a distant origin costs no digits.
  const Vec3 middle = (domain.lower + domain.upper) / 2;
  const Vec3 cells = sum(n, Vec3(Vec3::Zero()),
                         [&](std::int64_t i) -> Vec3 { return cloud.V[i] * (cloud.centroid[i] - middle); });
  const Vec3 body =
      sum(static_cast<std::int64_t>(domain.tets.size()), Vec3(Vec3::Zero()), [&](std::int64_t t) -> Vec3 {
        Vec3 centroid = -middle;
        for (const std::int32_t v : domain.tets[t])
          centroid += domain.vertices[v] / 4;
        if (domain.dimension == 2)
          centroid[2] = 0;
        return domain.tet_volume(t) * centroid;
      });
  quality.first_moment_error = (cells - body).norm() / (domain.volume * (domain.upper - domain.lower).norm());
}

void assess_spacing(const ParticleCloud& cloud, double h, Quality& quality) {
  const std::vector<double> nearest = distance_to_nearest(cloud.X, 1, cloud.hidden);
  const std::int64_t n = cloud.size();
  quality.spacing_min = min_of(n, nearest[0], [&](std::int64_t i) { return nearest[i]; });
  quality.spacing_mean = sum(n, 0.0, [&](std::int64_t i) { return nearest[i]; }) / static_cast<double>(n);
  quality.spacing_ratio = quality.spacing_mean > 0 ? quality.spacing_min / quality.spacing_mean : 0;
  quality.spacing_min_over_h = quality.spacing_min / h;
}

std::string to_json(const Quality& q) {
  nlohmann::ordered_json sets = nlohmann::ordered_json::object(), seconds = nlohmann::ordered_json::object();
  for (const auto& [name, count] : q.sets)
    sets[name] = count;
  for (const auto& [stage, time] : q.seconds)
    seconds[stage] = seconds.value(stage, 0.0) + time;
  const nlohmann::ordered_json json{{"particles", q.particles},
                                    {"dimension", q.dimension},
                                    {"domain_volume", q.domain_volume},
                                    {"cad_volume", q.cad_volume},
                                    {"volume_sum", q.volume_sum},
                                    {"volume_error", q.volume_error},
                                    {"area_sum", q.area_sum},
                                    {"area_correction", q.area_correction},
                                    {"area_imbalance", q.area_imbalance},
                                    {"first_moment_error", q.first_moment_error},
                                    {"closure_error", q.closure_error},
                                    {"spacing_min", q.spacing_min},
                                    {"spacing_mean", q.spacing_mean},
                                    {"spacing_ratio", q.spacing_ratio},
                                    {"spacing_min_over_h", q.spacing_min_over_h},
                                    {"volume_min", q.volume_min},
                                    {"volume_max", q.volume_max},
                                    {"corners", q.corners},
                                    {"corner_particles", q.corner_particles},
                                    {"sets", sets},
                                    {"seed", q.seed},
                                    {"disconnected_cells", q.disconnected_cells},
                                    {"inserted_particles", q.inserted_particles},
                                    {"stranded_volume", q.stranded_volume},
                                    {"hidden_pairs", q.hidden_pairs},
                                    {"seconds", seconds}};
  return json.dump(2) + "\n";
}

} // namespace tessera::preprocess
