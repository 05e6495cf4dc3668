#include "app/case/case.hpp"
#include "app/case/read_cloud.hpp"
#include "app/case/read_conditions.hpp"
#include "app/case/read_wall.hpp"
#include "app/case/table.hpp"
#include "core/error.hpp"
#include "solver/physics/derived_fields.hpp"
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

/// Either yield and hardening or power.
solver::PlasticitySpec read_plasticity(Table& plasticity) {
  if (!plasticity.has("power")) {
    plasticity.allow("power");
    return solver::LinearHardening{plasticity.number("yield"), plasticity.number("hardening")};
  }
  for (const char* key : {"yield", "hardening"})
    if (plasticity.has(key))
      plasticity.refuse(key, fmt::format("{} stands beside power", plasticity.path_of(key)),
                        "a body hardens one way: keep yield and hardening, or power");
  Table power = plasticity.table("power");
  const solver::PowerHardening hardening{power.number("coefficient"), power.number("offset"),
                                         power.number("exponent")};
  power.finish();
  return hardening;
}

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
    spec.plasticity = read_plasticity(*plasticity);
    plasticity->finish();
  }
  material.finish();
  return spec;
}

/// A number, or a table that says how it falls with the plastic strain.
std::optional<solver::PlasticRamp> read_ramp(Table& table, const std::string& key) {
  if (!table.is_table(key)) {
    const auto constant = table.optional_number(key);
    return constant ? std::optional(solver::PlasticRamp::constant(*constant)) : std::nullopt;
  }
  Table ramp = table.table(key);
  const solver::PlasticRamp result{ramp.number("elastic"), ramp.number("plastic"), ramp.number("strain")};
  ramp.finish();
  return result;
}

void read_solver(Table solver, solver::SceneSpec& scene) {
  scene.formulation = solver.text_or("formulation", scene.formulation);
  scene.scheme = solver.text_or("scheme", scene.scheme);
  scene.dissipation = solver.text_or("dissipation", scene.dissipation);
  scene.kernel = solver.text_or("kernel", scene.kernel);
  scene.support = solver.optional_number("support");
  scene.neighbours = static_cast<int>(solver.integer_or("neighbours", scene.neighbours, 1, 1000));
  scene.jst4 = read_ramp(solver, "jst4");
  scene.jst2 = solver.number_or("jst2", scene.jst2);
  scene.jst4_J = solver.optional_number("jst4_J");
  scene.residual = read_ramp(solver, "residual");
  scene.residual_J = solver.optional_number("residual_J");
  scene.involution = solver.optional_number("involution");
  scene.integrator = solver.text_or("integrator", scene.integrator);
  scene.cfl = solver.optional_number("cfl");
  scene.momentum_projection = solver.boolean_or("momentum_projection", scene.momentum_projection);
  scene.end_time = solver.number("end_time");
  solver.finish();
}

solver::Probe read_probe(Table table) {
  solver::Probe probe;
  probe.name = table.name("name");
  probe.quantity = table.text("quantity");
  probe.at = table.optional_vector("at");
  if (!probe.at) {
    probe.reduce = table.text("reduce");
    probe.on = table.text_or("on", probe.on);
  }
  if (probe.quantity == "radius" || probe.quantity == "angle")
    probe.centre = table.optional_vector("centre").value_or(probe.centre);
  table.finish();
  return probe;
}

/// A picture of a derived field is reason enough to store it.
void store_what_is_drawn(const std::vector<post::Picture>& pictures, std::vector<std::string>& fields) {
  for (const post::Picture& picture : pictures)
    if (solver::find_derived_field(picture.field) &&
        std::find(fields.begin(), fields.end(), picture.field) == fields.end())
      fields.push_back(picture.field);
}

constexpr int most_abreast = 12;    ///< frames of one picture
constexpr int most_frames = 10'000; ///< of an animation

post::Picture read_picture(Table table, const std::vector<post::Picture>& earlier, int dimension) {
  post::Picture picture;
  picture.name = table.name("name");
  std::vector<std::string> fields{
      "PlasticStrain",  "VonMises",       "Pressure",  "Displacement", "Displacement.x",
      "Displacement.y", "Displacement.z", "Velocity",  "Velocity.x",   "Velocity.y",
      "Velocity.z",     "Stress.xx",      "Stress.yy", "Stress.zz",    "Stress.xy",
      "Stress.yz",      "Stress.xz",      "J",         "volume"};
  for (const solver::DerivedField& field : solver::derived_fields())
    if (field.components == 1)
      fields.emplace_back(field.name);
  picture.field = table.choice("field", fields);
  picture.view =
      table.choice_or("view", picture.view, {"front", "back", "left", "right", "top", "bottom", "iso"});
  picture.skin = table.choice_or("style", "particles", {"particles", "skin"}) == "skin";
  picture.clip = table.choice_or("clip", "", {"x", "y", "z"});
  picture.clip_at = table.optional_number("clip_at");
  picture.frame = table.number_or_word("frame", picture.frame);
  picture.animation = table.boolean_or("animation", picture.animation);
  if (table.is_list("frames"))
    picture.times = table.number_list("frames");
  else
    picture.frames = static_cast<int>(table.integer_or("frames", 0, 2, most_frames));
  picture.minimum = table.optional_number("minimum");
  picture.maximum = table.optional_number("maximum");
  picture.outline = table.boolean_or("outline", picture.outline);
  picture.tools = table.boolean_or("tools", picture.tools);
  picture.magnify = table.number_or("magnify", picture.magnify, positive);
  table.finish();

  const bool word = picture.frame == "last" || picture.frame == "first";
  if (!word && (picture.frame.starts_with('-') ||
                picture.frame.find_first_not_of("0123456789.e+-") != std::string::npos))
    table.refuse("frame", fmt::format("a picture's frame is {}", in_quotes(picture.frame)),
                 "it must be \"first\", \"last\" or a time in seconds");
  if (table.has("frame") && (table.has("frames") || picture.animation))
    table.refuse("frame", "a picture has a frame and several", "keep frame, or frames and animation");
  if (!picture.animation && std::max<std::size_t>(picture.times.size(), picture.frames) > most_abreast)
    table.refuse("frames", fmt::format("a picture has more than {} frames side by side", most_abreast),
                 "choose fewer, or show them one after the other: animation = true");
  if (dimension == 2 && !picture.clip.empty())
    table.refuse("clip", "a plane body has no inside to cut to", "remove clip");
  if (picture.clip_at && picture.clip.empty())
    table.refuse("clip_at", "clip_at does nothing to a picture that is not cut", "remove it or add clip");
  if (picture.minimum && picture.maximum && *picture.minimum >= *picture.maximum)
    table.refuse("maximum", "a picture's maximum is not above its minimum",
                 "leave both out for the field's own range");
  for (const char* taken : {"cloud", "cloud_histograms", "energies", "forces", "momenta", "probes"})
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
  for (const char* key : {"material", "solver", "initial", "boundary", "wall", "exact", "output"})
    result.has_scene |= root.has(key);
  std::optional<Table> material, solver;
  if (result.has_scene) {
    material = root.table("material");
    solver = root.table("solver");
  }
  const std::vector<Table> sets = root.tables("set"), initial = root.tables("initial"),
                           boundary = root.tables("boundary"), wall = root.tables("wall");
  std::optional<Table> output = root.optional_table("output"), exact = root.optional_table("exact");
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
    scene.boundary.push_back(read_boundary(entry));
  if (exact)
    scene.exact = read_exact(*exact);
  Walls walls = read_walls(wall, result.geometry.dimension, result.path.parent_path());
  scene.walls = std::move(walls.walls);
  result.wall_surfaces = std::move(walls.surfaces);
  if (output) {
    scene.frames = static_cast<int>(output->integer_or("frames", scene.frames, 1, 100'000));
    scene.history_rows =
        static_cast<int>(output->integer_or("history_rows", scene.history_rows, 1, 10'000'000));
    output->allow("fields");
    if (output->has("fields"))
      scene.fields = output->choices("fields", solver::derived_field_names());
    const std::vector<Table> probes = output->tables("probe"), pictures = output->tables("picture");
    output->finish();
    for (const Table& entry : probes)
      scene.probes.push_back(read_probe(entry));
    for (const Table& entry : pictures)
      result.pictures.push_back(read_picture(entry, result.pictures, result.geometry.dimension));
    store_what_is_drawn(result.pictures, scene.fields);
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
