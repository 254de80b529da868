// SPDX-License-Identifier: BSD-3-Clause
// Curvature of a triangle from the vertices around it.
#include "shell/bending_operator.hpp"

#include <algorithm>
#include <array>

#include "core/bounding_box.hpp"
#include "core/error.hpp"
#include "shell/patch_quadratic.hpp"

namespace luff::shell {

namespace {

using surface::Topology;
using surface::TriangleMesh;

/// A triangle and its neighbours: the quadratic through its corners 0..2 and the apices 3..5 across edges 0..2, and
/// which vertices these are.
struct Patch {
  std::array<int, 6> vertex;
  std::array<int, 6> image;
  std::array<bool, 6> present;
  std::array<bool, 3> mirrored;
  std::array<Image, 3> mirror;
  PatchQuadratic quadratic;
};

class Builder {
 public:
  Builder(BendingKind kind, const TriangleMesh& mesh, const Topology& topology, const std::vector<MirrorEdge>& mirrors,
          const Mat3& moduli, std::string_view shell)
      : kind_(kind),
        mesh_(mesh),
        topology_(topology),
        moduli_(moduli),
        shell_(shell),
        size_(bounding_box(mesh.vertices).size()),
        mirrors_(mirrors),
        mirror_of_(mesh.triangles.size(), {-1, -1, -1})
  {
    for (std::size_t m = 0; m < mirrors.size(); ++m)
      mirror_of_[mirrors[m].edge.triangle][mirrors[m].edge.edge] = static_cast<int>(m);
  }

  BendingOperator build()
  {
    for (int t = 0; t < mesh_.n_triangles(); ++t)
      patches_.push_back(make_patch(t));
    for (int t = 0; t < mesh_.n_triangles(); ++t)
      result_.stencils.push_back(kind_ == BendingKind::AveragedQuadratics ? averaged_stencil(t) : own_stencil(t));
    for (Image& image : result_.images)
      if (!moves(image))
        image.mirrors.clear();
    return std::move(result_);
  }

 private:
  // --- patches -------------------------------------------------------------------------------------------------------

  Patch make_patch(int t)
  {
    Patch p;
    std::array<Vec3, 6> Y;
    for (int k = 0; k < 3; ++k) {
      p.vertex[k] = mesh_.triangles[t][k];
      p.image[k] = -1;
      p.present[k] = true;
      Y[k] = mesh_.vertices[p.vertex[k]];
    }
    for (int k = 0; k < 3; ++k)
      Y[3 + k] = place_apex(t, k, p);
    if (const int k = folded_edge(Y); k >= 0)
      reject_fold(t, k);
    const std::array<bool, 3> missing{!p.present[3], !p.present[4], !p.present[5]};
    p.quadratic =
        kind_ == BendingKind::Hinge ? hinge_angles(Y, missing, moduli_) : patch_quadratic(Y, missing, moduli_);
    if (p.quadratic.conic > result_.worst_conic) {
      result_.worst_conic = p.quadratic.conic;
      result_.worst_triangle = t;
    }
    result_.n_replaced += p.quadratic.replaced ? 1 : 0;
    return p;
  }

  /// Apex across edge k: a neighbour's vertex, a mirror image, or a formal ghost beyond a free edge.
  Vec3 place_apex(int t, int k, Patch& p)
  {
    const auto [a, b] = surface::edge_vertices(mesh_.triangles[t], k);
    const int opposite = mesh_.triangles[t][k];
    const auto& X = mesh_.vertices;
    const int neighbour = topology_.neighbour[t][k];
    p.mirrored[k] = false;
    p.present[3 + k] = true;
    p.image[3 + k] = -1;
    if (neighbour >= 0) {
      p.vertex[3 + k] = mesh_.triangles[neighbour][topology_.neighbour_edge[t][k]];
      return X[p.vertex[3 + k]];
    }
    p.vertex[3 + k] = opposite;
    const int mirror = mirror_of_[t][k];
    if (mirror < 0) {
      p.present[3 + k] = false;
      return X[a] + X[b] - X[opposite];
    }
    p.mirrored[k] = true;
    p.mirror[k] = reflection(mirrors_[mirror].normal, X[a]);
    p.mirror[k].mirrors = {mirror};
    p.image[3 + k] = image_index(p.mirror[k]);
    return p.mirror[k].T * X[opposite] + p.mirror[k].t;
  }

  // --- curvature from the patch alone --------------------------------------------------------------------------------

  /// kappa = sum_k c_k (second derivatives of bubble k) . n
  std::vector<StencilEntry> own_stencil(int t)
  {
    const Patch& p = patches_[t];
    const Eigen::Matrix<double, 3, 6> H = p.quadratic.second_derivatives();
    std::vector<StencilEntry> stencil;
    for (int i = 0; i < 6; ++i)
      if (p.present[i])
        stencil.push_back({p.vertex[i], p.image[i], H.col(i)});
    return stencil;
  }

  // --- averaging over the edges ------------------------------------------------------------------------------------

  /// kappa = sum_k 2/h_k [ (s_k + s'_k)/2 - (slope of the flat triangle) ] . n  m (x) m.
  std::vector<StencilEntry> averaged_stencil(int t)
  {
    const Patch& p = patches_[t];
    std::vector<StencilEntry> stencil;
    for (int i = 0; i < 6; ++i)
      if (p.present[i])
        add(p.vertex[i], p.image[i], Vec3::Zero(), nullptr, stencil);
    for (int k = 0; k < 3; ++k) {
      const Vec3 weight = 2 / p.quadratic.height[k] * dyad(p.quadratic.m[k]);
      if (!p.present[3 + k]) {
        add_bubbles(p, k, -weight, nullptr, stencil);
        continue;
      }
      const Reflected mirror{p.mirror[k], p.vertex[(k + 1) % 3], p.vertex[(k + 2) % 3]};
      const Reflected* through = p.mirrored[k] ? &mirror : nullptr;
      const Patch& q = p.mirrored[k] ? p : patches_[topology_.neighbour[t][k]];
      const int edge = p.mirrored[k] ? k : topology_.neighbour_edge[t][k];
      const double share = share_of_neighbour(p, q);
      add_bubbles(p, k, -(1 - share) * weight, nullptr, stencil);
      add_flat_slope(p, p.quadratic.m[k], -share * weight, nullptr, stencil);
      add_bubbles(q, edge, share * weight, through, stencil);
      add_flat_slope(q, -q.quadratic.m[edge], share * weight, through, stencil);
    }
    return stencil;
  }

  /// A half; all where only the neighbour has a quadratic, nothing where only the triangle itself has one. Exactness
  /// and equilibrium need a single slope per edge, from whichever quadratics.
  static double share_of_neighbour(const Patch& own, const Patch& neighbour)
  {
    return own.quadratic.replaced == neighbour.quadratic.replaced ? 0.5 : own.quadratic.replaced ? 1 : 0;
  }

  /// The mirror of a supported edge and the two vertices on it, which are their own images.
  struct Reflected {
    Image image;
    int on_plane_a;
    int on_plane_b;
  };

  /// Part of the mid-edge slope that the bubbles add to the flat triangle's, (c_a + c_b - c_k)/(2 h_k), inward.
  void add_bubbles(const Patch& p, int k, const Vec3& weight, const Reflected* mirror, std::vector<StencilEntry>& out)
  {
    const PatchQuadratic& q = p.quadratic;
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    for (int i = 0; i < 6; ++i)
      if (p.present[i])
        add(p.vertex[i], p.image[i], (q.bubble(a, i) + q.bubble(b, i) - q.bubble(k, i)) / (2 * q.height[k]) * weight,
            mirror, out);
  }

  void add_flat_slope(const Patch& p, const Vec2& direction, const Vec3& weight, const Reflected* mirror,
                      std::vector<StencilEntry>& out)
  {
    for (int i = 0; i < 3; ++i)
      add(p.vertex[i], -1, p.quadratic.g[i].dot(direction) * weight, mirror, out);
  }

  void add(int vertex, int image, const Vec3& H, const Reflected* mirror, std::vector<StencilEntry>& out)
  {
    if (mirror && !(image < 0 && (vertex == mirror->on_plane_a || vertex == mirror->on_plane_b)))
      image = image_index(image < 0 ? mirror->image : compose(mirror->image, result_.images[image]));
    for (StencilEntry& entry : out)
      if (entry.vertex == vertex && entry.image == image) {
        entry.H += H;
        return;
      }
    out.push_back({vertex, image, H});
  }

  bool moves(const Image& image) const
  {
    return std::any_of(image.mirrors.begin(), image.mirrors.end(), [&](int m) { return mirrors_[m].motion >= 0; });
  }

  /// Number of an image, -1 for the identity; images that are equal, and stay so when supports move, share a number.
  int image_index(const Image& image)
  {
    constexpr double round_off = 1e-10;
    const auto same = [&](const Image& other) {
      return (image.T - other.T).norm() < round_off && (image.t - other.t).norm() < round_off * size_ &&
             (image.mirrors == other.mirrors || (!moves(image) && !moves(other)));
    };
    const bool there_and_back = image.mirrors.size() == 2 && image.mirrors[0] == image.mirrors[1];
    if (there_and_back || same({Mat3::Identity(), Vec3::Zero()}))
      return -1;
    for (std::size_t i = 0; i < result_.images.size(); ++i)
      if (same(result_.images[i]))
        return static_cast<int>(i);
    result_.images.push_back(image);
    return static_cast<int>(result_.images.size()) - 1;
  }

  // --- messages ----------------------------------------------------------------------------------------------------

  [[noreturn]] void reject_fold(int t, int k) const
  {
    const Vec3 at = surface::centroid(mesh_, t);
    fail_input(
        "shell '{}': triangles {} and {} at ({}, {}, {}) fold by more than 90 degrees over their common edge; "
        "refine the mesh there",
        shell_, t, topology_.neighbour[t][k], at.x(), at.y(), at.z());
  }

  BendingKind kind_;
  const TriangleMesh& mesh_;
  const Topology& topology_;
  const Mat3& moduli_;
  std::string_view shell_;
  double size_;
  const std::vector<MirrorEdge>& mirrors_;
  std::vector<std::array<int, 3>> mirror_of_;  ///< number of the mirror at each edge, or -1
  std::vector<Patch> patches_;
  BendingOperator result_;
};

}  // namespace

BendingOperator bending_operator(BendingKind kind, const TriangleMesh& mesh, const Topology& topology,
                                 const std::vector<MirrorEdge>& mirrors, const Mat3& moduli, std::string_view shell)
{
  return Builder(kind, mesh, topology, mirrors, moduli, shell).build();
}

}  // namespace luff::shell
