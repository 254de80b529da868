// SPDX-License-Identifier: BSD-3-Clause
// Compiled by nvcc and by the compiler of the processor.
#include <array>
#include <cmath>
#include <utility>

#include "device/findings.hpp"
#include "operators/line_factors.hpp"
#include "operators/momentum.hpp"
#include "operators/vector_algebra.hpp"

namespace luff::test {

namespace {

/// Any values, of both signs, halo included.
Field<double> waves(const IndexBox& owned, double phase)
{
  Field<double> field(owned);
  for_each_cell_in_order(owned.grown(1), [&, v = field.view()](int i, int j, int k) {
    v(i, j, k) = std::sin(0.7 * i + phase) * std::cos(0.4 * j - phase) + 0.3 * std::sin(1.1 * k + 0.2 * i * phase);
  });
  return field;
}

#ifdef __CUDACC__

void require(cudaError_t error)
{
  if (error != cudaSuccess)
    fail_run("the GPU: {}", cudaGetErrorString(error));
}

/// A field's values in memory of the GPU that the processor cannot reach: only kernels that run there can do without a
/// fault.
class Placed {
 public:
  explicit Placed(Field<double> field) : field_(std::move(field))
  {
    require(cudaMalloc(&memory_, bytes()));
    require(cudaMemcpy(memory_, first(), bytes(), cudaMemcpyHostToDevice));
  }
  Placed(Placed&& other) noexcept : field_(std::move(other.field_)), memory_(std::exchange(other.memory_, nullptr)) {}
  ~Placed() { cudaFree(memory_); }

  View<double> view()
  {
    View<double> view = field_.view();
    view.origin = memory_ + (view.origin - first());
    return view;
  }
  const Field<double>& fetched()
  {
    require(cudaMemcpy(first(), memory_, bytes(), cudaMemcpyDeviceToHost));
    return field_;
  }

 private:
  double* first()
  {
    const IndexBox box = field_.owned().grown(1);
    return &field_(box.lo[0], box.lo[1], box.lo[2]);
  }
  std::size_t bytes()
  {
    const IndexBox box = field_.owned().grown(1);
    return (&field_(box.hi[0] - 1, box.hi[1] - 1, box.hi[2] - 1) + 1 - first()) * sizeof(double);
  }

  Field<double> field_;
  double* memory_ = nullptr;
};

#else

class Placed {
 public:
  explicit Placed(Field<double> field) : field_(std::move(field)) {}
  View<double> view() { return field_.view(); }
  const Field<double>& fetched() { return field_; }

 private:
  Field<double> field_;
};

#endif

struct Placed3 {
  Placed3(const IndexBox& owned, double phase)
      : part{Placed(waves(owned, phase)), Placed(waves(owned, phase + 1.0)), Placed(waves(owned, phase + 2.0))}
  {
  }
  View3<double> views() { return {part[0].view(), part[1].view(), part[2].view()}; }
  View3<const double> read() { return {part[0].view(), part[1].view(), part[2].view()}; }
  void find(const std::string& name, const IndexBox& owned, Findings& found)
  {
    for (int d = 0; d < 3; ++d)
      found.push_back({name + ' ' + "xyz"[d], rounding, values_of(part[d].fetched().view(), owned)});
  }

  std::array<Placed, 3> part;
};

void find_maxima(const std::string& name, const grid::Grid& grid, Placed3& u, Placed3& U, Findings& found)
{
  found.push_back({name + ": largest speed", rounding, {operators::largest_speed(grid, u.read())}});
  found.push_back({name + ": convective rate", rounding, {operators::convective_rate(grid, U.read())}});
  found.push_back({name + ": diffusive rate", rounding, {operators::diffusive_rate(grid)}});
}

/// The rows of both sums are added in different orders.
void find_sums(const std::string& name, const grid::Grid& grid, Placed3& u, Findings& found)
{
  const View<const double> v = u.read()[0];
  const double squares =
      sum_cells(grid.owned(), [=] LUFF_KERNEL(int i, int j, int k) { return v(i, j, k) * v(i, j, k); });
  found.push_back({name + ": sum of squares", rounding, {squares}});
}

}  // namespace

int architecture_of_cells()
{
  Field<double> architecture({{0, 0, 0}, {1, 1, 1}}, -1.0);
  const View<double> result = architecture.view();
  for_each_cell(architecture.owned(), [=] LUFF_KERNEL(int i, int j, int k) {
#ifdef __CUDA_ARCH__
    result(i, j, k) = __CUDA_ARCH__ / 10;
#else
    result(i, j, k) = 0;
#endif
  });
  return static_cast<int>(result(0, 0, 0));
}

void find_operators(const std::string& name, const grid::Grid& grid, Findings& found)
{
  const IndexBox& owned = grid.owned();
  Placed3 u(owned, 0.1);
  Placed3 U(owned, 0.5);
  Placed3 rate(owned, 0.9);
  Placed3 du(owned, 1.3);
  operators::advance_momentum(grid, u.read(), U.read(), 0.01, Vec3(0.1, -0.2, 0.3),
                              {.new_rate = 0.02, .old_rate = -0.01}, rate.views(), du.views());
  rate.find(name + ": rate", owned, found);
  du.find(name + ": increment", owned, found);
  Placed3 at_faces(owned, 0.0);
  operators::interpolate_to_faces(grid, U.read(), du.read(), at_faces.views());
  at_faces.find(name + ": flux", owned, found);
  Placed3 recovered(owned, 0.0);
  operators::recover_velocity(grid, U.read(), recovered.views());
  recovered.find(name + ": velocity", owned, found);
  operators::LineFactors lines(grid, {{{true, false}, {true, true}, {false, false}}});
  lines.update(0.05, U.read(), 0.01);
  lines.solve(recovered.views());
  recovered.find(name + ": line solution", owned, found);
  operators::add_multiple(owned, 0.3, u.read(), recovered.views());
  operators::extrapolate(owned, u.read()[0], U.read()[0], 0.4, recovered.views()[1]);
  recovered.find(name + ": combination", owned, found);
  find_maxima(name, grid, u, U, found);
  find_sums(name, grid, u, found);
}

}  // namespace luff::test
