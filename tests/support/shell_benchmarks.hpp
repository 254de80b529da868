// SPDX-License-Identifier: BSD-3-Clause
// Small deflections of plates and shells with known answers, on any mesh and element.
#pragma once

#include <cmath>
#include <numbers>

#include "core/bounding_box.hpp"
#include "shell/shell.hpp"
#include "support/linear_shell.hpp"
#include "support/shells.hpp"

namespace luff::test {

/// How a benchmark is discretised: n squares along each side of its (part of a) surface.
struct Discretisation {
  int n = 8;
  surface::Pattern pattern = surface::Pattern::Irregular;
  unsigned seed = 7;
  shell::BendingKind bending = shell::BendingKind::AveragedQuadratics;
  shell::MembraneKind membrane = shell::MembraneKind::ConstantStrain;
};

/// A benchmark gives a displacement over its exact or published value.
using Benchmark = double (*)(const Discretisation&);

namespace benchmark {

using shell::Properties;
using shell::SaintVenantKirchhoff;
using shell::Shell;
using shell::SupportKind;
using std::numbers::pi;
using surface::TriangleMesh;

inline Properties properties(const Discretisation& d, double thickness, double young, double poisson)
{
  return {.thickness = thickness,
          .density = 1,
          .material = SaintVenantKirchhoff{young, poisson},
          .bending = d.bending,
          .membrane = d.membrane};
}

/// Mesh of [0, length] x [0, width], n by n, bent by `shape`.
template <class Shape>
TriangleMesh bent(const Discretisation& d, double length, double width, Shape shape)
{
  TriangleMesh mesh = sheet(length, width, d.n, d.n, d.pattern, d.seed);
  for (Vec3& X : mesh.vertices)
    X = shape(X.x(), X.y());
  return mesh;
}

/// Vertices in the plane X[axis] = at.
inline std::vector<int> plane(const TriangleMesh& mesh, int axis, double at)
{
  const double slack = 1e-9 * bounding_box(mesh.vertices).size();
  return vertices_where(mesh, [=](const Vec3& X) { return std::abs(X[axis] - at) < slack; });
}

inline shell::Support symmetric(const TriangleMesh& mesh, int axis, double at)
{
  return {.kind = SupportKind::Symmetry, .vertices = plane(mesh, axis, at), .normal = Vec3::Unit(axis)};
}

/// Force per area of the reference, a third of each triangle's on each of its corners.
inline Eigen::VectorXd uniform_load(const Shell& shell, const Vec3& traction)
{
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * shell.n_vertices());
  for (int t = 0; t < shell.reference().n_triangles(); ++t)
    for (const int v : shell.reference().triangles[t])
      f.segment<3>(3 * v) += surface::area(shell.reference(), t) / 3 * traction;
  return f;
}

/// Vertex nearest to a point.
inline int vertex_at(const TriangleMesh& mesh, const Vec3& point)
{
  return surface::select_vertices(mesh, surface::PointWhere{point}, "benchmark").front();
}

/// Unit square that moves along z only, zero on the outline.
inline Shell square_plate(const Discretisation& d, bool clamped)
{
  const TriangleMesh mesh = sheet(1, 1, d.n, d.n, d.pattern, d.seed);
  const std::vector<int> all = vertices_where(mesh, [](const Vec3&) { return true; });
  return Shell(mesh, properties(d, 0.01, 1e6, 0.3),
               {{.kind = SupportKind::Fixed, .vertices = all, .components = {true, true, false}},
                {.kind = clamped ? SupportKind::Clamped : SupportKind::Hinged, .vertices = outline(mesh, 1, 1)}});
}

inline double square_plate_stiffness()
{
  return 1e6 * 1e-6 / (12 * (1 - 0.3 * 0.3));
}

/// Volume under a uniformly loaded plate times D/q a^6.
inline double volume_under(const Shell& plate)
{
  const Eigen::VectorXd f = uniform_load(plate, Vec3::UnitZ());
  return f.dot(linear_displacement(plate, f)) * square_plate_stiffness();
}

/// Navier's series for the volume under a simply supported plate [timoshenko_1959_theory], section 30.
inline double navier_volume()
{
  double sum = 0;
  for (int m = 199; m >= 1; m -= 2)
    for (int n = 199; n >= 1; n -= 2)
      sum += 64 / (std::pow(pi, 8) * m * m * n * n * std::pow(m * m + n * n, 2));
  return sum;
}

}  // namespace benchmark

/// Volume under a simply supported square plate, uniform load.
inline double supported_plate(const Discretisation& d)
{
  return benchmark::volume_under(benchmark::square_plate(d, false)) / benchmark::navier_volume();
}

/// Volume under a clamped square plate, uniform load. Exact to its last digit: Ritz' method with (1 - x^2)^2 times
/// Legendre polynomials, degree 6 to 18.
inline double clamped_plate(const Discretisation& d)
{
  constexpr double exact = 3.8912008e-4;
  return benchmark::volume_under(benchmark::square_plate(d, true)) / exact;
}

/// Lowest angular frequency of the simply supported square plate, by inverse iteration.
inline double plate_frequency(const Discretisation& d)
{
  using namespace benchmark;
  const Shell plate = square_plate(d, false);
  shell::BlockMatrix K(plate.pattern());
  plate.add_tangent(plate.reference_positions(), K);
  const auto solver = shell::make_linear_solver(shell::LinearSolverKind::Direct, *plate.pattern(), plate.held());
  solver->factorise(K);
  Eigen::VectorXd v = uniform_load(plate, Vec3::UnitZ());
  double omega_squared = 0;
  for (int iteration = 0; iteration < 15; ++iteration) {
    const Eigen::VectorXd Mv = plate.mass_times(v);
    const Eigen::VectorXd next = solver->solve(Mv);
    omega_squared = next.dot(Mv) / next.dot(plate.mass_times(next));
    v = next / next.norm();
  }
  const double exact = 2 * pi * pi * std::sqrt(square_plate_stiffness() / 0.01);
  return std::sqrt(omega_squared) / exact;
}

/// Roof of a cylinder's part on end diaphragms under its weight; sag of the middle of the free edge over that of
/// Kirchhoff-Love shells [macneal_1985_proposed].
inline double scordelis_lo_roof(const Discretisation& d)
{
  using namespace benchmark;
  constexpr double radius = 25, half_length = 25, half_angle = 40 * pi / 180, published = 0.3006;
  const TriangleMesh mesh = bent(d, half_length, radius * half_angle, [](double x, double s) {
    return Vec3(x, radius * std::sin(s / radius), radius * std::cos(s / radius));
  });
  const Shell roof(mesh, properties(d, 0.25, 4.32e8, 0),
                   {{.kind = SupportKind::Fixed, .vertices = plane(mesh, 0, 0), .components = {false, true, true}},
                    symmetric(mesh, 0, half_length),
                    symmetric(mesh, 1, 0)});
  const Eigen::VectorXd u = linear_displacement(roof, uniform_load(roof, Vec3(0, 0, -90)));
  const Vec3 middle(half_length, radius * std::sin(half_angle), radius * std::cos(half_angle));
  return -u[3 * vertex_at(mesh, middle) + 2] / published;
}

/// Cylinder on end diaphragms pinched by two forces; displacement under them [macneal_1985_proposed].
inline double pinched_cylinder(const Discretisation& d)
{
  using namespace benchmark;
  constexpr double radius = 300, half_length = 300, published = 1.8248e-5;
  const TriangleMesh mesh = bent(d, half_length, radius * pi / 2, [](double x, double s) {
    return Vec3(x, radius * std::sin(s / radius), radius * std::cos(s / radius));
  });
  const Shell eighth(mesh, properties(d, 3, 3e6, 0.3),
                     {{.kind = SupportKind::Fixed, .vertices = plane(mesh, 0, 0), .components = {false, true, true}},
                      symmetric(mesh, 0, half_length),
                      symmetric(mesh, 1, 0),
                      symmetric(mesh, 2, 0)});
  const int top = vertex_at(mesh, Vec3(half_length, 0, radius));
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * mesh.n_vertices());
  f[3 * top + 2] = -0.25;
  return linear_displacement(eighth, f)[3 * top + 2] / -published;
}

/// Hemisphere with a hole of 18 degrees, pulled and pushed at four points of its equator; displacement under them
/// [macneal_1985_proposed], with the value 0.0935 that later studies settled on. `mesh`: a quarter.
inline double pinched_hemisphere_on(const surface::TriangleMesh& mesh, const Discretisation& d)
{
  using namespace benchmark;
  constexpr double radius = 10, published = 0.0935;
  const int pulled = vertex_at(mesh, Vec3(radius, 0, 0)), pushed = vertex_at(mesh, Vec3(0, radius, 0));
  const Shell quarter(mesh, properties(d, 0.04, 6.825e7, 0.3),
                      {symmetric(mesh, 0, 0),
                       symmetric(mesh, 1, 0),
                       {.kind = SupportKind::Fixed, .vertices = {pulled}, .components = {false, false, true}}});
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * mesh.n_vertices());
  f[3 * pulled] = 1;
  f[3 * pushed + 1] = -1;
  return linear_displacement(quarter, f)[3 * pulled] / published;
}

inline double pinched_hemisphere(const Discretisation& d)
{
  constexpr double radius = 10, height = 72 * benchmark::pi / 180;
  const auto on_sphere = [](double s, double t) {
    const double longitude = s / radius, latitude = t / radius;
    return Vec3(radius * std::cos(latitude) * std::cos(longitude), radius * std::cos(latitude) * std::sin(longitude),
                radius * std::sin(latitude));
  };
  return pinched_hemisphere_on(benchmark::bent(d, radius * benchmark::pi / 2, radius * height, on_sphere), d);
}

/// The same with spacings that grow `growth` times from the equator to the hole.
inline double pinched_hemisphere_graded(const Discretisation& d, double growth)
{
  return pinched_hemisphere_on(surface::sphere_cap({.radius = 10,
                                                    .polar = {18, 90},
                                                    .angle = {0, 90},
                                                    .divisions = {d.n, d.n},
                                                    .grading = {1, growth},
                                                    .pattern = d.pattern}),
                               d);
}

/// Slender cantilever bent in its own plane by an end force, n by n/5; deflection of the end over that of a beam with
/// shear. Shows the membrane alone.
inline double in_plane_cantilever(const Discretisation& d)
{
  using namespace benchmark;
  constexpr double length = 10, width = 1;
  const TriangleMesh mesh = sheet(length, width, d.n, std::max(2, d.n / 5), d.pattern, d.seed);
  const std::vector<int> all = vertices_where(mesh, [](const Vec3&) { return true; });
  const Shell beam(mesh, properties(d, 1, 1, 0),
                   {{.kind = SupportKind::Fixed, .vertices = all, .components = {false, false, true}},
                    {.kind = SupportKind::Hinged, .vertices = plane(mesh, 0, 0)}});
  const std::vector<int> end = plane(mesh, 0, length);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * mesh.n_vertices());
  for (const int v : end)
    f[3 * v + 1] = 1.0 / static_cast<double>(end.size());
  const double exact = 4 * std::pow(length / width, 3) + length / width * 2 * 6 / 5;
  return f.dot(linear_displacement(beam, f)) / exact;
}

}  // namespace luff::test
