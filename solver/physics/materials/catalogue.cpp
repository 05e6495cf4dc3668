#include "solver/physics/materials/catalogue.hpp"

#include <algorithm>

namespace tessera::solver {

const std::vector<LawDescription>& law_catalogue() {
  static const LawParameter density{"density", "kg/m^3", "reference density, positive"};
  static const LawParameter young{"young", "Pa", "Young's modulus of small strains, positive"};
  static const LawParameter poisson{"poisson", "-",
                                    "Poisson's ratio of small strains, above -1 and below 0.5"};
  static const LawParameter bulk{"bulk", "Pa", "bulk modulus kappa, positive"};
  static const std::vector<LawDescription> laws = {
      {"hencky",
       "quadratic in logarithmic strain: large strains, and the basis of plasticity",
       "mu sum_i (ln l_i)^2 + kappa/2 (ln J)^2, l_i = J^(-1/3) lambda_i",
       "(2.116), (5.5); with plasticity algorithm 2",
       {density, young, poisson},
       true},
      {"linear_elastic",
       "Hooke's law: small strains and small rotations, for closed solutions",
       "mu e:e + lambda/2 tr(e)^2, e = sym F - I",
       "Hooke",
       {density, young, poisson}},
      {"saint_venant_kirchhoff",
       "Hooke's law in Green's strain: large rotations, small strains; collapses under strong compression",
       "mu E:E + lambda/2 tr(E)^2, E = (F^T F - I)/2",
       "Saint Venant, Kirchhoff",
       {density, young, poisson}},
      {"neo_hookean",
       "rubber up to moderate stretches (about 1.5)",
       "mu/2 (J^(-2/3) F:F - 3) + kappa/2 (J - 1)^2",
       "(2.72), (2.133)",
       {density, young, poisson}},
      {"mooney_rivlin",
       "rubber; small strains have the shear modulus 2 (c1 + c2)",
       "c1 (J^(-2/3) F:F - 3) + c2 (J^(-4/3) H:H - 3) + kappa/2 (J - 1)^2",
       "(2.68), (2.132), with c1 = mu_1/2 and c2 = -mu_2/2",
       {density,
        {"c1", "Pa", "constant of the fibre map, zero or positive"},
        {"c2", "Pa", "constant of the area map, zero or positive; not both zero"},
        bulk}},
      {"ogden",
       "rubber up to very large stretches; small strains have the shear modulus sum_p mu_p alpha_p / 2",
       "sum_p mu_p/alpha_p (J^(-alpha_p/3) sum_i lambda_i^alpha_p - 3) + kappa/81 (9 ln J + J^(-9) - 1)",
       "(2.74), (2.75), with the isochoric factor of (2.142) term by term",
       {density,
        {"mu", "Pa", "one a term", true},
        {"alpha", "-", "one a term, with mu_p alpha_p positive", true},
        bulk}},
  };
  return laws;
}

const std::vector<HardeningDescription>& hardening_catalogue() {
  static const std::vector<HardeningDescription> hardenings = {
      {"linear",
       "yield + hardening eps",
       "algorithm 2",
       {{"yield", "Pa", "initial yield stress, positive"},
        {"hardening", "Pa", "isotropic hardening modulus, zero or positive"}}},
      {"power",
       "coefficient (offset + eps)^exponent",
       "(5.7)",
       {{"power.coefficient", "Pa", "positive"},
        {"power.offset", "-", "positive"},
        {"power.exponent", "-", "from 0, perfectly plastic, to 1, linear"}}},
  };
  return hardenings;
}

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const LawDescription& law : law_catalogue())
    names.push_back(law.name);
  return names;
}

const LawDescription* find_law(const std::string& name) {
  const auto& laws = law_catalogue();
  const auto found =
      std::find_if(laws.begin(), laws.end(), [&](const auto& law) { return law.name == name; });
  return found == laws.end() ? nullptr : &*found;
}

} // namespace tessera::solver
