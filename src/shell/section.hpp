// SPDX-License-Identifier: BSD-3-Clause
// Stress resultants of a shell's section: a law integrated over the thickness.
#pragma once

#include <array>
#include <variant>

#include "shell/material/material.hpp"

namespace luff::shell {

/// N = int S dz [M/T^2] and M = int z S dz [M L/T^2], in Voigt order (11, 22, 12).
struct Resultants {
  Vec3 N;
  Vec3 M;
};

/// D_n = int z^n dS/dE dz: dN = membrane dE^m + coupling dE^b, dM = coupling dE^m + bending dE^b. All three symmetric.
struct SectionStiffness {
  Mat3 membrane;  ///< D_0 [M/T^2]
  Mat3 coupling;  ///< D_1 [M L/T^2]
  Mat3 bending;   ///< D_2 [M L^2/T^2]
};

struct SectionResponse {
  Resultants resultants;
  SectionStiffness stiffness;
};

/// Section of a material with constant moduli C: membrane = h C, bending = h^3/12 C, exact.
struct LinearSection {
  static constexpr bool couples = false;  ///< stretch and bending: is D_1 ever different from zero?

  Mat3 membrane;
  Mat3 bending;

  LinearSection(const Mat3& moduli, double thickness)
      : membrane(thickness * moduli), bending(thickness * thickness * thickness / 12 * moduli)
  {
  }

  /// Energy per reference area [M/T^2] of the strains Em + z Eb.
  double energy(const Vec3& Em, const Vec3& Eb, const Fibre&) const
  {
    return 0.5 * (Em.dot(membrane * Em) + Eb.dot(bending * Eb));
  }
  Resultants resultants(const Vec3& Em, const Vec3& Eb, const Fibre&) const { return {membrane * Em, bending * Eb}; }
  SectionStiffness stiffness(const Vec3&, const Vec3&, const Fibre&) const { return {membrane, Mat3::Zero(), bending}; }
  SectionResponse response(const Vec3& Em, const Vec3& Eb, const Fibre& a) const
  {
    return {resultants(Em, Eb, a), stiffness(Em, Eb, a)};
  }
};

inline constexpr int max_thickness_points = 5;

/// Abscissas and weights of Gauss' rule on [-1, 1]; n points are exact for polynomials of degree 2n - 1.
struct GaussRule {
  std::array<double, max_thickness_points> abscissa;
  std::array<double, max_thickness_points> weight;
};

/// \param n_points 1 .. max_thickness_points
const GaussRule& gauss_rule(int n_points);

/// Section of any law: strain E^m + z E^b, Gauss' rule over -h/2 <= z <= h/2. The thickness is that of the reference:
/// its change with the stretch doesn't enter z.
///
/// One point has no bending stiffness; how many a law needs: recommended_thickness_points().
template <class Law>
class IntegratedSection {
 public:
  static constexpr bool couples = true;

  /// \param n_points 1 .. max_thickness_points
  IntegratedSection(const Law& law, double thickness, int n_points) : law_(law), n_points_(n_points)
  {
    const GaussRule& rule = gauss_rule(n_points);
    for (int g = 0; g < n_points; ++g) {
      z_[g] = 0.5 * thickness * rule.abscissa[g];
      weight_[g] = 0.5 * thickness * rule.weight[g];
    }
  }

  /// Energy per reference area [M/T^2].
  double energy(const Vec3& Em, const Vec3& Eb, const Fibre& a) const
  {
    double sum = 0;
    for (int g = 0; g < n_points_; ++g)
      sum += weight_[g] * law_.energy(Em + z_[g] * Eb, a);
    return sum;
  }

  Resultants resultants(const Vec3& Em, const Vec3& Eb, const Fibre& a) const
  {
    Resultants sum{Vec3::Zero(), Vec3::Zero()};
    for (int g = 0; g < n_points_; ++g)
      add(sum, g, law_.stress(Em + z_[g] * Eb, a));
    return sum;
  }

  SectionStiffness stiffness(const Vec3& Em, const Vec3& Eb, const Fibre& a) const
  {
    SectionStiffness sum{Mat3::Zero(), Mat3::Zero(), Mat3::Zero()};
    for (int g = 0; g < n_points_; ++g)
      add(sum, g, law_.tangent(Em + z_[g] * Eb, a));
    return sum;
  }

  /// Both at the price of the stiffness.
  SectionResponse response(const Vec3& Em, const Vec3& Eb, const Fibre& a) const
  {
    SectionResponse sum{{Vec3::Zero(), Vec3::Zero()}, {Mat3::Zero(), Mat3::Zero(), Mat3::Zero()}};
    for (int g = 0; g < n_points_; ++g) {
      const Response at_point = law_.response(Em + z_[g] * Eb, a);
      add(sum.resultants, g, at_point.stress);
      add(sum.stiffness, g, at_point.tangent);
    }
    return sum;
  }

 private:
  void add(Resultants& sum, int g, const Vec3& S) const
  {
    sum.N += weight_[g] * S;
    sum.M += weight_[g] * z_[g] * S;
  }

  void add(SectionStiffness& sum, int g, const Mat3& D) const
  {
    sum.membrane += weight_[g] * D;
    sum.coupling += weight_[g] * z_[g] * D;
    sum.bending += weight_[g] * z_[g] * z_[g] * D;
  }

  Law law_;
  int n_points_;
  std::array<double, max_thickness_points> z_{};
  std::array<double, max_thickness_points> weight_{};
};

/// The section of any material; St-Venant-Kirchhoff's is linear.
using Section = std::variant<LinearSection, IntegratedSection<Hencky>, IntegratedSection<NeoHookean>,
                             IntegratedSection<MayNewmanYin>, IntegratedSection<LeeSacks>, IntegratedSection<Fung>,
                             IntegratedSection<HolzapfelGasserOgden>>;

/// \param thickness_points 1 .. max_thickness_points; 0: recommended_thickness_points(material)
Section make_section(const Material& material, double thickness, int thickness_points);

}  // namespace luff::shell
