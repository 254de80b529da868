// SPDX-License-Identifier: BSD-3-Clause
// Curvature of a triangle from the vertices around it.
#include "shell/bending_operator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "core/error.hpp"

namespace luff::shell {

namespace {

using surface::Topology;
using surface::TriangleMesh;
using Vec2 = Eigen::Vector2d;
using Mat36 = Eigen::Matrix<double, 3, 6>;

constexpr double conic_replaced = 50;  // beyond it a fit is not used

/// Six-vertex patch of a triangle: its corners 0..2 and the apices 3..5 across edges 0..2.
struct Patch {
  std::array<int, 6> vertex;
  std::array<int, 6> image;
  std::array<bool, 6> present;
  std::array<Vec2, 3> g;  ///< gradients of the area coordinates in the triangle's plane
  std::array<double, 3> height;
  std::array<Vec2, 3> m;  ///< outward edge normals
  std::array<bool, 3> mirrored;
  std::array<Image, 3> mirror;
  bool replaced = false;  ///< the fit by hinge angles, because the six vertices lie near a conic
  Mat36 bubble;           ///< c_k = sum_i bubble(k, i) y_i: coefficients of the quadratic's edge bubbles
};

/// Second derivatives of the bubble L_a L_b in Voigt order, (2 a1 b1, 2 a2 b2, 2 (a1 b2 + a2 b1)).
Vec3 bubble_curvature(const Vec2& a, const Vec2& b)
{
  return {2 * a.x() * b.x(), 2 * a.y() * b.y(), 2 * (a.x() * b.y() + a.y() * b.x())};
}

Mat3 bubble_curvatures(const std::array<Vec2, 3>& g)
{
  Mat3 S;
  for (int k = 0; k < 3; ++k)
    S.col(k) = bubble_curvature(g[(k + 1) % 3], g[(k + 2) % 3]);
  return S;
}

/// (m1^2, m2^2, 2 m1 m2)
Vec3 dyad(const Vec2& m)
{
  return {m.x() * m.x(), m.y() * m.y(), 2 * m.x() * m.y()};
}

class Builder {
 public:
  Builder(BendingKind kind, const TriangleMesh& mesh, const Topology& topology, const std::vector<MirrorEdge>& mirrors,
          const Mat3& moduli, std::string_view shell)
      : kind_(kind),
        mesh_(mesh),
        topology_(topology),
        moduli_(moduli),
        shell_(shell),
        size_(surface::bounding_box(mesh.vertices).size()),
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
  // --- the quadratic through a patch -------------------------------------------------------------------------------

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
    const std::array<Vec2, 6> xi = project_on_plane(Y);
    set_gradients(xi, p);
    p.bubble = bubble_coefficients(t, xi, Y, p);
    apply_natural_condition(p);
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

  /// Coordinates in the frame e1 = along the first side, e2 = N x e1, origin at the first corner.
  static std::array<Vec2, 6> project_on_plane(const std::array<Vec3, 6>& Y)
  {
    const Vec3 e1 = (Y[1] - Y[0]).normalized();
    const Vec3 N = (Y[1] - Y[0]).cross(Y[2] - Y[0]).normalized();
    const Vec3 e2 = N.cross(e1);
    std::array<Vec2, 6> xi;
    for (int i = 0; i < 6; ++i)
      xi[i] = {e1.dot(Y[i] - Y[0]), e2.dot(Y[i] - Y[0])};
    return xi;
  }

  static void set_gradients(const std::array<Vec2, 6>& xi, Patch& p)
  {
    const Vec2 u = xi[1] - xi[0], v = xi[2] - xi[0];
    const double twice_area = u.x() * v.y() - u.y() * v.x();
    for (int k = 0; k < 3; ++k) {
      const Vec2 side = xi[(k + 2) % 3] - xi[(k + 1) % 3];
      p.g[k] = Vec2(-side.y(), side.x()) / twice_area;
      p.height[k] = 1 / p.g[k].norm();
      p.m[k] = -p.height[k] * p.g[k];
    }
  }

  /// c = M^-1 [-L(apices) | I] y with M_jk = bubble k at apex j; hinge angles where the six vertices are near a conic.
  Mat36 bubble_coefficients(int t, const std::array<Vec2, 6>& xi, const std::array<Vec3, 6>& Y, Patch& p)
  {
    Mat3 M, L;
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i)
        L(j, i) = (i == 0 ? 1.0 : 0.0) + p.g[i].dot(xi[3 + j] - xi[0]);
      if (!(L(j, j) < 0))
        reject_fold(t, j);
      M.row(j) << L(j, 1) * L(j, 2), L(j, 2) * L(j, 0), L(j, 0) * L(j, 1);
    }
    if (kind_ == BendingKind::Hinge)
      return hinge_coefficients(Y, p);
    const double conic =
        1 / std::max(Eigen::JacobiSVD<Mat3>(M).singularValues()(2), std::numeric_limits<double>::epsilon());
    if (conic > result_.worst_conic) {
      result_.worst_conic = conic;
      result_.worst_triangle = t;
    }
    p.replaced = conic > conic_replaced;
    if (p.replaced) {
      ++result_.n_replaced;
      return hinge_coefficients(Y, p);
    }
    Mat36 right;
    right << -L, Mat3::Identity();
    return M.inverse() * right;
  }

  /// kappa = sum_k 2 theta_k/(h_k + h'_k) m (x) m with the hinge angle theta_k from the two heights over edge k
  /// [grinspun_2006_computing], weights by height, written as bubble coefficients.
  static Mat36 hinge_coefficients(const std::array<Vec3, 6>& Y, const Patch& p)
  {
    Mat36 H = Mat36::Zero();
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      const Vec3 along = Y[b] - Y[a];
      const double s = along.dot(Y[k] - Y[a]) / along.squaredNorm();
      const double s_apex = along.dot(Y[3 + k] - Y[a]) / along.squaredNorm();
      const double h = p.height[k], h_apex = (Y[3 + k] - Y[a] - s_apex * along).norm();
      const Vec3 weight = 2 / (h + h_apex) * dyad(p.m[k]);
      H.col(3 + k) += weight / h_apex;
      H.col(k) += weight / h;
      H.col(a) -= weight * ((1 - s_apex) / h_apex + (1 - s) / h);
      H.col(b) -= weight * (s_apex / h_apex + s / h);
    }
    return bubble_curvatures(p.g).inverse() * H;
  }

  /// Ghosts beyond free edges take the place of least bending energy: H <- (I - V (V'CV)^-1 V'C) H with V the ghosts'
  /// columns, one column after the other. Equals a zero moment across the edge wherever the ghost was put.
  void apply_natural_condition(Patch& p) const
  {
    if (p.present[3] && p.present[4] && p.present[5])
      return;
    const Mat3 S = bubble_curvatures(p.g);
    Mat36 H = S * p.bubble;
    for (int k = 0; k < 3; ++k)
      if (!p.present[3 + k]) {
        const Vec3 v = H.col(3 + k);
        const Vec3 Cv = moduli_ * v;
        H -= (v * (Cv.transpose() * H) / v.dot(Cv)).eval();
      }
    for (int k = 0; k < 3; ++k)
      if (!p.present[3 + k])
        H.col(3 + k).setZero();
    p.bubble = S.inverse() * H;
  }

  // --- curvature from the patch alone --------------------------------------------------------------------------------

  /// kappa = sum_k c_k (second derivatives of bubble k) . n
  std::vector<StencilEntry> own_stencil(int t)
  {
    const Patch& p = patches_[t];
    const Mat36 H = bubble_curvatures(p.g) * p.bubble;
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
      const Vec3 weight = 2 / p.height[k] * dyad(p.m[k]);
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
      add_flat_slope(p, p.m[k], -share * weight, nullptr, stencil);
      add_bubbles(q, edge, share * weight, through, stencil);
      add_flat_slope(q, -q.m[edge], share * weight, through, stencil);
    }
    return stencil;
  }

  /// A half; all where only the neighbour has a quadratic, nothing where only the triangle itself has one. Exactness
  /// and equilibrium need a single slope per edge, from whichever quadratics.
  static double share_of_neighbour(const Patch& own, const Patch& neighbour)
  {
    return own.replaced == neighbour.replaced ? 0.5 : own.replaced ? 1 : 0;
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
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    for (int i = 0; i < 6; ++i)
      if (p.present[i])
        add(p.vertex[i], p.image[i], (p.bubble(a, i) + p.bubble(b, i) - p.bubble(k, i)) / (2 * p.height[k]) * weight,
            mirror, out);
  }

  void add_flat_slope(const Patch& p, const Vec2& direction, const Vec3& weight, const Reflected* mirror,
                      std::vector<StencilEntry>& out)
  {
    for (int i = 0; i < 3; ++i)
      add(p.vertex[i], -1, p.g[i].dot(direction) * weight, mirror, out);
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

Image reflection(const Vec3& normal, const Vec3& on_plane)
{
  return {Mat3::Identity() - 2 * normal * normal.transpose(), 2 * normal * normal.dot(on_plane)};
}

Image compose(const Image& outer, const Image& inner)
{
  Image both{outer.T * inner.T, outer.T * inner.t + outer.t, outer.mirrors};
  both.mirrors.insert(both.mirrors.end(), inner.mirrors.begin(), inner.mirrors.end());
  return both;
}

BendingOperator bending_operator(BendingKind kind, const TriangleMesh& mesh, const Topology& topology,
                                 const std::vector<MirrorEdge>& mirrors, const Mat3& moduli, std::string_view shell)
{
  return Builder(kind, mesh, topology, mirrors, moduli, shell).build();
}

}  // namespace luff::shell
