#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/hyperbolicity_report.hpp"
#include "app/run_folder.hpp"
#include "core/parallel.hpp"
#include "io/atomic_file.hpp"
#include "solver/physics/materials/catalogue.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tessera::app {
namespace {

using Json = nlohmann::ordered_json;

std::string parameters_text(const std::vector<solver::LawParameter>& parameters) {
  std::string text;
  for (const solver::LawParameter& p : parameters)
    text += fmt::format("  {:<19}{:<8}{}{}\n", p.key, p.unit, p.list ? "list: " : "", p.meaning);
  return text;
}

Json parameters_json(const std::vector<solver::LawParameter>& parameters) {
  Json json = Json::array();
  for (const solver::LawParameter& p : parameters)
    json.push_back({{"key", p.key}, {"unit", p.unit}, {"list", p.list}, {"meaning", p.meaning}});
  return json;
}

std::string catalogue_text() {
  std::string text = "[material] law = \"...\" with its constants; symbols as in docs/theory.md\n\n";
  for (const solver::LawDescription& law : solver::law_catalogue()) {
    text += fmt::format("{}\n  {}\n  {:<19}{}\n  {:<19}{}\n", law.name, law.what, "energy", law.energy,
                        "source", law.source);
    text += parameters_text(law.parameters);
    if (law.plasticity)
      text += fmt::format("  {:<19}von Mises, with one of the hardenings below\n", "plasticity");
    text += "\n";
  }
  text += "[material.plasticity] with the constants of one hardening\n";
  for (const solver::HardeningDescription& hardening : solver::hardening_catalogue())
    text += fmt::format("\n{}\n  {:<19}{}\n  {:<19}{}\n", hardening.what, "yield stress",
                        hardening.yield_stress, "source", hardening.source) +
            parameters_text(hardening.parameters);
  return text;
}

std::string catalogue_json() {
  Json json = {{"laws", Json::array()}, {"hardenings", Json::array()}};
  for (const solver::LawDescription& law : solver::law_catalogue())
    json["laws"].push_back({{"name", law.name},
                            {"what", law.what},
                            {"energy", law.energy},
                            {"source", law.source},
                            {"parameters", parameters_json(law.parameters)},
                            {"plasticity", law.plasticity}});
  for (const solver::HardeningDescription& hardening : solver::hardening_catalogue())
    json["hardenings"].push_back({{"what", hardening.what},
                                  {"yield_stress", hardening.yield_stress},
                                  {"source", hardening.source},
                                  {"parameters", parameters_json(hardening.parameters)}});
  return json.dump(2) + "\n";
}

void hyperbolicity(const Options& options, Console& console) {
  const std::filesystem::path folder =
      options.output.empty() ? std::filesystem::path("runs") / "hyperbolicity" : options.output;
  open_folder(folder);
  const std::vector<solver::StudiedLaw> subjects = solver::laws_to_study();
  std::vector<solver::Hyperbolicity> laws(subjects.size());
  for_each_task(static_cast<std::int64_t>(subjects.size()), [&](std::int64_t i) {
    const auto law = static_cast<std::size_t>(i);
    laws[law] = solver::study_hyperbolicity(subjects[law]);
  });
  const std::string json = hyperbolicity_json(laws);
  io::write_text(folder / "hyperbolicity.csv", hyperbolicity_csv(laws));
  io::write_text(folder / "hyperbolicity.json", json);
  const auto drawn =
      post::render({{}, {hyperbolicity_plot(laws, folder / "hyperbolicity.png")}}, console.progress());
  std::string text = hyperbolicity_table(laws) +
                     fmt::format("\nin {}: hyperbolicity.csv, hyperbolicity.json", folder.string());
  for (const auto& file : drawn)
    text += ", " + file.filename().string();
  console.result(text, json);
}

} // namespace

void materials(const Options& options) {
  Console console(options);
  if (options.hyperbolicity)
    hyperbolicity(options, console);
  else
    console.answer(catalogue_text(), catalogue_json());
}

} // namespace tessera::app
