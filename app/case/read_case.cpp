#include "app/case/case.hpp"
#include "app/case/table.hpp"
#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <sstream>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

preprocess::GeometrySource read_geometry(Table geometry, const fs::path& case_folder) {
  preprocess::GeometrySource source;
  const fs::path file = geometry.text("file");
  const std::string unit = geometry.text("unit");
  const std::int64_t dimension = geometry.integer_or("dimension", 3, 2, 3);
  source.trust = geometry.boolean_or("trust", source.trust);
  source.tolerance = geometry.number_or("tolerance", source.tolerance, positive);
  source.mesh_size = geometry.number_or("mesh_size", source.mesh_size, positive);
  geometry.finish();

  if (dimension != 3)
    geometry.refuse("dimension", "geometry.dimension is 2",
                    "plane strain is not offered by this version: use 3");
  if (file.empty())
    geometry.refuse("file", "geometry.file is empty", "name a CAD or mesh file");
  try {
    preprocess::metres_per_unit(unit);
  } catch (const InputError& e) {
    geometry.refuse("unit", fmt::format("geometry.unit: {}", e.what()), "");
  }
  source.unit = unit;
  // A path typed on the command line is relative to where it was typed, one in the case to the case.
  const bool typed = geometry.is_overridden("file");
  source.file = fs::weakly_canonical(fs::absolute(typed ? file : case_folder / file));
  return source;
}

preprocess::ParticleRequest read_particles(Table particles) {
  using preprocess::Arrangement, preprocess::Subvolumes;
  preprocess::ParticleRequest request;
  request.arrangement = particles.choice("arrangement", {"lattice", "voronoi"}) == "lattice"
                            ? Arrangement::lattice
                            : Arrangement::voronoi;
  request.subvolumes = particles.choice_or("subvolumes", "voronoi", {"voronoi", "uniform"}) == "uniform"
                           ? Subvolumes::uniform
                           : Subvolumes::voronoi;
  request.spacing = particles.number_or("spacing", 0, positive);
  request.count = particles.integer_or("count", 0, 1, 1'000'000'000);
  request.seed = static_cast<std::uint64_t>(particles.integer_or("seed", 1, 0, std::int64_t{1} << 53));
  request.merge = particles.number_or("merge", request.merge, zero_to_one);
  particles.finish();

  if (particles.has("spacing") && particles.has("count"))
    particles.refuse("count", "particles has both spacing and count", "give one of them");
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

solver::MaterialSpec read_material(Table material) {
  solver::MaterialSpec spec;
  spec.law = material.text("law");
  spec.density = material.number("density");
  spec.young = material.number("young");
  spec.poisson = material.number("poisson");
  if (auto plasticity = material.optional_table("plasticity")) {
    spec.plasticity = solver::PlasticitySpec{plasticity->number("yield"), plasticity->number("hardening")};
    plasticity->finish();
  }
  material.finish();
  return spec;
}

void read_solver(Table solver, solver::SceneSpec& scene) {
  scene.formulation = solver.text_or("formulation", scene.formulation);
  scene.scheme = solver.text_or("scheme", scene.scheme);
  scene.kernel = solver.text_or("kernel", scene.kernel);
  scene.support = solver.optional_number("support");
  scene.neighbours = static_cast<int>(solver.integer_or("neighbours", scene.neighbours, 1, 1000));
  scene.jst4 = solver.number_or("jst4", scene.jst4);
  scene.cfl = solver.number_or("cfl", scene.cfl);
  scene.momentum_projection = solver.boolean_or("momentum_projection", scene.momentum_projection);
  scene.end_time = solver.number("end_time");
  solver.finish();
}

/// v = omega x (X - centre) as formulas.
std::array<std::string, 3> spin_formulas(const Vec3& omega, const Vec3& centre) {
  const char* const name[] = {"X", "Y", "Z"};
  std::array<std::string, 3> formulas;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    formulas[static_cast<std::size_t>(i)] = fmt::format("({})*({}-({}))-({})*({}-({}))", omega[j], name[k],
                                                        centre[k], omega[k], name[j], centre[j]);
  }
  return formulas;
}

solver::Expression parse_formula(const Table& initial, std::size_t component, const std::string& formula) {
  try {
    return solver::Expression(formula);
  } catch (const InputError& e) {
    initial.refuse(fmt::format("velocity.{}", component),
                   fmt::format("{}: {}", initial.path_of("velocity"), e.what()),
                   "a formula may use X, Y, Z (metres), _pi, _e and functions such as sin, sqrt");
  }
}

solver::InitialVelocity read_initial(Table initial) {
  const std::string on = initial.text_or("on", "all");
  auto formulas = initial.optional_formulas("velocity");
  auto spin = initial.optional_table("spin");
  Vec3 omega = Vec3::Zero(), centre = Vec3::Zero();
  if (spin) {
    omega = spin->vector("omega");
    centre = spin->vector("centre");
    spin->finish();
  }
  initial.finish();
  if (formulas.has_value() == spin.has_value())
    throw InputError(
        fmt::format("an [[initial]] entry has {}", spin ? "both velocity and spin" : "no velocity"),
        initial.where(), "give exactly one of velocity = [..] and spin = {omega = [..], centre = [..]}");
  if (spin)
    formulas = spin_formulas(omega, centre);
  return {on,
          {parse_formula(initial, 0, (*formulas)[0]), parse_formula(initial, 1, (*formulas)[1]),
           parse_formula(initial, 2, (*formulas)[2])}};
}

solver::FixedCondition read_boundary(Table boundary) {
  solver::FixedCondition condition;
  condition.on = boundary.text("on");
  if (boundary.choice("type", {"clamped", "fixed"}) == "fixed") {
    const std::vector<std::string> components = boundary.choices("components", {"x", "y", "z"});
    for (std::size_t i = 0; i < 3; ++i)
      condition.component[i] =
          std::find(components.begin(), components.end(), std::string(1, "xyz"[i])) != components.end();
  }
  boundary.finish();
  return condition;
}

solver::PlaneWall read_wall(Table table) {
  solver::PlaneWall wall;
  Table plane = table.table("plane");
  wall.point = plane.vector("point");
  wall.normal = plane.vector("normal");
  plane.finish();
  wall.restitution = table.number_or("restitution", wall.restitution, zero_to_one);
  table.finish();
  if (wall.normal.isZero())
    plane.refuse("normal", "the wall's normal is zero", "point it to the body's side");
  return wall;
}

solver::Probe read_probe(Table table) {
  solver::Probe probe;
  probe.name = table.name("name");
  probe.quantity = table.text("quantity");
  probe.reduce = table.text("reduce");
  probe.on = table.text_or("on", probe.on);
  table.finish();
  return probe;
}

post::Picture read_picture(Table table, const std::vector<post::Picture>& earlier) {
  post::Picture picture;
  picture.name = table.name("name");
  picture.field = table.choice("field", {"PlasticStrain", "VonMises", "Pressure", "Displacement",
                                         "Displacement.x", "Displacement.y", "Displacement.z", "Velocity",
                                         "Velocity.x", "Velocity.y", "Velocity.z", "Stress.xx", "Stress.yy",
                                         "Stress.zz", "Stress.xy", "Stress.yz", "Stress.xz", "J", "volume"});
  picture.view =
      table.choice_or("view", picture.view, {"front", "back", "left", "right", "top", "bottom", "iso"});
  picture.clip = table.choice_or("clip", "", {"x", "y", "z"});
  picture.frame = table.number_or_word("frame", picture.frame);
  picture.minimum = table.optional_number("minimum");
  picture.maximum = table.optional_number("maximum");
  picture.outline = table.boolean_or("outline", picture.outline);
  table.finish();

  const bool word = picture.frame == "last" || picture.frame == "first";
  if (!word && picture.frame.find_first_not_of("0123456789.e+-") != std::string::npos)
    table.refuse("frame", fmt::format("a picture's frame is {}", in_quotes(picture.frame)),
                 "it must be \"first\", \"last\" or a time in seconds");
  if (picture.minimum && picture.maximum && *picture.minimum >= *picture.maximum)
    table.refuse("maximum", "a picture's maximum is not above its minimum",
                 "leave both out for the field's own range");
  for (const char* taken : {"cloud", "energies", "probes"})
    if (picture.name == taken)
      table.refuse("name", fmt::format("a picture may not be called '{}'", taken),
                   "that file is written anyway");
  for (const auto& other : earlier)
    if (other.name == picture.name)
      table.refuse("name", fmt::format("two pictures are called '{}'", picture.name),
                   "give each its own name");
  return picture;
}

/// "taylor_bar" for taylor_bar/case.toml, "taylor_bar-voronoi" for taylor_bar/voronoi.toml.
std::string short_name(const fs::path& file) {
  const std::string folder = fs::absolute(file).lexically_normal().parent_path().filename().string();
  const std::string stem = file.stem().string();
  if (folder.empty())
    return stem;
  return stem == "case" ? folder : folder + "-" + stem;
}

std::string to_text(const toml::table& table) {
  std::ostringstream out;
  out << toml::toml_formatter(table) << '\n';
  return out.str();
}

/// The tables the particles depend on.
std::string cloud_part(const toml::table& root) {
  toml::table part;
  for (const char* key : {"geometry", "particles", "set"})
    if (const toml::node* node = root.get(key))
      part.insert(key, *node);
  return to_text(part);
}

} // namespace

Case read_case(const fs::path& file, const std::vector<std::string>& overrides) {
  const auto document = std::make_shared<Document>(file, overrides);
  Case result;
  result.path = document->file();
  result.name = short_name(result.path);
  result.where = [document](const std::string& key) { return document->where(key); };

  Table root(*document);
  result.title = root.text_or("title", result.name);
  Table geometry = root.table("geometry");
  Table particles = root.table("particles");
  Table material = root.table("material");
  Table solver = root.table("solver");
  const std::vector<Table> sets = root.tables("set"), initial = root.tables("initial"),
                           boundary = root.tables("boundary"), wall = root.tables("wall");
  std::optional<Table> output = root.optional_table("output");
  root.finish();

  result.geometry = read_geometry(geometry, result.path.parent_path());
  result.particles = read_particles(particles);
  for (const Table& set : sets)
    result.particles.sets.push_back(read_set(set, result.particles.sets));

  solver::SceneSpec& scene = result.scene;
  scene.material = read_material(material);
  read_solver(solver, scene);
  for (const Table& entry : initial)
    scene.initial.push_back(read_initial(entry));
  for (const Table& entry : boundary)
    scene.fixed.push_back(read_boundary(entry));
  for (const Table& entry : wall)
    scene.walls.push_back(read_wall(entry));
  if (output) {
    scene.frames = static_cast<int>(output->integer_or("frames", scene.frames, 1, 100'000));
    scene.history_rows =
        static_cast<int>(output->integer_or("history_rows", scene.history_rows, 1, 10'000'000));
    const std::vector<Table> probes = output->tables("probe"), pictures = output->tables("picture");
    output->finish();
    for (const Table& entry : probes)
      scene.probes.push_back(read_probe(entry));
    for (const Table& entry : pictures)
      result.pictures.push_back(read_picture(entry, result.pictures));
  }
  solver::validate(scene, result.where);

  toml::table stored = document->root(); // a copy: the document's own nodes know where they were written
  stored["geometry"].as_table()->insert_or_assign("file", result.geometry.file.string());
  result.text = to_text(stored);
  result.cloud_text = cloud_part(stored);
  return result;
}

} // namespace tessera::app
