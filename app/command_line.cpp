#include "app/command_line.hpp"

#include "app/commands/commands.hpp"
#include "core/error.hpp"
#include "core/particle_cloud.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iostream>

namespace tessera::app {
namespace {

struct Grammar {
  CLI::App app{"CAD to particle clouds, mixed total-Lagrangian JST-SPH solid dynamics", "tessera"};
  Invocation invocation;

  Grammar() {
    Options& o = invocation.options;
    app.set_version_flag("--version", std::string("tessera ") + TESSERA_VERSION,
                         "Print the version and exit");
    app.set_help_flag("-h,--help", "Print this help and exit");
    app.add_option("--set", o.overrides,
                   "Override a key of the case, as in --set particles.seed=7 (repeatable)")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    app.add_option("--threads", o.threads,
                   "Threads to use (all cores unless given); results do not depend on it")
        ->type_name("N")
        ->check(CLI::Range(1, 1024));
    app.add_flag("--quiet", o.quiet, "Say nothing but errors, and what check and materials are asked for");
    app.add_flag("--json", o.json, "Print the result as JSON on standard output, and nothing else there");
    app.footer("Exit status: 0 good, 1 the run failed, 2 bad usage or input.");
    app.require_subcommand(1);
    app.fallthrough();

    CLI::App* run_command = add("run", "Prepare the particles, solve, draw: the whole of a case", run);
    CLI::App* prepare_command =
        add("prepare", "From the CAD file to particles with their subvolumes", prepare);
    CLI::App* solve_command = add("solve", "Run the solver on particles prepared earlier (or now)", solve);
    CLI::App* post_command = add("post", "Draw pictures and write the report of a run again", post);
    CLI::App* check_command = add("check", "Validate a case and foretell its run; writes nothing", check);
    CLI::App* compare_command = add("compare", "Several runs side by side: one table, one picture", compare);

    CLI::App* export_command = add("export", "A stored frame as a table: every array in CSV", export_fields);
    CLI::App* study_command = add("study", "A grid of runs of one case: error against cost", study);
    CLI::App* stability_command = add(
        "stability", "The largest stable step: of chapter 4's model, or of a case's operators", stability);
    CLI::App* materials_command =
        add("materials", "The laws a case can name, with their constants and sources", materials);

    for (CLI::App* command : {run_command, prepare_command, solve_command, check_command})
      command->add_option("case", o.case_file, "Case file, or the folder that holds case.toml")
          ->type_name("CASE.toml")
          ->required();
    check_command->add_flag(
        "--explain", o.explain,
        "Also say what was chosen for the case (formulation, dissipation, step ...) and why");
    study_command->add_option("study", o.case_file, "Study file, or the folder that holds study.toml")
        ->type_name("STUDY.toml")
        ->required();
    study_command->add_flag("--retry-failed", o.retry, "Run again what failed before");
    study_command
        ->add_option(
            "-o,--output", o.output,
            "Folder to write to, or to go on in (runs/NAME unless given, NAME from the study's folder and "
            "file)")
        ->type_name("DIR");
    run_command->add_flag("!--no-pictures", o.pictures,
                          "Leave out pictures and report (tessera post DIR makes them later)");
    stability_command->add_option("case", o.case_file, "Case file, or its folder; chapter 4's model without")
        ->type_name("CASE.toml");
    stability_command
        ->add_option("--stretch", o.stretch, "Principal stretches of the case's body along X, Y and Z")
        ->type_name("L1,L2,L3")
        ->delimiter(',')
        ->expected(3);
    for (CLI::App* command : {post_command, export_command})
      command->add_option("folder", o.folders, "Folder of a run")->type_name("DIR")->required()->expected(1);
    compare_command->add_option("folders", o.folders, "Folders of runs")->type_name("DIR")->required();
    for (CLI::App* command :
         {run_command, prepare_command, solve_command, compare_command, stability_command})
      command
          ->add_option("-o,--output", o.output,
                       "Folder to write to (unless given, runs/NAME with NAME from the case: its folder, and "
                       "-FILE where the file is not case.toml)")
          ->type_name("DIR");
    add_sight(*compare_command, o);
    for (CLI::App* command : {compare_command, export_command})
      command
          ->add_option("--time", o.time, "The frame: last (unless given), first, or nearest to a time in s")
          ->type_name("T");
    export_command
        ->add_option("-o,--output", o.output,
                     "File to write (unless given, DIR/fields_NNNN.csv as the frame is called)")
        ->type_name("FILE.csv");
    for (CLI::App* command : {run_command, prepare_command})
      command->add_flag("--cells", o.cells, "Also write the Voronoi cells (cells.vtu)");
    CLI::Option* hyperbolicity = materials_command->add_flag(
        "--hyperbolicity", o.hyperbolicity, "Find the stretches at which each law's waves cease to be real");
    materials_command
        ->add_option("-o,--output", o.output, "Folder of the study (runs/hyperbolicity unless given)")
        ->type_name("DIR")
        ->needs(hyperbolicity);
    solve_command
        ->add_option("--cloud", o.cloud, "Particles to use (the output folder's cloud.vtp unless given)")
        ->type_name("FILE");
  }

  std::vector<std::string> command_names() const {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(command->get_name());
    return names;
  }

  std::vector<std::string> option_names() const {
    std::vector<std::string> names;
    const auto collect = [&](const CLI::App* of) {
      for (const CLI::Option* option : of->get_options())
        for (const std::string& name : option->get_lnames())
          names.push_back("--" + name);
    };
    collect(&app);
    for (const CLI::App* command : app.get_subcommands())
      collect(command);
    return names;
  }

 private:
  /// What compare looks at.
  /// CLI11's own ranges let nan and inf through.
  static CLI::Validator finite_positive() {
    return {[](const std::string& text) -> std::string {
              double value = 0;
              return CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0
                         ? ""
                         : fmt::format("'{}' is no number greater than 0", text);
            },
            "POSITIVE"};
  }

  static void add_sight(CLI::App& command, Options& o) {
    command
        .add_option(
            "--field", o.fields,
            "Field to draw, as VonMises, Velocity or Stress.xy (repeatable; PlasticStrain where a run "
            "flows, and VonMises, unless given)")
        ->type_name("NAME")
        ->allow_extra_args(false);
    command
        .add_option("--section", o.sections,
                    "Draw the fields along a line, two points in m: x0,y0,z0:x1,y1,z1 (repeatable)")
        ->type_name("FROM:TO")
        ->allow_extra_args(false);
    command.add_option("--times", o.times, "Pictures at several times in s: a row a run, a column a time")
        ->type_name("T1,T2,...")
        ->delimiter(',');
    command.add_option("--style", o.style, "particles (unless given) or skin: the bodies as smooth pieces")
        ->type_name("STYLE")
        ->check(CLI::IsMember({"particles", "skin"}));
    command.add_flag("--outline", o.outline, "Draw the undeformed bodies as lines");
    command.add_option("--magnify", o.magnify, "Times as large displacements are drawn (1)")
        ->type_name("M")
        ->check(finite_positive());
    command
        .add_option("--history", o.columns,
                    "Draw a column of history.csv of all runs over each other, as kinetic_J (repeatable)")
        ->type_name("COLUMN")
        ->allow_extra_args(false);
    command.add_flag("--reference", o.reference, "Sections of the body as it was, not of the deformed one");
    command.add_option("--view", o.view, "front (unless given), back, left, right, top, bottom or iso")
        ->type_name("VIEW")
        ->check(CLI::IsMember({"front", "back", "left", "right", "top", "bottom", "iso"}));
    command
        .add_option("--clip", o.clip,
                    "Leave out the half before the middle plane of y (unless given), x or "
                    "z; or none")
        ->type_name("AXIS")
        ->check(CLI::IsMember({"x", "y", "z", "none"}));
  }

  CLI::App* add(const std::string& name, const std::string& help, Command command) {
    CLI::App* sub = app.add_subcommand(name, help);
    sub->fallthrough();
    sub->callback([this, command] { invocation.command = command; });
    return sub;
  }
};

/// The library's complaint in our words: nearest command or option, and where help is.
InputError usage_error(const Grammar& grammar, const CLI::ParseError& error) {
  const auto guess = [](const std::string& word, const std::vector<std::string>& names) {
    const std::string nearest = word.size() > 64 ? "" : nearest_name(word, names);
    return nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest);
  };
  const std::vector<CLI::App*> chosen = grammar.app.get_subcommands();
  const std::string help =
      chosen.empty() ? "tessera --help" : fmt::format("tessera {} --help", chosen.front()->get_name());
  const std::vector<std::string> extras = grammar.app.remaining(true);
  for (const std::string& extra : extras)
    if (extra.starts_with("-"))
      return {fmt::format("unknown option '{}'", extra), "",
              fmt::format("{}see {}", guess(extra.substr(0, extra.find('=')), grammar.option_names()), help)};
  if (chosen.empty()) {
    const std::vector<std::string> names = grammar.command_names();
    return {extras.empty() ? "no command given" : fmt::format("unknown command '{}'", extras.front()), "",
            fmt::format("{}commands: {} (see tessera --help)",
                        extras.empty() ? "" : guess(extras.front(), names), fmt::join(names, ", "))};
  }
  if (!extras.empty())
    return {fmt::format("unexpected argument '{}'", extras.front()), "", "see " + help};
  return {error.what(), "", "see " + help};
}

} // namespace

Invocation parse_command_line(int argc, const char* const* argv) {
  Grammar grammar;
  try {
    grammar.app.parse(argc, argv);
  } catch (const CLI::Success& success) { // --help, --version
    grammar.app.exit(success, std::cout, std::cerr);
    return {};
  } catch (const CLI::ParseError& error) {
    throw usage_error(grammar, error);
  }
  return grammar.invocation;
}

} // namespace tessera::app
