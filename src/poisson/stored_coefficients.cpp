// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/stored_coefficients.hpp"

#include <algorithm>

namespace luff::poisson {

StoredCoefficients::StoredCoefficients(const Layout& layout, const std::array<Line, 3>& lines)
    : layout_(layout),
      cells_{lines[0].n, lines[1].n, lines[2].n},
      periodic_{lines[0].periodic, lines[1].periodic, lines[2].periodic},
      face_{Values(layout.size), Values(layout.size), Values(layout.size)}
{
}

void StoredCoefficients::load(const IndexBox& box, const Source& source)
{
  for (int a = 0; a < 3; ++a) {
    IndexBox faces = box;
    faces.hi[a] += !periodic_[a] && box.hi[a] == cells_[a] ? 1 : 0;
#pragma omp parallel for schedule(static) num_threads(threads_for(box))
    for (int k = faces.lo[2]; k < faces.hi[2]; ++k)
      for (int j = faces.lo[1]; j < faces.hi[1]; ++j)
        for (int i = faces.lo[0]; i < faces.hi[0]; ++i)
          face_[a][layout_.index(i, j, k)] = static_cast<float>(source(a, {i, j, k}));
  }
}

void StoredCoefficients::load(std::span<const FaceIndex> faces, const Source& source)
{
  for (const FaceIndex& f : faces)
    face_[f.axis][layout_.index(f.cell)] = static_cast<float>(source(f.axis, f.cell));
}

void StoredCoefficients::clear()
{
  for (Values& values : face_)
    std::fill_n(values.data(), values.size(), 0.0f);
}

void StoredCoefficients::close(RowExchange& exchange)
{
  for (Values& values : face_)
    exchange.exchange_with_edges(values.data());
}

double StoredCoefficients::coefficient(const Index3& cell, int side) const
{
  if (layout_.owned.contains(cell))
    return face(side / 2, stepped(cell, side / 2, side % 2));
  return shared_coefficients_[shared_.find(key(cell))][side];
}

void StoredCoefficients::share_cells(const std::vector<Index3>& cells, MPI_Comm comm)
{
  shared_ = CellMap{};
  shared_coefficients_.assign(cells.size(), {});
  for (std::size_t n = 0; n < cells.size(); ++n) {
    shared_.insert(key(cells[n]), static_cast<int>(n));
    for (int side = 0; side < 6 && layout_.owned.contains(cells[n]); ++side)
      shared_coefficients_[n][side] = static_cast<float>(coefficient(cells[n], side));
  }
  MPI_Allreduce(MPI_IN_PLACE, shared_coefficients_.data(), static_cast<int>(6 * cells.size()), MPI_FLOAT, MPI_SUM,
                comm);
}

double StoredCoefficients::diagonal_squares() const
{
  double sum = 0.0;
  for_each_cell_in_order(layout_.owned, [&](int i, int j, int k) {
    double diagonal = 0.0;
    for (int side = 0; side < 6; ++side)
      diagonal += coefficient({i, j, k}, side);
    sum += diagonal * diagonal;
  });
  return sum;
}

}  // namespace luff::poisson
