/// make_step INPUT.geo OUTPUT.step: a drawing in gmsh's language, in millimetres, as a STEP file. The same
/// drawing gives the same bytes: the date in the header is replaced by a fixed one.

#include <gmsh.h>

#include <fstream>
#include <iostream>
#include <regex>
#include <sstream>
#include <string>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "make_step INPUT.geo OUTPUT.step\n";
    return 2;
  }
  try {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Verbosity", 2);
    gmsh::open(argv[1]);
    gmsh::vectorpair solids;
    gmsh::model::getEntities(solids, 3);
    if (solids.empty()) {
      std::cerr << "make_step: there is no solid in " << argv[1] << '\n';
      return 2;
    }
    gmsh::write(argv[2]); // OpenCASCADE's unit is the millimetre, in the numbers and in the header
    gmsh::finalize();
  } catch (const std::string& error) {
    std::cerr << "make_step: " << error << '\n';
    return 2;
  }

  std::ostringstream text;
  text << std::ifstream(argv[2], std::ios::binary).rdbuf();
  const std::regex date(R"('\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d')");
  const std::string dated =
      std::regex_replace(text.str(), date, "'2000-01-01T00:00:00'", std::regex_constants::format_first_only);
  std::ofstream out(argv[2], std::ios::binary);
  out << dated;
  return out.good() ? 0 : 1;
}
