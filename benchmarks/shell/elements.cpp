// SPDX-License-Identifier: BSD-3-Clause
// Linear benchmarks of the shell's curvatures and membrane strains on regular, alternating, irregular and Delaunay
// meshes. Usage: benchmark_shell_elements [LARGEST_N]    (64; prints comma-separated values, see the first line)
#include <cstdio>
#include <cstdlib>

#include "support/shell_benchmarks.hpp"

namespace {

using namespace luff;
using shell::BendingKind;
using shell::MembraneKind;
using surface::Pattern;

struct NamedBenchmark {
  const char* name;
  test::Benchmark run;
};

struct Element {
  const char* name;
  BendingKind bending;
  MembraneKind membrane;
};

struct Meshes {
  const char* name;
  Pattern pattern;
  int seeds;  ///< random meshes to run
};

constexpr NamedBenchmark benchmarks[] = {
    {"supported-plate", test::supported_plate},        {"clamped-plate", test::clamped_plate},
    {"plate-frequency", test::plate_frequency},        {"scordelis-lo", test::scordelis_lo_roof},
    {"pinched-cylinder", test::pinched_cylinder},      {"pinched-hemisphere", test::pinched_hemisphere},
    {"in-plane-cantilever", test::in_plane_cantilever}};

constexpr Element elements[] = {{"qavg", BendingKind::AveragedQuadratics, MembraneKind::ConstantStrain},
                                {"patch4", BendingKind::PatchQuadratic, MembraneKind::ConstantStrain},
                                {"hinge", BendingKind::Hinge, MembraneKind::ConstantStrain},
                                {"qavg+smoothed", BendingKind::AveragedQuadratics, MembraneKind::Smoothed}};

constexpr Meshes meshes[] = {{"diagonal", Pattern::Diagonal, 1},
                             {"alternating", Pattern::Alternating, 1},
                             {"irregular", Pattern::Irregular, 3},
                             {"delaunay", Pattern::Delaunay, 3}};

}  // namespace

int main(int argc, char** argv)
{
  const int largest = argc > 1 ? std::atoi(argv[1]) : 64;
  std::printf("benchmark,mesh,seed,element,n,computed_over_reference\n");
  for (const NamedBenchmark& benchmark : benchmarks)
    for (const Meshes& mesh : meshes)
      for (const Element& element : elements)
        for (int seed = 1; seed <= mesh.seeds; ++seed)
          for (int n = 8; n <= largest; n *= 2) {
            const double ratio =
                benchmark.run({n, mesh.pattern, static_cast<unsigned>(seed), element.bending, element.membrane});
            std::printf("%s,%s,%d,%s,%d,%.8g\n", benchmark.name, mesh.name, seed, element.name, n, ratio);
            std::fflush(stdout);
          }
  return 0;
}
