// SPDX-License-Identifier: BSD-3-Clause
// CPU time of factorising the tangent of a hinged plate, against CHOLMOD's own factorisations of the same matrix.
// Usage: benchmark_shell_factorisation [DIVISIONS]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <cholmod.h>

#include "shell/free_unknowns.hpp"
#include "shell/multifrontal.hpp"
#include "support/shells.hpp"

namespace {

using namespace luff;

/// CPU milliseconds of a call.
template <class Work>
double milliseconds(Work work)
{
  const auto now = [] {
    std::timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  work();
  return now() - start;
}

/// Median of three.
template <class Work>
double repeated(Work work)
{
  std::array<double, 3> times{};
  for (double& t : times)
    t = milliseconds(work);
  std::sort(times.begin(), times.end());
  return times[1];
}

void time_cholmod(const shell::UpperTriangle& pattern, const std::vector<double>& values, bool supernodal, int ordering)
{
  cholmod_common common;
  cholmod_start(&common);
  common.supernodal = supernodal ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
  common.final_ll = supernodal;
  common.nmethods = 1;
  common.method[0].ordering = ordering;
  common.postorder = 1;
  cholmod_sparse* A =
      cholmod_allocate_sparse(pattern.size(), pattern.size(), pattern.row.size(), 1, 1, 1, CHOLMOD_REAL, &common);
  std::copy(pattern.start.begin(), pattern.start.end(), static_cast<int*>(A->p));
  std::copy(pattern.row.begin(), pattern.row.end(), static_cast<int*>(A->i));
  std::copy(values.begin(), values.end(), static_cast<double*>(A->x));
  cholmod_factor* L = nullptr;
  const double analysis = milliseconds([&] { L = cholmod_analyze(A, &common); });
  const double factorisation = repeated([&] { cholmod_factorize(A, L, &common); });
  std::printf("CHOLMOD %-10s %-17s analysis %8.2f ms, factorisation %9.2f ms\n",
              supernodal ? "supernodal" : "by column", ordering == CHOLMOD_AMD ? "minimum degree" : "nested dissection",
              analysis, factorisation);
  cholmod_free_factor(&L, &common);
  cholmod_free_sparse(&A, &common);
  cholmod_finish(&common);
}

void time_ours(const shell::UpperTriangle& pattern, const std::vector<double>& values)
{
  std::unique_ptr<shell::Multifrontal> factor;
  const double analysis = milliseconds([&] { factor = std::make_unique<shell::Multifrontal>(pattern); });
  const double factorisation = repeated([&] { factor->factorise(values); });
  Eigen::VectorXd u = Eigen::VectorXd::Ones(pattern.size());
  const double solution = milliseconds([&] { factor->solve(u); });
  std::printf("ours                                 analysis %8.2f ms, factorisation %9.2f ms, solution %.2f ms\n",
              analysis, factorisation, solution);
}

}  // namespace

int main(int argc, char** argv)
{
  const int divisions = argc > 1 ? std::atoi(argv[1]) : 50;
  const surface::TriangleMesh mesh = test::sheet(1, 1, divisions, divisions);
  const shell::Shell plate(mesh, {.thickness = 0.01, .density = 1, .material = shell::SaintVenantKirchhoff{1e6, 0.3}},
                           {{.kind = shell::SupportKind::Hinged, .vertices = test::outline(mesh, 1, 1)}});
  shell::BlockMatrix K(plate.pattern());
  plate.add_tangent(plate.reference_positions(), K);
  const shell::FreeUnknowns unknowns(plate.held());
  shell::FreeTriangle triangle(*plate.pattern(), unknowns);
  const std::vector<double>& values = triangle.values(K);
  std::printf("%d triangles, %d unknowns\n", mesh.n_triangles(), unknowns.size());
  for (const bool supernodal : {false, true})
    for (const int ordering : {CHOLMOD_AMD, CHOLMOD_METIS})
      time_cholmod(triangle.pattern(), values, supernodal, ordering);
  time_ours(triangle.pattern(), values);
  return 0;
}
