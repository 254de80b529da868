// SPDX-License-Identifier: BSD-3-Clause
// Time of one Newton iteration of a hinged square plate under pressure, in parts; see vs_calculix.py.
// Usage: benchmark_shell_newton DIVISIONS [STEPS [MESH_FILE]]
//   prints one line of JSON; writes the mesh to MESH_FILE, for another program to solve the same.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include "shell/loads.hpp"
#include "shell/newton.hpp"
#include "support/shells.hpp"

namespace {

using namespace luff;

constexpr double pressure = 1;
const shell::Properties plate_properties{
    .thickness = 0.01, .density = 1, .material = shell::SaintVenantKirchhoff{1e6, 0.3}};

/// CPU seconds of this process.
double now()
{
  std::timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void write_mesh(const surface::TriangleMesh& mesh, const char* file)
{
  std::ofstream out(file);
  out.precision(17);
  out << mesh.n_vertices() << ' ' << mesh.n_triangles() << '\n';
  for (const Vec3& X : mesh.vertices)
    out << X.x() << ' ' << X.y() << ' ' << X.z() << '\n';
  for (const auto& t : mesh.triangles)
    out << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
}

/// CPU seconds of the parts of all iterations.
struct Parts {
  double residual = 0;
  double tangent = 0;
};

}  // namespace

int main(int argc, char** argv)
{
  const int divisions = argc > 1 ? std::atoi(argv[1]) : 50;
  const int steps = argc > 2 ? std::atoi(argv[2]) : 4;
  const surface::TriangleMesh mesh = test::sheet(1, 1, divisions, divisions);
  if (argc > 3)
    write_mesh(mesh, argv[3]);
  const double start = now();
  const shell::Shell plate(mesh, plate_properties,
                           {{.kind = shell::SupportKind::Hinged, .vertices = test::outline(mesh, 1, 1)}});
  const shell::LoadsAtTime loads =
      shell::Loads(plate, {shell::Pressure{{}, [](const Vec3&, double) { return pressure; }}}).at(0);
  shell::KeptTangent tangent(plate, shell::LinearSolverKind::Direct);
  const double set_up = now() - start;

  Parts parts;
  Eigen::VectorXd x = plate.reference_positions();
  int iterations = 0;
  const double begin = now();
  for (int step = 1; step <= steps; ++step) {
    const double factor = static_cast<double>(step) / steps;
    const shell::Equilibrium equilibrium{
        .residual = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
          const double t = now();
          Eigen::VectorXd r = factor * loads.force(y) - plate.internal_force(y);
          parts.residual += now() - t;
          return r;
        },
        .tangent =
            [&](const Eigen::VectorXd& y, shell::BlockMatrix& K) {
              const double t = now();
              plate.add_tangent(y, K);
              loads.subtract_stiffness(y, factor, K);
              parts.tangent += now() - t;
            },
    };
    tangent.valid = false;
    iterations += newton(plate, equilibrium, {.tolerance = 1e-10, .slow = 0}, tangent, x, "benchmark").iterations;
  }
  const double total = now() - begin;
  const Eigen::VectorXd u = x - plate.reference_positions();
  std::printf(
      "{\"triangles\": %d, \"vertices\": %d, \"set_up\": %.6g, \"iterations\": %d, \"iteration\": %.6g, "
      "\"residual\": %.6g, \"tangent\": %.6g, \"linear\": %.6g, \"deflection\": %.9g}\n",
      mesh.n_triangles(), mesh.n_vertices(), set_up, iterations, total / iterations, parts.residual / iterations,
      parts.tangent / iterations, (total - parts.residual - parts.tangent) / iterations, u.maxCoeff());
  return 0;
}
