#include "app/case/read_cloud.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;
using preprocess::ShapeKind;

constexpr Range memory_size{[](double x) { return x > 0 && x <= 1e6; },
                            "greater than 0 and at most 1e6 (GiB)"};

constexpr Range jitter_range{[](double x) { return x >= 0 && x <= 0.45; }, "from 0 to 0.45 (spacings)"};

/// geometry.shape and the lengths that go with it.
preprocess::ShapeSpec read_shape(Table& geometry, int dimension) {
  std::vector<std::string> names;
  for (const ShapeKind& kind : preprocess::known_shapes())
    if (kind.dimension == dimension)
      names.push_back(kind.name);
  preprocess::ShapeSpec shape{geometry.choice("shape", names), {}};
  for (const ShapeKind& kind : preprocess::known_shapes()) {
    if (kind.dimension != dimension || kind.name != shape.name)
      continue;
    for (const ShapeKind::Length& length : kind.lengths)
      if (length.components == 1)
        shape.lengths.push_back({geometry.number(length.name, positive)});
      else
        shape.lengths.push_back(geometry.numbers(length.name, length.components, positive));
  }
  return shape;
}

preprocess::Refinement read_refinement(Table table) {
  preprocess::Refinement refinement;
  const bool by_name = table.is_text("around");
  if (by_name)
    refinement.around = table.text("around");
  else
    refinement.around = table.vector("around");
  refinement.factor = table.number("factor", positive);
  refinement.within = table.number_or("within", 0, not_negative);
  refinement.until = table.number("until", positive);
  table.finish();
  if (refinement.factor > 1)
    table.refuse("factor", "a refinement's factor is above 1",
                 "it multiplies the spacing: state the coarse spacing and refine from there");
  if (refinement.until <= refinement.within)
    table.refuse("until", "a refinement ends before it begins", "choose until above within (metres)");
  return refinement;
}

} // namespace

preprocess::GeometrySource read_geometry(Table geometry, const fs::path& case_folder) {
  preprocess::GeometrySource source;
  source.dimension = static_cast<int>(geometry.integer_or("dimension", 3, 2, 3));
  fs::path file;
  std::string unit;
  if (geometry.has("shape")) {
    source.shape = read_shape(geometry, source.dimension);
  } else {
    file = geometry.text("file");
    unit = geometry.text("unit");
    source.trust = geometry.boolean_or("trust", source.trust);
    source.solid = static_cast<int>(geometry.integer_or("solid", 0, 1, 1'000'000));
    source.close_holes = static_cast<int>(geometry.integer_or("close_holes", 0, 0, 1000));
  }
  source.tolerance = geometry.number_or("tolerance", source.tolerance, positive);
  source.mesh_size = geometry.number_or("mesh_size", source.mesh_size, positive);
  source.seconds = geometry.number_or("time_limit", source.seconds, positive);
  source.bytes = static_cast<std::uint64_t>(geometry.number_or("memory_limit", 4, memory_size) * 0x1p30);
  if (geometry.has("shape") && geometry.has("file"))
    geometry.refuse("shape", fmt::format("{} has both file and shape", geometry.path()), "give one of them");
  if (geometry.has("shape") && geometry.has("unit"))
    geometry.refuse(
        "unit",
        fmt::format("{} stands beside a shape, whose lengths are in metres", geometry.path_of("unit")),
        "leave it out, and give the lengths in metres");
  geometry.finish();
  if (source.shape)
    return source;

  if (file.empty())
    geometry.refuse("file", fmt::format("{} is empty", geometry.path_of("file")), "name a CAD or mesh file");
  try {
    preprocess::metres_per_unit(unit);
  } catch (const InputError& e) {
    geometry.refuse("unit", fmt::format("{}: {}", geometry.path_of("unit"), e.what()), "");
  }
  source.unit = unit;
  // A path typed on the command line is relative to where it was typed, one in the case to the case.
  const bool typed = geometry.is_overridden("file");
  source.file = fs::weakly_canonical(fs::absolute(typed ? file : case_folder / file));
  return source;
}

preprocess::ParticleRequest read_particles(Table particles, int dimension) {
  using preprocess::Arrangement, preprocess::Backend, preprocess::LatticeKind, preprocess::Subvolumes;
  preprocess::ParticleRequest request;
  const std::string arrangement = particles.choice("arrangement", {"lattice", "voronoi", "poisson"});
  request.arrangement = arrangement == "lattice"   ? Arrangement::lattice
                        : arrangement == "voronoi" ? Arrangement::voronoi
                                                   : Arrangement::poisson;
  request.subvolumes = particles.choice_or("subvolumes", "voronoi", {"voronoi", "uniform"}) == "uniform"
                           ? Subvolumes::uniform
                           : Subvolumes::voronoi;
  request.spacing = particles.number_or("spacing", 0, positive);
  request.count = particles.integer_or("count", 0, 1, 1'000'000'000);
  request.backend = particles.choice_or("backend", "clipper", {"clipper", "voro"}) == "voro"
                        ? Backend::voro
                        : Backend::clipper;
  const std::string kind =
      particles.choice_or("lattice", "cubic",
                          dimension == 2 ? std::vector<std::string>{"cubic", "hexagonal"}
                                         : std::vector<std::string>{"cubic", "body_centred", "hexagonal"});
  request.lattice = kind == "cubic"          ? LatticeKind::cubic
                    : kind == "body_centred" ? LatticeKind::body_centred
                                             : LatticeKind::hexagonal;
  request.sight = particles.number_or("sight", request.sight, positive);
  request.seed = static_cast<std::uint64_t>(particles.integer_or("seed", 1, 0, std::int64_t{1} << 53));
  request.jitter = particles.number_or("jitter", request.jitter, jitter_range);
  request.merge = particles.number_or("merge", request.merge, zero_to_one);
  request.relax = static_cast<int>(particles.integer_or("relax", 0, 0, 10'000));
  request.relax_seeds = static_cast<int>(particles.integer_or("relax_seeds", 0, 0, 10'000));
  request.sizes_from_mesh = particles.boolean_or("sizes_from_mesh", false);
  for (const Table& entry : particles.tables("refine"))
    request.refine.push_back(read_refinement(entry));
  particles.finish();

  if (particles.has("spacing") && particles.has("count"))
    particles.refuse("count", "particles has both spacing and count", "give one of them");
  // What shapes the cloud must not be ignored in silence where the arrangement has no use for it.
  const auto only_for = [&](const char* key, bool asked, bool serves, const char* arrangements) {
    if (asked && !serves)
      particles.refuse(key, fmt::format("particles.{} does nothing to a {} cloud", key, arrangement),
                       fmt::format("it is for {}: remove it or change the arrangement", arrangements));
  };
  const bool lattice = request.arrangement == Arrangement::lattice;
  only_for("lattice", request.lattice != LatticeKind::cubic, lattice, "lattices");
  only_for("jitter", request.jitter > 0, lattice, "lattices");
  only_for("relax", request.relax > 0, !lattice, "irregular clouds");
  only_for("relax_seeds", request.relax_seeds > 0, request.arrangement == Arrangement::voronoi,
           "voronoi clouds");
  only_for("sizes_from_mesh", request.sizes_from_mesh, !lattice, "irregular clouds");
  only_for("refine", !request.refine.empty(), !lattice, "irregular clouds");
  if (!particles.has("spacing") && !particles.has("count"))
    throw InputError("particles has neither spacing nor count", particles.where(),
                     "add spacing = (metres) or count = (particles wanted)");
  return request;
}

preprocess::SetSelector read_set(Table set, const std::vector<preprocess::SetSelector>& earlier) {
  preprocess::SetSelector selector;
  selector.name = set.name("name");
  selector.tolerance = set.number_or("tolerance", 0, not_negative);
  int ways = 0;
  if (auto plane = set.optional_table("plane")) {
    preprocess::PlaneSelector where{plane->vector("point"), plane->vector("normal")};
    plane->finish();
    if (where.normal.isZero())
      plane->refuse("normal", "the plane's normal is zero", "give it a direction");
    selector.where = where;
    ++ways;
  }
  if (auto box = set.optional_table("box")) {
    preprocess::BoxSelector where{box->vector("lower"), box->vector("upper")};
    box->finish();
    if ((where.lower.array() > where.upper.array()).any())
      box->refuse("lower", "a lower corner of the box lies above its upper one", "exchange them");
    selector.where = where;
    ++ways;
  }
  if (const auto point = set.optional_vector("nearest")) {
    selector.where = preprocess::NearestSelector{*point};
    ++ways;
  }
  set.finish();

  if (ways != 1)
    set.refuse("name", fmt::format("set '{}' has {} selectors", selector.name, ways),
               "give exactly one of plane, box and nearest");
  if (selector.name == "all")
    set.refuse("name", "a set may not be called 'all'", "that name means every particle");
  for (const auto& other : earlier)
    if (other.name == selector.name)
      set.refuse("name", fmt::format("two sets are called '{}'", selector.name), "give each its own name");
  return selector;
}

} // namespace tessera::app
