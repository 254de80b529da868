// SPDX-License-Identifier: BSD-3-Clause
// Shells that touch themselves, each other and rigid bodies: they never pass through, and no energy appears.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "shell/dynamics.hpp"
#include "support/shells.hpp"

namespace luff::shell {
namespace {

constexpr double side = 0.02, thickness = 5e-4;  // a leaflet: 2 cm, half a millimetre, as soft as tissue

Properties leaflet_properties()
{
  return {.thickness = thickness, .density = 1100, .material = SaintVenantKirchhoff{5e5, 0.4}};
}

/// What happened on the way.
struct Course {
  double smallest_gap = 1e300;
  double largest_energy_error = 0;  ///< growth of the energy balance over the largest energy so far
  double largest_energy = 0;
  int most_pairs = 0;
  int crossings = 0;  ///< edges through triangles, whether contact was on or not
  int steps = 0;
  long iterations = 0;
  int halvings = 0;
};

double total(const EnergyLedger& e)
{
  return e.kinetic + e.elastic + e.contact + e.damping_work - e.external_work;
}

/// March to t_end; a step that finds no equilibrium is repeated with half its length, as the time loop does.
Course march(Dynamics& dynamics, double dt, double t_end, const std::vector<ContactSheet>& seen_by_the_check,
             const ContactOptions* contact = nullptr)
{
  const ContactPieces pieces(seen_by_the_check);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(3 * dynamics.shell().n_vertices());
  const double start = total(dynamics.ledger());
  Course course;
  int rejections = 0;
  while (dynamics.accepted().t < t_end * (1 - 1e-9)) {
    const double step = std::ldexp(dt, -rejections), t = dynamics.accepted().t + step;
    try {
      const Dynamics::Trial trial = dynamics.solve(t, step, none, dynamics.predicted_positions(step));
      dynamics.accept(trial.positions, t, step, none);
      course.iterations += trial.report.iterations;if(course.steps%5==0||trial.report.iterations>8){std::printf("t %g its %d fact %d pairs %d gap %g:",t,trial.report.iterations,trial.report.factorisations,dynamics.contact()?dynamics.contact()->report().active_pairs:0,dynamics.contact()?dynamics.contact()->report().smallest_gap:0);for(double r:trial.report.residuals)std::printf(" %.1e",r);std::printf("\n");}
    } catch (const NonConvergence& error) {
      ++course.halvings;std::printf("halve %s\n",error.what());
      if (++rejections > 5)
        throw;
      continue;
    }
    rejections = 0;
    ++course.steps;
    const EnergyLedger& e = dynamics.ledger();
    course.largest_energy = std::max({course.largest_energy, e.kinetic + e.elastic + e.contact});
    course.largest_energy_error = std::max(course.largest_energy_error, total(e) - start);
    if (dynamics.contact() != nullptr) {
      course.smallest_gap = std::min(course.smallest_gap, dynamics.contact()->report().smallest_gap);
      course.most_pairs = std::max(course.most_pairs, dynamics.contact()->report().active_pairs);
    }
    if (course.steps % 5 == 0) {
      Eigen::VectorXd z = dynamics.accepted().x;
      if (contact != nullptr && contact->body_positions) {
        const Eigen::VectorXd bodies = contact->body_positions(t);
        z.conservativeResize(z.size() + bodies.size());
        z.tail(bodies.size()) = bodies;
      }
      course.crossings += crossings(pieces, z, true).count;
    }
  }
  return course;
}

/// Two leaflets that stand on a common base 4 mm apart and are blown together by pressures from outside.
struct Leaflets {
  Leaflets()
  {
    mesh = test::sheet(side, side, 8, 8);
    const surface::TriangleMesh other = test::sheet(side, side, 7, 9);
    for (Vec3& X : mesh.vertices)
      X = Vec3(X.y(), -0.002, X.x());
    const int n = mesh.n_vertices();
    n_first = mesh.n_triangles();
    for (const Vec3& X : other.vertices)
      mesh.vertices.emplace_back(X.y(), 0.002, X.x());
    for (const auto& [a, b, c] : other.triangles)
      mesh.triangles.push_back({a + n, b + n, c + n});
  }

  /// The sign makes both press towards y = 0: normals of x-z sheets point to -y or +y alike for both.
  std::vector<Load> loads(double pressure) const
  {
    const auto ramp = [](double t) { return std::min(1.0, t / 0.01); };
    std::vector<int> first, second;
    for (int t = 0; t < mesh.n_triangles(); ++t)
      (t < n_first ? first : second).push_back(t);
    const double sign = surface::unit_normal(mesh, 0).y() > 0 ? 1 : -1;
    return {Pressure{first, [=](const Vec3&, double t) { return sign * pressure * ramp(t); }},
            Pressure{second, [=](const Vec3&, double t) { return -sign * pressure * ramp(t); }}};
  }

  Shell shell() const
  {
    Properties p = leaflet_properties();
    p.damping_mass = 20;
    return {mesh, p, {{.kind = SupportKind::Clamped,
                       .vertices = test::vertices_where(mesh, [](const Vec3& X) { return X.z() == 0; })}}, "leaflets"};
  }

  surface::TriangleMesh mesh;
  int n_first = 0;
};

constexpr ContactLaw leaflet_law{.distance = thickness, .stiffness = 2000};

TEST(Contact, OfTwoLeafletsBlownTogetherKeepsThemApart)
{
  const Leaflets leaflets;
  const Shell shell = leaflets.shell();
  DynamicsOptions options;
  options.contact = ContactOptions{.law = leaflet_law};
  Dynamics dynamics(shell, leaflets.loads(500), options);
  const Course course = march(dynamics, 5e-4, 0.08, {{"leaflets", leaflets.mesh, true}});
  std::printf("gap %g pairs %d its/step %.2f halvings %d energy %g error %g\n", course.smallest_gap, course.most_pairs, double(course.iterations)/course.steps, course.halvings, course.largest_energy, course.largest_energy_error);
  EXPECT_EQ(course.crossings, 0);
  EXPECT_GT(course.most_pairs, 50);
}

TEST(Contact, IsNeededForLeafletsThatAreBlownTogether)
{
  const Leaflets leaflets;
  const Shell shell = leaflets.shell();
  DynamicsOptions options;
  Dynamics dynamics(shell, leaflets.loads(500), options);
  const Course course = march(dynamics, 5e-4, 0.08, {{"leaflets", leaflets.mesh, true}});
  std::printf("crossings %d its/step %.2f\n", course.crossings, double(course.iterations)/course.steps);
  EXPECT_GT(course.crossings, 0);
}

}  // namespace
}  // namespace luff::shell
