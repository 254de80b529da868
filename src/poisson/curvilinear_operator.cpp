// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/curvilinear_operator.hpp"

#include <algorithm>
#include <cmath>

#include "operators/octant_closure.hpp"

namespace luff::poisson {

CurvilinearOperator::CurvilinearOperator(const Decomposition& ranks, const View<const double> (&G)[6],
                                         const SideConditions& sides)
    : ranks_(ranks),
      sides_(sides),
      halo_(ranks),
      open_(make_field3<double>(ranks.owned())),
      normal_(make_field3<double>(ranks.owned())),
      face_(make_field3<double>(ranks.owned())),
      cross_(make_field3<double>(ranks.owned()))
{
  std::copy(std::begin(G), std::end(G), G_.begin());
  close_sides();
  for_each_cell_in_order(ranks_.owned(), [&](int i, int j, int k) { close_cell({i, j, k}); });
  halo_.exchange(views(normal_));
  halo_.exchange(views(cross_));
  for (int a = 0; a < 3; ++a) {
    IndexBox box = ranks_.owned();
    box.hi[a] += ranks_.at_boundary(a, 1) ? 1 : 0;
    for_each_cell_in_order(box, [&](int i, int j, int k) { set_face({a, {i, j, k}}); });
  }
  halo_.exchange(views(face_));
}

/// Neumann sides, and both faces of a single periodic cell, which is its own neighbour.
bool CurvilinearOperator::stays_closed(const FaceIndex& f) const
{
  if (ranks_.periodic(f.axis))
    return ranks_.cells()[f.axis] == 1;
  return on_side(f) && sides_[f.axis][f.cell[f.axis] == 0 ? 0 : 1] == SideCondition::Neumann;
}

void CurvilinearOperator::close_sides()
{
  for (int a = 0; a < 3; ++a)
    for_each_cell_in_order(ranks_.owned().faces(a), [&](int i, int j, int k) {
      open_[a](i, j, k) = stays_closed({a, {i, j, k}}) ? 0.0 : 1.0;
    });
}

bool CurvilinearOperator::on_side(const FaceIndex& f) const
{
  return !ranks_.periodic(f.axis) && (f.cell[f.axis] == 0 || f.cell[f.axis] == ranks_.cells()[f.axis]);
}

/// A face across a periodic seam that has this rank on both ends is two of its faces.
void CurvilinearOperator::set_open(const FaceIndex& f, double open, std::vector<Index3>& touched)
{
  if (stays_closed(f))
    return;
  const int n = ranks_.cells()[f.axis];
  for (const int turn : ranks_.periodic(f.axis) ? std::vector{-n, 0, n} : std::vector{0}) {
    const Index3 image = stepped(f.cell, f.axis, turn);
    if (!ranks_.owned().faces(f.axis).contains(image))
      continue;
    open_[f.axis].view()(image) = open;
    for (const Index3& c : {image, stepped(image, f.axis, -1)})
      if (ranks_.owned().contains(c))
        touched.push_back(c);
  }
}

/// t_a: the mean of the closed parts of a cell's two faces.
double CurvilinearOperator::closed_half(int axis, const Index3& c) const
{
  const View<const double> open = open_[axis].view();
  return 0.5 * ((1.0 - open(c)) + (1.0 - open(stepped(c, axis, 1))));
}

/// Coefficients of one owned cell from its tensor and its closed faces.
void CurvilinearOperator::close_cell(const Index3& c)
{
  const auto g = [&](int a, int b) { return G_[a < b ? grid::symmetric(a, b) : grid::symmetric(b, a)](c); };
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const int e = (a + 2) % 3;
    normal_[a].view()(c) = operators::closed_normal(g(a, a), g(a, b), g(a, e), g(b, b), g(b, e), g(e, e),
                                                    closed_half(b, c), closed_half(e, c));
    cross_[pair_without(a)].view()(c) = operators::closed_cross(g(b, e), g(a, b), g(a, e), g(a, a), closed_half(a, c));
  }
}

/// a_f = (G'_aa(L) + G'_aa(R))/2 times the open part, of the one cell on sides of the domain.
void CurvilinearOperator::set_face(const FaceIndex& f)
{
  const View<const double> normal = std::as_const(normal_[f.axis]).view();
  const Index3 low = stepped(f.cell, f.axis, -1);
  const bool low_side = on_side(f) && f.cell[f.axis] == 0;
  const bool high_side = on_side(f) && !low_side;
  const double open = open_[f.axis].view()(f.cell);
  face_[f.axis].view()(f.cell) = open == 0.0 ? 0.0
                                 : low_side  ? normal(f.cell)
                                 : high_side ? normal(low)
                                             : open * (0.5 * (normal(low) + normal(f.cell)));
}

/// The faces that set_face may set: low ones of owned cells, and those on high sides.
void CurvilinearOperator::list_faces(std::span<const Index3> cells, std::vector<FaceIndex>& faces) const
{
  const IndexBox& owned = ranks_.owned();
  for (const Index3& c : cells)
    for (int a = 0; a < 3; ++a) {
      faces.push_back({a, c});
      Index3 high = stepped(c, a, 1);
      if (ranks_.periodic(a) && high[a] == ranks_.cells()[a])
        high[a] = 0;
      if (owned.contains(high) || high[a] == ranks_.cells()[a])
        faces.push_back({a, high});
    }
  // What changed beyond an edge of this rank's block changes the face on the edge.
  for (int a = 1; a < 3 && ranks_.size() > 1; ++a)
    if (ranks_.blocks(a) > 1 && !ranks_.at_boundary(a, 0)) {
      IndexBox edge = owned;
      edge.hi[a] = edge.lo[a] + 1;
      for_each_cell_in_order(edge, [&](int i, int j, int k) { faces.push_back({a, {i, j, k}}); });
    }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
}

double CurvilinearOperator::largest_cosine() const
{
  double square = 0.0;
  for (const auto& [a, b] : cross_pairs) {
    const auto G_aa = G_[a];
    const auto G_bb = G_[b];
    const auto G_ab = G_[grid::symmetric(a, b)];
    square = std::max(square, max_cells(ranks_.owned(), [=] LUFF_KERNEL(int i, int j, int k) {
                        return G_ab(i, j, k) * G_ab(i, j, k) / (G_aa(i, j, k) * G_bb(i, j, k));
                      }));
  }
  return std::sqrt(ranks_.max(square));
}

CurvilinearOperator::Changes CurvilinearOperator::set_blocked(std::span<const FaceIndex> faces)
{
  std::vector<FaceIndex> now(faces.begin(), faces.end());
  std::sort(now.begin(), now.end());
  std::vector<FaceIndex> opened, shut;
  std::set_difference(blocked_.begin(), blocked_.end(), now.begin(), now.end(), std::back_inserter(opened));
  std::set_difference(now.begin(), now.end(), blocked_.begin(), blocked_.end(), std::back_inserter(shut));
  blocked_ = std::move(now);
  Changes changes;
  for (const FaceIndex& f : opened)
    set_open(f, 1.0, changes.cells);
  for (const FaceIndex& f : shut)
    set_open(f, f.open, changes.cells);
  std::sort(changes.cells.begin(), changes.cells.end());
  changes.cells.erase(std::unique(changes.cells.begin(), changes.cells.end()), changes.cells.end());
  for (const Index3& c : changes.cells)
    close_cell(c);
  halo_.exchange(views(normal_));
  halo_.exchange(views(cross_));
  list_faces(changes.cells, changes.faces);
  std::erase_if(changes.faces, [&](const FaceIndex& f) {
    const double before = face_[f.axis].view()(f.cell);
    set_face(f);
    return face_[f.axis].view()(f.cell) == before;
  });
  halo_.exchange(views(face_));
  return changes;
}

}  // namespace luff::poisson
