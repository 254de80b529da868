// SPDX-License-Identifier: BSD-3-Clause
// Membrane strain smoothed over the edges of a triangle.
#pragma once

#include <array>

#include "shell/element.hpp"
#include "shell/section.hpp"
#include "surface/mesh.hpp"
#include "surface/topology.hpp"

namespace luff::shell {

/// How the membrane strain is found.
///
/// | kind           | sees                    | in-plane bending | cost of a tangent |
/// |----------------|-------------------------|------------------|-------------------|
/// | ConstantStrain | the corners             | stiff            | 1                 |
/// | Smoothed       | the corners and apices  | right            | see docs          |
///
/// Both pass the patch test, and neither stores energy unless an edge changes its length or the surface bends.
enum class MembraneKind {
  ConstantStrain,  ///< that of the flat triangle
  Smoothed         ///< at each edge the mean, by area, of the two triangles on it [liu_2009_edge]
};

/// The triangle across an edge, unfolded into the plane of its neighbour.
struct NeighbourMembrane {
  double share = 0;                      ///< of its strain in the edge's, A'/(A + A'); 0 at the boundary
  std::array<int, 3> node{};             ///< its corners among the nodes of the element
  Eigen::Matrix<double, 2, 3> gradient;  ///< of its area coordinates in the frame of the element [1/L]
};

/// Neighbours across edges 0, 1, 2.
using SmoothedMembrane = std::array<NeighbourMembrane, 3>;

/// \param mesh the element's piece, in which it is `triangle`
/// \param first_vertex of the piece among the vertices the element counts
SmoothedMembrane smoothed_membrane(const surface::TriangleMesh& mesh, const surface::Topology& topology, int triangle,
                                   const Element& element, int first_vertex);

/// Strains at the three edges,
///
///   E_k = (A E + A' E')/(A + A'),
///
/// E and E' the constant strains of the two triangles in the frame of the one [liu_2009_edge].
struct SmoothedStrains {
  std::array<Vec3, 3> E;
  std::array<Eigen::Matrix<double, 3, 2>, 3> F;  ///< deformation gradients of the neighbours
};

SmoothedStrains smoothed_strains(const SmoothedMembrane& membrane, const ElementKinematics& k, const NodePositions& y);

/// One value per edge; the energy of the triangle is their mean times its area.
template <class Value>
using PerEdge = std::array<Value, 3>;

/// Forces that the edges' resultants make at the nodes.
NodeForces nodal_forces(const Element& element, const ElementKinematics& k, const SmoothedMembrane& membrane,
                        const SmoothedStrains& strains, const PerEdge<Resultants>& resultants);

/// As for the constant strain (element.hpp), from the stiffness at the edges.
ElementTangent material_tangent(const Element& element, const ElementKinematics& k, const SmoothedMembrane& membrane,
                                const SmoothedStrains& strains, const PerEdge<SectionStiffness>& D, bool coupled);

void add_geometric_tangent(const Element& element, const ElementKinematics& k, const SmoothedMembrane& membrane,
                           const PerEdge<Resultants>& resultants, ElementTangent& tangent);

}  // namespace luff::shell
