// SPDX-License-Identifier: BSD-3-Clause
// CPU time per triangle of the shell's force and tangent, with the constant and the smoothed membrane strain, and of a
// time step and its repetition. Usage: benchmark_shell_assembly [DIVISIONS]
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "shell/dynamics.hpp"
#include "support/shells.hpp"

namespace {

using namespace luff;

/// Mean CPU seconds of `repetitions` calls.
template <class Work>
double seconds(int repetitions, Work work)
{
  const std::clock_t start = std::clock();
  for (int i = 0; i < repetitions; ++i)
    work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / repetitions;
}

void time_assembly(const shell::Shell& flag)
{
  const Eigen::VectorXd x = flag.reference_positions() + 1e-3 * test::random_vector(3 * flag.n_vertices(), 1);
  const double n = flag.reference().n_triangles();
  shell::BlockMatrix K(flag.pattern());
  double sum = 0;
  std::printf("force            %8.3f us per triangle\n",
              1e6 / n * seconds(200, [&] { sum += flag.internal_force(x)[0]; }));
  std::printf("force + tangent  %8.3f us per triangle\n", 1e6 / n * seconds(50, [&] {
                                                            sum += flag.internal_force(x)[0];
                                                            K.set_zero();
                                                            flag.add_tangent(x, K);
                                                          }));
  std::printf("(checksum %g)\n", sum);
}

void time_steps(const shell::Shell& flag)
{
  constexpr double dt = 0.005;
  constexpr int steps = 40;
  shell::Dynamics dynamics(flag, {});
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(3 * flag.n_vertices());
  const Eigen::VectorXd gust = 1e-5 * flag.reference_positions();
  double first = 0, repeated = 0;
  int iterations = 0, factorisations = 0;
  for (int n = 1; n <= steps; ++n) {
    shell::Dynamics::Trial trial{dynamics.predicted_positions(dt), {}};
    first += seconds(1, [&] { trial = dynamics.solve(n * dt, dt, none, trial.positions); });
    iterations += trial.report.iterations;
    factorisations += trial.report.factorisations;
    repeated += seconds(1, [&] { dynamics.solve(n * dt, dt, gust, trial.positions); });
    dynamics.accept(trial.positions, n * dt, dt, none);
  }
  std::printf("first solve of a step %8.3f ms (%.1f iterations, %.2f factorisations), repeated %8.3f ms\n",
              1e3 * first / steps, static_cast<double>(iterations) / steps, static_cast<double>(factorisations) / steps,
              1e3 * repeated / steps);
}

}  // namespace

int main(int argc, char** argv)
{
  const int divisions = argc > 1 ? std::atoi(argv[1]) : 20;
  const surface::TriangleMesh mesh = test::sheet(1, 1, divisions, divisions);
  const std::vector<int> edge = test::vertices_where(mesh, [](const Vec3& X) { return X.x() == 0; });
  shell::Properties properties{
      .thickness = 0.01, .density = 100, .material = shell::SaintVenantKirchhoff{1e6, 0.4}, .gravity = Vec3(0, 0, -1)};
  const std::vector<shell::Support> clamp{{.kind = shell::SupportKind::Clamped, .vertices = edge}};
  const shell::Shell flag(mesh, properties, clamp);
  properties.membrane = shell::MembraneKind::Smoothed;
  const shell::Shell smoothed(mesh, properties, clamp);
  std::printf("%d triangles\n", mesh.n_triangles());
  time_assembly(flag);
  time_steps(flag);
  std::printf("smoothed membrane strain:\n");
  time_assembly(smoothed);
  time_steps(smoothed);
  return 0;
}
