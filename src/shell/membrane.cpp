// SPDX-License-Identifier: BSD-3-Clause
// Membrane strain smoothed over the edges of a triangle.
#include "shell/membrane.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace luff::shell {

namespace {

using Vec2 = Eigen::Vector2d;

/// Coordinates in the frame e1 = along the first side, e2 = N x e1 of a triangle and its neighbour across edge k, which
/// is turned about that edge into the plane.
struct Unfolded {
  Vec2 a, b, apex;
};

Unfolded unfold(const surface::TriangleMesh& mesh, int triangle, int k, const Vec3& apex)
{
  const auto& corner = mesh.triangles[triangle];
  const Vec3& X0 = mesh.vertices[corner[0]];
  const Vec3 e1 = (mesh.vertices[corner[1]] - X0).normalized();
  const Vec3 e2 = surface::unit_normal(mesh, triangle).cross(e1);
  const auto in_plane = [&](const Vec3& X) { return Vec2(e1.dot(X - X0), e2.dot(X - X0)); };
  const Vec3& A = mesh.vertices[corner[(k + 1) % 3]];
  const Vec3& B = mesh.vertices[corner[(k + 2) % 3]];
  const Vec3 along = (B - A).normalized();
  const double s = along.dot(apex - A);
  const double height = (apex - A - s * along).norm();
  const Vec2 a = in_plane(A), b = in_plane(B);
  const Vec2 t = (b - a).normalized();
  return {a, b, a + s * t + height * Vec2(t.y(), -t.x())};
}

/// Gradients of the area coordinates of a triangle in the plane.
Eigen::Matrix<double, 2, 3> gradients(const Unfolded& u)
{
  const Vec2 p = u.b - u.a, q = u.apex - u.a;
  const double twice_area = p.x() * q.y() - p.y() * q.x();
  Eigen::Matrix<double, 2, 3> g;
  const std::array<Vec2, 3> sides{u.apex - u.b, u.a - u.apex, u.b - u.a};
  for (int i = 0; i < 3; ++i)
    g.col(i) = Vec2(-sides[i].y(), sides[i].x()) / twice_area;
  return g;
}

int node_of_vertex(const Element& e, int vertex)
{
  for (int i = 0; i < e.n_nodes; ++i)
    if (e.vertex[i] == vertex && e.image[i] < 0)
      return i;
  ensure(false, "a neighbour's vertex is not in the bending stencil");
  return -1;
}

/// Resultants of the triangle's own share: N = sum (1 - share_k) N_k/3, M = sum M_k/3.
Resultants own_part(const SmoothedMembrane& membrane, const PerEdge<Resultants>& edges)
{
  Resultants own{Vec3::Zero(), Vec3::Zero()};
  for (int k = 0; k < 3; ++k) {
    own.N += (1 - membrane[k].share) / 3 * edges[k].N;
    own.M += edges[k].M / 3;
  }
  return own;
}

/// Derivatives of one edge's strain in the positions of the three corners and, if there is one, the apex.
struct EdgeDerivative {
  int n = 3;
  std::array<int, 4> node{0, 1, 2, 0};
  std::array<Mat3, 4> B;
};

EdgeDerivative edge_derivative(const Element& e, const ElementKinematics& k, const NeighbourMembrane& neighbour,
                               const Eigen::Matrix<double, 3, 2>& F)
{
  EdgeDerivative d;
  for (int i = 0; i < 3; ++i)
    d.B[i] = (1 - neighbour.share) * membrane_derivative(k.F, e.gradient.col(i));
  if (neighbour.share == 0)
    return d;
  d.n = 4;
  d.node[3] = neighbour.node[2];
  d.B[3] = neighbour.share * membrane_derivative(F, neighbour.gradient.col(2));
  for (int j = 0; j < 2; ++j)
    d.B[neighbour.node[j]] += neighbour.share * membrane_derivative(F, neighbour.gradient.col(j));
  return d;
}

}  // namespace

SmoothedMembrane smoothed_membrane(const surface::TriangleMesh& mesh, const surface::Topology& topology, int triangle,
                                   const Element& e, int first_vertex)
{
  SmoothedMembrane membrane;
  for (int k = 0; k < 3; ++k) {
    const int neighbour = topology.neighbour[triangle][k];
    if (neighbour < 0)
      continue;
    const int apex = mesh.triangles[neighbour][topology.neighbour_edge[triangle][k]];
    const double area = surface::area(mesh, neighbour);
    membrane[k].share = area / (e.area + area);
    membrane[k].node = {(k + 1) % 3, (k + 2) % 3, node_of_vertex(e, apex + first_vertex)};
    membrane[k].gradient = gradients(unfold(mesh, triangle, k, mesh.vertices[apex]));
  }
  return membrane;
}

SmoothedStrains smoothed_strains(const SmoothedMembrane& membrane, const ElementKinematics& k, const NodePositions& y)
{
  SmoothedStrains strains;
  for (int edge = 0; edge < 3; ++edge) {
    const NeighbourMembrane& neighbour = membrane[edge];
    strains.E[edge] = k.E_membrane;
    if (neighbour.share == 0)
      continue;
    Eigen::Matrix<double, 3, 2>& F = strains.F[edge];
    F.setZero();
    for (int j = 0; j < 3; ++j)
      F.noalias() += y.col(neighbour.node[j]) * neighbour.gradient.col(j).transpose();
    strains.E[edge] += neighbour.share * (green_lagrange(F) - k.E_membrane);
  }
  return strains;
}

NodeForces nodal_forces(const Element& e, const ElementKinematics& k, const SmoothedMembrane& membrane,
                        const SmoothedStrains& strains, const PerEdge<Resultants>& resultants)
{
  NodeForces f = nodal_forces(e, k, own_part(membrane, resultants));
  for (int edge = 0; edge < 3; ++edge) {
    const NeighbourMembrane& neighbour = membrane[edge];
    if (neighbour.share == 0)
      continue;
    const Eigen::Matrix<double, 3, 2> stress =
        first_piola(strains.F[edge], neighbour.share * e.area / 3 * resultants[edge].N);
    for (int j = 0; j < 3; ++j)
      f.col(neighbour.node[j]).noalias() += stress * neighbour.gradient.col(j);
  }
  return f;
}

ElementTangent material_tangent(const Element& e, const ElementKinematics& k, const SmoothedMembrane& membrane,
                                const SmoothedStrains& strains, const PerEdge<SectionStiffness>& D, bool coupled)
{
  const Eigen::Matrix<double, 3, max_nodes> rho = curvature_derivative(e, k);
  ElementTangent K;
  K.n = k.n;
  K.G = k.G;
  K.w.noalias() = rho.transpose() * (e.area / 3 * (D[0].bending + D[1].bending + D[2].bending) * rho);
  K.r.setZero();
  K.n_membrane = max_membrane_nodes;
  K.m.fill(Mat3::Zero());
  K.coupled = coupled;
  if (coupled)
    K.c.fill(decltype(K.c)::value_type::Zero());
  for (int edge = 0; edge < 3; ++edge) {
    const EdgeDerivative d = edge_derivative(e, k, membrane[edge], strains.F[edge]);
    for (int j = 0; j < d.n; ++j) {
      const Mat3 DB = e.area / 3 * (D[edge].membrane * d.B[j]);
      for (int i = 0; i < d.n; ++i)
        K.membrane(d.node[i], d.node[j]).noalias() += d.B[i].transpose() * DB;
      if (coupled)
        K.c[d.node[j]].noalias() += e.area / 3 * (D[edge].coupling * d.B[j]).transpose() * rho;
    }
  }
  return K;
}

void add_geometric_tangent(const Element& e, const ElementKinematics& k, const SmoothedMembrane& membrane,
                           const PerEdge<Resultants>& resultants, ElementTangent& K)
{
  add_geometric_tangent(e, k, own_part(membrane, resultants), K);
  for (int edge = 0; edge < 3; ++edge) {
    const NeighbourMembrane& neighbour = membrane[edge];
    if (neighbour.share == 0)
      continue;
    const Mat3 geometric = geometric_membrane(neighbour.gradient, neighbour.share * e.area / 3 * resultants[edge].N);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        K.membrane(neighbour.node[i], neighbour.node[j]).diagonal().array() += geometric(i, j);
  }
}

}  // namespace luff::shell
