// SPDX-License-Identifier: BSD-3-Clause
// Keys of what a shell is made of.
#include "config/describe.hpp"

#include <Eigen/Eigenvalues>

namespace luff::config {
namespace {

constexpr double largest_poisson_ratio = 0.5;  // incompressible; plane stress stays finite there
constexpr double largest_dispersion = 1.0 / 3.0;

/// Isotropic, with Young's modulus and Poisson's ratio?
bool is_of_young(MaterialModel model)
{
  return model == MaterialModel::SaintVenantKirchhoff || model == MaterialModel::Hencky;
}

bool is_exponential(MaterialModel model)
{
  return !is_of_young(model) && model != MaterialModel::NeoHookean;
}

/// Does the law's energy depend on the direction of the fibre?
bool has_direction(const MaterialOptions& m)
{
  switch (m.model) {
    case MaterialModel::MayNewmanYin:
      return m.c2 > 0.0;
    case MaterialModel::LeeSacks:
      return m.weight < 1.0;
    case MaterialModel::HolzapfelGasserOgden:
      return m.dispersion < largest_dispersion;
    case MaterialModel::Fung:
      return true;
    default:
      return false;
  }
}

bool is_positive_definite(const MaterialOptions& m)
{
  Mat3 A;
  A << m.a11, m.a12, m.a13, m.a12, m.a22, m.a23, m.a13, m.a23, m.a33;
  return Eigen::SelfAdjointEigenSolver<Mat3>(A, Eigen::EigenvaluesOnly).eigenvalues()[0] > 0.0;
}

/// A stress, and a number without unit, that a model needs.
void stress(Schema& s, std::string_view name, double& value, std::string_view doc, const Range& range = positive)
{
  s.key(name, value, {.doc = doc, .unit = "Pa", .range = range, .required = true});
}

void number(Schema& s, std::string_view name, double& value, std::string_view doc, const Range& range = not_negative)
{
  s.key(name, value, {.doc = doc, .range = range, .required = true});
}

void describe_moduli(Schema& s, MaterialOptions& m)
{
  s.when(is_of_young(m.model), "`model = \"saint-venant-kirchhoff\"` or `\"hencky\"`", [&] {
    stress(s, "young", m.young, "Young's modulus.");
    number(s, "poisson", m.poisson, "Poisson's ratio.",
           {.low = -1.0, .high = largest_poisson_ratio, .with_low = false});
  });
}

void describe_leaflets(Schema& s, MaterialOptions& m)
{
  const bool may_newman_yin = m.model == MaterialModel::MayNewmanYin, lee_sacks = m.model == MaterialModel::LeeSacks;
  s.when(may_newman_yin || lee_sacks, "`model = \"may-newman-yin\"` or `\"lee-sacks\"`", [&] {
    stress(s, "c0", m.c0, "Factor of the exponential (May-Newman-Yin); shear modulus of the matrix (Lee-Sacks).");
    s.key("c1", m.c1,
          {.doc = "Exponent of (I1 - 3)^2, without unit (May-Newman-Yin); factor of the exponentials (Lee-Sacks).",
           .unit = "- or Pa",
           .range = not_negative,
           .required = true});
    number(s, "c2", m.c2, "Exponent of (sqrt(I4) - 1)^4 (May-Newman-Yin) or of (I1 - 3)^2 (Lee-Sacks).");
    s.key("tension_only", m.tension_only,
          {.doc = "Fibres carry no compression. The published laws don't make the difference."});
  });
  s.when(may_newman_yin, "`model = \"may-newman-yin\"`", [&] {
    stress(s, "c10", m.c10,
           "Half the shear modulus of a matrix beside the published law, which has no stiffness at rest; a static "
           "analysis needs it greater than 0.",
           not_negative);
  });
  s.when(lee_sacks, "`model = \"lee-sacks\"`", [&] {
    number(s, "c3", m.c3, "Exponent of (I4 - 1)^2.");
    number(s, "weight", m.weight, "Share of the isotropic exponential; 1: no fibres.", {.low = 0.0, .high = 1.0});
  });
}

void describe_fung(Schema& s, MaterialOptions& m)
{
  s.when(m.model == MaterialModel::Fung, "`model = \"fung\"`", [&] {
    stress(s, "c", m.c, "Factor: W = c/2 (exp(E.A E) - 1), E = (E_ff, E_cc, 2 E_fc) along and across the fibre.");
    number(s, "a11", m.a11, "A11, along the fibre.", positive);
    number(s, "a22", m.a22, "A22, across it.", positive);
    number(s, "a33", m.a33, "A33, of the shear 2 E_fc.", positive);
    number(s, "a12", m.a12, "A12 = A21.", any_number);
    s.key("a13", m.a13, {.doc = "A13 = A31."});
    s.key("a23", m.a23, {.doc = "A23 = A32."});
    s.rule(
        is_positive_definite(m), "a12",
        "must be small enough, with `a13` and `a23`, for a positive definite matrix (a12^2 < a11 a22), or some strain "
        "would cost no energy");
  });
}

void describe_families(Schema& s, MaterialOptions& m)
{
  s.when(m.model == MaterialModel::HolzapfelGasserOgden, "`model = \"holzapfel-gasser-ogden\"`", [&] {
    stress(s, "k1", m.k1, "Stiffness of the fibres.", not_negative);
    number(s, "k2", m.k2, "Exponent of the fibres.", positive);
    s.key("dispersion", m.dispersion,
          {.doc = "kappa: 0, all fibres of a family alike, to 1/3, no direction.",
           .range = {.low = 0.0, .high = largest_dispersion}});
    s.key("angle", m.angle,
          {.doc = "Between each of the two families and `fibre`.", .unit = "degrees", .required = true});
  });
}

}  // namespace

void describe(Schema& s, MaterialOptions& m)
{
  s.key(
      "model", m.model,
      {.doc =
           "Law of stress and strain. The first is for small strains; `hencky` is that of the logarithmic strain, the "
           "others large-strain laws of incompressible materials. Formulas, and constants with their standing: "
           "docs/numerics/materials.md.",
       .required = true});
  describe_moduli(s, m);
  s.when(m.model == MaterialModel::NeoHookean || m.model == MaterialModel::HolzapfelGasserOgden,
         "`model = \"neo-hookean\"` or `\"holzapfel-gasser-ogden\"`",
         [&] { stress(s, "shear_modulus", m.shear_modulus, "Shear modulus, of the matrix between the fibres."); });
  describe_leaflets(s, m);
  describe_fung(s, m);
  describe_families(s, m);
  s.when(is_exponential(m.model), "an exponential `model`", [&] {
    s.key("largest_exponent", m.largest_exponent,
          {.doc = "Beyond it the exponential is continued by the quadratic of the same value, slope and curvature.",
           .range = {.low = 1.0, .high = 50.0}});
    s.table("fibre", m.fibre, {.doc = "Direction of the fibres, projected on each triangle."});
    s.rule(!has_direction(m) || m.fibre, "fibre", "must be given: the law depends on the direction of its fibres");
  });
  s.when(m.model != MaterialModel::SaintVenantKirchhoff, "a nonlinear `model`", [&] {
    s.key("thickness_points", m.thickness_points,
          {.doc = "Gauss points through the thickness. Left out: 5 for `may-newman-yin`, 3 for the others.",
           .range = {.low = 2.0, .high = 5.0}});
  });
}

void describe(Schema& s, FibreOptions& fibre)
{
  s.mark(fibre.mark);
  s.exactly_one_of({"direction", "circumference", "field"});
  s.key("direction", fibre.direction, {.doc = "The same everywhere, of any length."});
  s.table("circumference", fibre.circumference, {.doc = "Around an axis, as in a leaflet."});
  s.key(
      "field", fibre.field,
      {.doc = "Name of an array in the mesh file (.vtp, .vtu) with one vector per triangle; it turns with the mesh."});
  s.rule(!fibre.direction || !fibre.direction->isZero(0.0), "direction", "must not be zero");
}

void describe(Schema& s, CircumferenceOptions& circumference)
{
  s.key("axis", circumference.axis, {.doc = "Direction of the axis, of any length.", .required = true});
  s.key("through", circumference.through, {.doc = "A point on the axis.", .unit = "m", .required = true});
  s.rule(!circumference.axis.isZero(0.0), "axis", "must not be zero");
}

}  // namespace luff::config
