#include "app/case/case.hpp"
#include "app/case/read_cloud.hpp"
#include "app/case/read_wall.hpp"
#include "app/case/table.hpp"
#include "core/error.hpp"
#include "solver/physics/materials/catalogue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <sstream>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

/// Where a material keeps the constants that are one number.
const std::map<std::string, double solver::MaterialSpec::*> material_numbers = {
    {"density", &solver::MaterialSpec::density}, {"young", &solver::MaterialSpec::young},
    {"poisson", &solver::MaterialSpec::poisson}, {"c1", &solver::MaterialSpec::c1},
    {"c2", &solver::MaterialSpec::c2},           {"bulk", &solver::MaterialSpec::bulk}};

/// Reads the constants its law goes by, and refuses those of other laws.
solver::MaterialSpec read_material(Table material) {
  if (!material.has("law")) // what the other keys should be is not known before it is there
    for (const solver::LawDescription& law : solver::law_catalogue())
      for (const solver::LawParameter& parameter : law.parameters)
        material.allow(parameter.key);
  solver::MaterialSpec spec;
  spec.law = material.choice("law", solver::law_names());
  // The thesis' own constants of Mooney and Rivlin's law.
  const bool by_mu = spec.law == "mooney_rivlin" && (material.has("mu1") || material.has("mu2"));
  for (const solver::LawParameter& parameter : solver::find_law(spec.law)->parameters) {
    if (by_mu && parameter.key == "c1")
      spec.c1 = 0.5 * material.number("mu1", not_negative);
    else if (by_mu && parameter.key == "c2")
      spec.c2 = -0.5 * material.number("mu2", not_positive);
    else if (parameter.list)
      (parameter.key == "mu" ? spec.mu : spec.alpha) = material.number_list(parameter.key);
    else
      spec.*material_numbers.at(parameter.key) = material.number(parameter.key);
  }
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

std::string Case::geometry_text() const {
  if (!geometry.shape)
    return fmt::format("{} (unit {})", geometry.file.string(), geometry.unit);
  std::string words = geometry.shape->name;
  for (const auto& length : geometry.shape->lengths)
    words += fmt::format(" {}", fmt::join(length, " x "));
  return words + " m";
}

void Case::require_scene() const {
  require(has_scene, "the case describes particles only", path.string(),
          "add [material] and [solver] (docs/cases.md), or use tessera prepare");
}

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
  // A case that only describes particles needs no material: `prepare` is all that can be done with it.
  for (const char* key : {"material", "solver", "initial", "boundary", "wall", "output"})
    result.has_scene |= root.has(key);
  std::optional<Table> material, solver;
  if (result.has_scene) {
    material = root.table("material");
    solver = root.table("solver");
  }
  const std::vector<Table> sets = root.tables("set"), initial = root.tables("initial"),
                           boundary = root.tables("boundary"), wall = root.tables("wall");
  std::optional<Table> output = root.optional_table("output");
  root.finish();

  result.geometry = read_geometry(geometry, result.path.parent_path());
  result.particles = read_particles(particles, result.geometry.dimension);
  result.geometry.background_sizes = result.particles.sizes_from_mesh;
  for (const Table& set : sets)
    result.particles.sets.push_back(read_set(set, result.particles.sets));

  solver::SceneSpec& scene = result.scene;
  if (result.has_scene) {
    scene.material = read_material(*material);
    read_solver(*solver, scene);
  }
  for (const Table& entry : initial)
    scene.initial.push_back(read_initial(entry));
  for (const Table& entry : boundary)
    scene.fixed.push_back(read_boundary(entry));
  Walls walls = read_walls(wall, result.geometry.dimension, result.path.parent_path());
  scene.walls = std::move(walls.walls);
  result.wall_surfaces = std::move(walls.surfaces);
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
  if (result.has_scene)
    solver::validate(scene, result.where);

  toml::table stored = document->root(); // a copy: the document's own nodes know where they were written
  if (!result.geometry.shape)
    stored["geometry"].as_table()->insert_or_assign("file", result.geometry.file.string());
  for (const WallSurface& surface : result.wall_surfaces)
    if (!surface.source.shape)
      stored["wall"][surface.entry]["surface"].as_table()->insert_or_assign("file",
                                                                            surface.source.file.string());
  result.text = to_text(stored);
  result.cloud_text = cloud_part(stored);
  return result;
}

} // namespace tessera::app
