#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "preprocess/geometry/geo_script.hpp"
#include "preprocess/geometry/import.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace tessera::preprocess {
namespace {

namespace fs = std::filesystem;

std::string found(const std::string& script) {
  return forbidden_in_geo(script).what;
}

TEST(GeoScript, drawings_pass) {
  for (const char* part : {"taylor_bar/taylor_bar.geo", "bracket/bracket.geo", "spinning_cube/cube.geo"}) {
    std::ostringstream text;
    text << std::ifstream(fs::path(TESSERA_SOURCE_DIR) / "geometries" / part).rdbuf();
    EXPECT_FALSE(text.str().empty()) << part;
    EXPECT_EQ(found(text.str()), "") << part;
  }
  EXPECT_EQ(found(R"(
    // Save, Print and SystemCall "rm" in a comment are words
    /* Include "x"; Merge 'y'; */
    SetFactory('OpenCASCADE'); lc = 1e-2; n = 3; DefineConstant[ a = {1.5, Name "Parameters/System length"} ];
    For i In {1:n} Point(newp) = {i, .5e1, 2.}; EndFor
    If (n > 2) Printf("n = %g", n); Else n = 4; EndIf
    Macro Hole Cylinder(newv) = {0, 0, 0, 0, 0, 1, r}; Return
    Call Hole;
    Line Loop(1) = {1, 2}; Plane Surface(1) = {1}; Ruled Surface(2) = {1}; Surface Loop(1) = {1, 2}; Volume(1) = {1};
    Physical Surface("Print bed", 1) = {1}; Physical Volume("Merge") = {1};
    Transfinite Curve {1} = 5 Using Progression 1.1; Characteristic Length {1} = lc; Mesh.Algorithm = 6;
    out[] = Extrude {0, 0, 1} { Surface{1}; Layers{3}; }; Field[1] = Distance; Background Field = 1; Coherence;
  )"),
            "");
}

TEST(GeoScript, whatever_reaches_beyond_the_drawing_is_found) {
  for (const char* script : {
           "SystemCall \"touch x\";",
           "SystemCall\n\n\"touch x\";",
           "SystemCall/**/\"touch x\";",
           "SystemCall // why\n 'touch x';",
           "systemcall \"touch x\";",
           "NonBlockingSystemCall \"touch x\";",
           "System \"touch x\";",
           "a = 1e5SystemCall \"touch x\";",
           "a = 1;SystemCall Str(\"touch x\");",
           "cmd = \"touch x\"; SystemCall cmd;",
           "If(0) EndIf SystemCall \"touch x\";",
           "Macro f SystemCall \"touch x\"; Return Call f;",
           "Include \"other.geo\";",
           "Merge \"other.step\";",
           "MergeWithBoundingBox \"other.step\";",
           "Open \"other.geo\";",
           "Save \"out.msh\";",
           "Print \"out.png\";",
           "Save View[0] \"out.pos\";",
           "Printf(\"x\") > \"out.txt\";",
           "Printf(\"%g\", 1) >> \"out.txt\";",
           "CreateDir \"out\";",
           "ShapeFromFile(\"other.brep\");",
           "a() = ListFromFile[\"/etc/passwd\"];",
           "OnelabRun(\"x\", \"touch x\");",
           "Plugin(MathEval).Run;",
           "Field[1] = ExternalProcess; Field[1].CommandLine = \"touch x\";",
           "Solver.Executable0 = \"touch\";",
           "SetString(\"Solver.Executable0\", \"touch\");",
           "a = StringToName[\"SystemCall\"];",
           "a = S2N[\"SystemCall\"];",
           "Frobnicate \"touch x\";",
           "Frobnicate cmd;",
           "a = 1; /* SystemCall \"touch x\";",
           "a = \"SystemCall",
           "\"*/\" SystemCall \"touch x\"; // \"/*\"",
           "a = \"//\"; SystemCall \"touch x\";",
           "a = '\"'; SystemCall \"touch x\"; b = '\"';",
       })
    EXPECT_NE(found(script), "") << script;
  EXPECT_NE(found("a = \"" + std::string(1100, 'x') + "; SystemCall 'touch x'; \";"), "");
  EXPECT_NE(found(std::string("// a") + '\0' + "\nSystemCall \"touch x\";"), "");
}

TEST(GeoScript, the_line_is_told) {
  EXPECT_EQ(forbidden_in_geo("a = 1;\n/* two\nlines */ b = 'x\ny';\nSystemCall \"x\";").line, 5);
}

TEST(GeoScript, import_refuses_and_nothing_runs_unless_trusted) {
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path(), witness = folder / "witness";
  const std::string box = "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0,1,1,1};\n";
  std::ofstream(folder / "evil.geo") << box << "SystemCall \"touch " << witness.string() << "\";\n";
  try {
    import_geometry({.file = folder / "evil.geo", .unit = "m"}, Progress::silent());
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("SystemCall"), std::string::npos) << said;
    EXPECT_NE(said.find("evil.geo:3"), std::string::npos) << said;
    EXPECT_NE(said.find("trust"), std::string::npos) << said;
  }
  EXPECT_FALSE(fs::exists(witness));
  import_geometry({.file = folder / "evil.geo", .unit = "m", .trust = true}, Progress::silent());
  EXPECT_TRUE(fs::exists(witness));

  // gmsh would obey a file of the same name with .opt behind it.
  fs::remove(witness);
  std::ofstream(folder / "good.geo") << box;
  std::ofstream(folder / "good.geo.opt") << "SystemCall \"touch " << witness.string() << "\";\n";
  import_geometry({.file = folder / "good.geo", .unit = "m"}, Progress::silent());
  EXPECT_FALSE(fs::exists(witness));

  // A trusted file may include its neighbour; gmsh would skip a last line that does not end.
  std::ofstream(folder / "part.geo") << box;
  std::ofstream(folder / "whole.geo") << "Include \"part.geo\";\n";
  EXPECT_NEAR(
      import_geometry({.file = folder / "whole.geo", .unit = "m", .trust = true}, Progress::silent()).volume,
      1, 1e-12);
  std::ofstream(folder / "short.geo") << "Include \"part.geo\";";
  EXPECT_THROW(
      import_geometry({.file = folder / "short.geo", .unit = "m", .trust = true}, Progress::silent()),
      InputError);
}

} // namespace
} // namespace tessera::preprocess
