// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/skin.hpp"

#include <algorithm>
#include <utility>

#include "surface/topology.hpp"

namespace luff::simulation {

namespace {

/// Whether both ends stay on the same plane of symmetry: the material goes on behind it.
bool on_symmetry(const std::vector<HeldNormal>& held, int a, int b)
{
  const auto stays = [&](int vertex, int plane) {
    return std::any_of(held.begin(), held.end(),
                       [&](const HeldNormal& h) { return h.vertex == vertex && h.plane == plane; });
  };
  return std::any_of(held.begin(), held.end(), [&](const HeldNormal& h) { return h.vertex == a && stays(b, h.plane); });
}

}  // namespace

Skin::Skin(const surface::MarkedMesh& middle, double thickness, std::vector<HeldNormal> held)
    : n_middle_(middle.mesh.n_vertices()),
      half_(0.5 * thickness),
      held_(std::move(held)),
      middle_(middle.mesh.triangles)
{
  for (const auto& [a, b, c] : middle_)
    reference_.triangles.push_back({a, b, c});
  for (const auto& [a, b, c] : middle_)
    reference_.triangles.push_back({n_middle_ + a, n_middle_ + c, n_middle_ + b});
  make_rim(middle.mesh);
  reference_.vertices = positions(middle.mesh.vertices);
  carry_marks(middle.marks);
}

/// Two quadrilaterals for each boundary edge, from the + face to its middle and on to the - face.
void Skin::make_rim(const surface::TriangleMesh& middle)
{
  std::vector<std::pair<int, int>> edges;
  for (const auto& [triangle, edge] : surface::topology(middle).boundary) {
    const auto [a, b] = surface::edge_vertices(middle.triangles[triangle], edge);
    if (on_symmetry(held_, a, b))
      continue;
    edges.emplace_back(a, b);
    rim_.insert(rim_.end(), {a, b});
  }
  std::sort(rim_.begin(), rim_.end());
  rim_.erase(std::unique(rim_.begin(), rim_.end()), rim_.end());
  const auto on_rim = [&](int v) {
    return 2 * n_middle_ + static_cast<int>(std::lower_bound(rim_.begin(), rim_.end(), v) - rim_.begin());
  };
  const auto add_band = [&](int a, int b, int below_a, int below_b) {
    reference_.triangles.push_back({b, a, below_a});
    reference_.triangles.push_back({b, below_a, below_b});
  };
  for (const auto& [a, b] : edges) {
    add_band(a, b, on_rim(a), on_rim(b));
    add_band(on_rim(a), on_rim(b), n_middle_ + a, n_middle_ + b);
  }
}

void Skin::carry_marks(const surface::Marks& middle)
{
  marks_.repairs = middle.repairs;
  const int n_triangles = static_cast<int>(middle_.size());
  for (const auto& [name, vertices] : middle.sets.vertices)
    for (const int v : vertices) {
      std::vector<int>& all = marks_.sets.vertices[name];
      all.insert(all.end(), {v, n_middle_ + v});
      if (const auto at = std::lower_bound(rim_.begin(), rim_.end(), v); at != rim_.end() && *at == v)
        all.push_back(2 * n_middle_ + static_cast<int>(at - rim_.begin()));
    }
  for (const auto& [name, edges] : middle.sets.edges)
    for (const auto& [a, b] : edges)
      for (const int face : {0, n_middle_})
        marks_.sets.edges[name].push_back(surface::edge_key(face + a, face + b));
  for (const auto& [name, triangles] : middle.sets.triangles)
    for (const int t : triangles)
      marks_.sets.triangles[name].insert(marks_.sets.triangles[name].end(), {t, n_triangles + t});
  for (const auto& [name, directions] : middle.directions) {
    std::vector<Vec3>& all = marks_.directions[name];
    all = directions;
    all.insert(all.end(), directions.begin(), directions.end());
    all.resize(reference_.triangles.size(), Vec3::Zero());
  }
  surface::tidy(marks_.sets);
}

void Skin::keep_on_planes(std::vector<Vec3>& vectors) const
{
  for (const HeldNormal& held : held_)
    vectors[held.vertex] -= held.normal.dot(vectors[held.vertex]) * held.normal;
}

/// N of each vertex.
std::vector<Vec3> Skin::area_vectors(std::span<const Vec3> x) const
{
  std::vector<Vec3> N(n_middle_, Vec3::Zero());
  for (const auto& triangle : middle_) {
    const Vec3 area = surface::area_vector(x[triangle[0]], x[triangle[1]], x[triangle[2]]);
    for (const int v : triangle)
      N[v] += area;
  }
  keep_on_planes(N);
  return N;
}

std::vector<Vec3> Skin::beside(std::span<const Vec3> middle, std::span<const Vec3> out) const
{
  std::vector<Vec3> skin(2 * static_cast<std::size_t>(n_middle_) + rim_.size());
  for (int v = 0; v < n_middle_; ++v) {
    skin[v] = middle[v] + half_ * out[v];
    skin[n_middle_ + v] = middle[v] - half_ * out[v];
  }
  for (std::size_t r = 0; r < rim_.size(); ++r)
    skin[2 * n_middle_ + r] = middle[rim_[r]];
  return skin;
}

std::vector<Vec3> Skin::positions(std::span<const Vec3> x) const
{
  std::vector<Vec3> normals = area_vectors(x);
  for (Vec3& n : normals)
    n.normalize();
  return beside(x, normals);
}

std::vector<Vec3> Skin::rates(std::span<const Vec3> x, std::span<const Vec3> v) const
{
  std::vector<Vec3> dN(n_middle_, Vec3::Zero());  // of the area vectors xa x xb/2 + xb x xc/2 + xc x xa/2
  for (const auto& [a, b, c] : middle_) {
    const Vec3 area = 0.5 * ((v[b] - v[a]).cross(x[c] - x[a]) + (x[b] - x[a]).cross(v[c] - v[a]));
    for (const int corner : {a, b, c})
      dN[corner] += area;
  }
  keep_on_planes(dN);
  const std::vector<Vec3> N = area_vectors(x);
  std::vector<Vec3> turning(n_middle_);
  for (int p = 0; p < n_middle_; ++p) {
    const Vec3 n = N[p].normalized();
    turning[p] = (dN[p] - n.dot(dN[p]) * n) / N[p].norm();
  }
  return beside(v, turning);
}

std::vector<Vec3> Skin::forces(std::span<const Vec3> x, std::span<const Vec3> on_skin) const
{
  const std::vector<Vec3> N = area_vectors(x);
  std::vector<Vec3> force(n_middle_);
  std::vector<Vec3> on_N(n_middle_);  // what does the work of the couple on dN
  for (int p = 0; p < n_middle_; ++p) {
    force[p] = on_skin[p] + on_skin[n_middle_ + p];
    const Vec3 n = N[p].normalized();
    const Vec3 couple = half_ * (on_skin[p] - on_skin[n_middle_ + p]);
    on_N[p] = (couple - n.dot(couple) * n) / N[p].norm();
  }
  for (std::size_t r = 0; r < rim_.size(); ++r)
    force[rim_[r]] += on_skin[2 * n_middle_ + r];
  keep_on_planes(on_N);
  for (const auto& [a, b, c] : middle_) {
    const Vec3 w = on_N[a] + on_N[b] + on_N[c];
    force[a] += 0.5 * (x[b] - x[c]).cross(w);
    force[b] += 0.5 * (x[c] - x[a]).cross(w);
    force[c] += 0.5 * (x[a] - x[b]).cross(w);
  }
  return force;
}

}  // namespace luff::simulation
