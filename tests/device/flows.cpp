// SPDX-License-Identifier: BSD-3-Clause
// Whole flows whose kernels run on the GPU, and everything else on the processor.
#include "device/findings.hpp"
#include "support/curvilinear.hpp"
#include "support/exact_flows.hpp"
#include "support/stretched_flow.hpp"

namespace luff::test {

namespace {

/// A pressure that starts from a sum of another rounding ends elsewhere within its tolerance.
constexpr double solved = 1e-9;

void find_state(const std::string& name, const TestFlow& flow, Findings& found)
{
  for (int d = 0; d < 3; ++d)
    found.push_back({name + ' ' + "uvw"[d], solved, values_of(flow.solver.state().u[d].view(), flow.grid.owned())});
  found.push_back({name + " p", solved, values_of(flow.solver.state().p.view(), flow.grid.owned())});
}

/// Taylor and Green's vortex in three dimensions.
Vec3 vortex(const Vec3& x, double)
{
  using std::numbers::pi;
  return {std::sin(2 * pi * x[0]) * std::cos(2 * pi * x[1]) * std::cos(2 * pi * x[2]),
          -std::cos(2 * pi * x[0]) * std::sin(2 * pi * x[1]) * std::cos(2 * pi * x[2]), 0.0};
}

void find_vortex(const std::string& name, TestFlow&& flow, Findings& found)
{
  flow.solver.start({vortex, false}, 0.0);
  flow.advance(0.004, 5);
  find_state(name, flow, found);
}

}  // namespace

void find_flows(Findings& found)
{
  constexpr int n = 32;
  const auto periodic = sides_of({true, true, true}, {});
  const fluid::FlowOptions options{.viscosity = 0.002};
  fluid::FlowOptions implicit = options;
  implicit.scheme = fluid::TimeScheme::NewtonKrylov;
  const auto faces = stretched_faces(0.0, 1.0, n, 0.0);
  const auto stretched = stretched_faces(0.0, 1.0, n, 0.3);
  find_vortex("uniform flow", {{faces, faces, faces}, periodic, options}, found);
  find_vortex("stretched flow", {{stretched, faces, stretched}, periodic, options}, found);
  find_vortex("implicit flow", {{stretched, faces, stretched}, periodic, implicit}, found);
  const Index3 cells{n, n, n};
  find_vortex("curvilinear flow", {cells, mapped_nodes(cells, Waved{}), periodic, options}, found);
  const Signature sheet = run_stretched_flow(MPI_COMM_WORLD, 5, /*with_sheet=*/true);
  found.push_back({"flow with a sheet", solved, sheet.values});
}

}  // namespace luff::test
