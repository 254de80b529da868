// SPDX-License-Identifier: BSD-3-Clause
#include "immersed/cut_links.hpp"

#include "immersed/cell_metric.hpp"
#include "surface/mesh.hpp"

#include <algorithm>
#include <cmath>

namespace luff::immersed {

namespace {

/// Value of a vertex field at a hit.
Vec3 interpolate(std::span<const Vec3> field, const std::array<int, 3>& triangle, const Crossing& hit)
{
  return hit.weights[0] * field[triangle[0]] + hit.weights[1] * field[triangle[1]] +
         hit.weights[2] * field[triangle[2]];
}

}  // namespace

CutLinks::CutLinks(const grid::Grid& grid)
    : grid_(grid),
      mark_{Field<int>(grid.owned(), open_link), Field<int>(grid.owned(), open_link),
            Field<int>(grid.owned(), open_link)}
{
}

void CutLinks::freeze(const SheetMotion& predicted, double dt, double speed, const View3<const double>& U_old)
{
  dt_ = dt;
  triangles_ = predicted.triangles;
  find_crossings(predicted.position);
  const std::size_t n = crossings_.size();
  normals_.resize(n);
  predicted_velocity_.resize(n);
  predicted_acceleration_.resize(n);
  for (std::size_t q = 0; q < n; ++q) {
    const auto& [a, b, c] = triangle(crossings_[q]);
    normals_[q] =
        surface::area_vector(predicted.position[a], predicted.position[b], predicted.position[c]).normalized();
    predicted_velocity_[q] = interpolate(predicted.velocity, triangle(crossings_[q]), crossings_[q]);
    predicted_acceleration_[q] = interpolate(predicted.acceleration, triangle(crossings_[q]), crossings_[q]);
  }
  velocity_ = predicted_velocity_;
  find_faces();
  find_cells();
  find_flipped();
  start_offsets(speed, U_old);
}

void CutLinks::find_crossings(std::span<const Vec3> positions)
{
  if (grid_.kind() != grid::Kind::Curvilinear) {
    crossings_ = immersed::find_crossings(grid_, positions, triangles_);
    return;
  }
  if (triangles_.empty()) {
    crossings_.clear();
    return;
  }
  if (!tree_)
    tree_ = make_link_tree(grid_);
  crossings_ = tree_->find_crossings(positions, triangles_);
}

void CutLinks::set_velocity(std::span<const Vec3> velocity)
{
  for (std::size_t q = 0; q < crossings_.size(); ++q)
    velocity_[q] = interpolate(velocity, triangle(crossings_[q]), crossings_[q]);
}

/// One face per cut link; hits on a link follow one another, ordered by theta.
void CutLinks::find_faces()
{
  for (const CutFace& face : faces_)
    mark_[face.axis].view()(face.cell) = open_link;
  faces_.clear();
  for (int q = 0; q < static_cast<int>(crossings_.size()); ++q) {
    const Crossing& hit = crossings_[q];
    if (!faces_.empty() && faces_.back().axis == hit.axis && faces_.back().cell == hit.cell) {
      faces_.back().last = q;
      continue;
    }
    mark_[hit.axis].view()(hit.cell) = static_cast<int>(faces_.size());
    faces_.push_back({.axis = hit.axis, .cell = hit.cell, .first = q, .last = q});
  }
}

void CutLinks::find_cells()
{
  std::vector<std::array<int, 3>> beside;  // k, j, i: sorted as the fields are stored
  for (const CutFace& face : faces_)
    for (const Index3& c : {face.cell, stepped(face.cell, face.axis, -1)})
      if (grid_.owned().contains(c))
        beside.push_back({c[2], c[1], c[0]});
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  cells_.resize(beside.size());
  for (std::size_t n = 0; n < beside.size(); ++n) {
    CutCell& cut = cells_[n];
    cut.cell = {beside[n][2], beside[n][1], beside[n][0]};
    for (int a = 0; a < 3; ++a) {
      cut.face[2 * a] = mark_[a].view()(cut.cell);
      cut.face[2 * a + 1] = mark_[a].view()(stepped(cut.cell, a, 1));
    }
  }
}

/// The sheet swept over a cell's centre when the cut moved from one of its faces to the opposite one.
void CutLinks::find_flipped()
{
  flipped_.clear();
  for (const CutCell& cut : cells_)
    for (int a = 0; a < 3; ++a) {
      const bool low = cut.face[2 * a] != open_link;
      const bool high = cut.face[2 * a + 1] != open_link;
      if (low == high)
        continue;
      const bool was_low = was_cut(a, cut.cell);
      const bool was_high = was_cut(a, stepped(cut.cell, a, 1));
      if (was_low != was_high && was_low != low) {
        flipped_.push_back(cut.cell);
        break;
      }
    }
}

void CutLinks::start_offsets(double speed, const View3<const double>& U_old)
{
  for (CutFace& face : faces_) {
    const Vec3& u_first = predicted_velocity_[face.first];
    const Vec3& u_last = predicted_velocity_[face.last];
    const double fastest = std::max({speed, u_first.norm(), u_last.norm()});
    face.decay_time = fastest > 0.0 ? distance_across(grid_, face.axis, face.cell) / fastest : dt_;
    if (const auto* old = old_offset(key(face.axis, face.cell))) {
      face.offset = old->second;
    } else {
      const auto [i, j, k] = face.cell;
      const Vec3 normal = face_normal(grid_, face.axis, face.cell);
      face.offset =
          U_old[face.axis](i, j, k) / grid_.area(face.axis, i, j, k) - 0.5 * (u_first.dot(normal) + u_last.dot(normal));
    }
  }
}

double CutLinks::face_velocity(const CutFace& face, const StageTime& time) const
{
  const Vec3 normal = face_normal(grid_, face.axis, face.cell);
  const double sheet = 0.5 * (velocity(face.first, time).dot(normal) + velocity(face.last, time).dot(normal));
  return sheet + face.offset * std::exp(-time.fraction * dt_ / face.decay_time);
}

void CutLinks::impose_fluxes(const StageTime& time, const View3<double>& U) const
{
  for (const CutFace& face : faces_) {
    const auto [i, j, k] = face.cell;
    U[face.axis](i, j, k) = grid_.area(face.axis, i, j, k) * face_velocity(face, time);
  }
}

void CutLinks::accept()
{
  accepted_offsets_.resize(faces_.size());
  for (std::size_t n = 0; n < faces_.size(); ++n) {
    const CutFace& face = faces_[n];
    accepted_offsets_[n] = {key(face.axis, face.cell), face.offset * std::exp(-dt_ / face.decay_time)};
  }
}

/// Position of a face in the order in which crossings are sorted.
std::int64_t CutLinks::key(int axis, const Index3& cell) const
{
  const Index3& n = grid_.cells();
  return ((std::int64_t{axis} * (n[2] + 1) + cell[2]) * (n[1] + 1) + cell[1]) * (n[0] + 1) + cell[0];
}

/// Whether a face is one of this rank's: low faces are their cell's, the last ones of the domain those of the cell
/// below.
bool CutLinks::keeps(std::int64_t key) const
{
  const Index3& n = grid_.cells();
  Index3 cell{};
  for (int a = 0; a < 3; key /= n[a] + 1, ++a)
    cell[a] = static_cast<int>(key % (n[a] + 1));
  const auto axis = static_cast<int>(key);
  if (cell[axis] == n[axis])
    --cell[axis];
  return grid_.owned().contains(cell);
}

FluxOffsets CutLinks::accepted_offsets() const
{
  FluxOffsets mine;
  for (const auto& [face, offset] : accepted_offsets_)
    if (keeps(face)) {
      mine.face.push_back(face);
      mine.offset.push_back(offset);
    }
  return mine;
}

void CutLinks::restore(const FluxOffsets& of_all_ranks)
{
  accepted_offsets_.clear();
  for (std::size_t n = 0; n < of_all_ranks.face.size(); ++n)
    accepted_offsets_.emplace_back(of_all_ranks.face[n], of_all_ranks.offset[n]);
  std::sort(accepted_offsets_.begin(), accepted_offsets_.end());
}

const std::pair<std::int64_t, double>* CutLinks::old_offset(std::int64_t key) const
{
  const auto at = std::lower_bound(accepted_offsets_.begin(), accepted_offsets_.end(), key,
                                   [](const auto& entry, std::int64_t k) { return entry.first < k; });
  return at != accepted_offsets_.end() && at->first == key ? &*at : nullptr;
}

}  // namespace luff::immersed
