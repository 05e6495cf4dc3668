#include "preprocess/cloud/surface_members.hpp"

#include "core/point_grid.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tessera::preprocess {
namespace {

/// A surface's members by distance.
class NearMembers {
 public:
  struct Member {
    std::int32_t particle;
    double distance; ///< m
    double weight = 0;
  };

  NearMembers(const ParticleCloud& cloud, const std::vector<std::int32_t>& members)
      : members_(members), X_(positions(cloud, members)), spacing_(cloud.spacing), grid_(X_, spacing_) {}

  /// So many of them, nearest first, or all.
  std::vector<Member> nearest(const Vec3& x, std::size_t count) const {
    count = std::min(count, members_.size());
    for (double radius = 2 * spacing_;; radius *= 1.5) {
      std::vector<Member> near;
      grid_.near(x, radius, [&](std::int32_t k, double distance) {
        if (distance <= radius)
          near.push_back({members_[k], distance});
      });
      if (near.size() < count)
        continue;
      std::sort(near.begin(), near.end(), [](const Member& a, const Member& b) {
        return std::pair(a.distance, a.particle) < std::pair(b.distance, b.particle);
      });
      near.resize(count);
      return near;
    }
  }

 private:
  static std::vector<Vec3> positions(const ParticleCloud& cloud, const std::vector<std::int32_t>& members) {
    std::vector<Vec3> X;
    for (const std::int32_t b : members)
      X.push_back(cloud.X[b]);
    return X;
  }

  const std::vector<std::int32_t>& members_;
  std::vector<Vec3> X_;
  double spacing_;
  PointGrid grid_;
};

/// Joins a share of a surface to the one a particle has of it.
void add_to(std::vector<SurfaceShare>& own, const SurfaceShare& share) {
  const auto at =
      std::lower_bound(own.begin(), own.end(), share.surface,
                       [](const SurfaceShare& one, std::int32_t surface) { return one.surface < surface; });
  if (at != own.end() && at->surface == share.surface)
    at->area += share.area;
  else
    own.insert(at, share);
}

/// What a particle beside a surface owns of it, m^2.
struct Stray {
  std::int32_t particle;
  Vec3 area;
};

} // namespace

std::vector<std::vector<std::int32_t>> surface_members(const Domain& domain, const CadTopology& cad,
                                                       const std::vector<CadPlace>& place,
                                                       const Shares& shares, bool owners_belong,
                                                       double least) {
  std::vector<std::vector<std::int32_t>> lying(domain.surfaces.size()), owning(domain.surfaces.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    for (const std::int32_t s : cad.surfaces_of(place[i]))
      lying[s].push_back(static_cast<std::int32_t>(i));
    for (const SurfaceShare& share : shares[i])
      if (share.area.norm() > least)
        owning[share.surface].push_back(static_cast<std::int32_t>(i));
  }
  for (std::size_t s = 0; s < lying.size(); ++s) {
    if (!owners_belong && !lying[s].empty())
      continue;
    std::vector<std::int32_t> all;
    std::set_union(lying[s].begin(), lying[s].end(), owning[s].begin(), owning[s].end(),
                   std::back_inserter(all));
    lying[s] = std::move(all);
  }
  return lying;
}

void gather_on_members(const ParticleCloud& cloud, const std::vector<std::vector<std::int32_t>>& members,
                       Shares& shares) {
  Shares gathered(shares.size());
  std::vector<std::vector<Stray>> strays(members.size());
  for (std::int32_t i = 0; i < cloud.size(); ++i)
    for (const SurfaceShare& share : shares[i]) {
      const auto& among = members[share.surface];
      if (among.empty() || std::binary_search(among.begin(), among.end(), i))
        gathered[i].push_back(share);
      else
        strays[share.surface].push_back({i, share.area});
    }

  const std::size_t several = cloud.dimension == 3 ? 10 : 4;
  for (std::size_t s = 0; s < members.size(); ++s) {
    if (strays[s].empty())
      continue;
    const NearMembers receivers(cloud, members[s]);
    for (const Stray& stray : strays[s]) {
      std::vector<NearMembers::Member> near = receivers.nearest(cloud.X[stray.particle], several + 1);
      const double reach = near.back().distance * (1 + 1e-9); // so that one alone has a weight
      double total = 0;
      for (NearMembers::Member& member : near)
        total += member.weight = cloud.V[member.particle] * (1 - member.distance / reach);
      for (const NearMembers::Member& member : near)
        add_to(gathered[member.particle], {static_cast<std::int32_t>(s), member.weight / total * stray.area});
    }
  }
  shares = std::move(gathered);
}

} // namespace tessera::preprocess
