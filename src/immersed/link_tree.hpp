// SPDX-License-Identifier: BSD-3-Clause
// Where sheets cross the segments that join cell centres of a curvilinear grid.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "grid/grid.hpp"
#include "immersed/crossings.hpp"
#include "immersed/predicates.hpp"
#include "parallel/decomposition.hpp"
#include "parallel/field.hpp"

namespace luff::immersed {

/// The links of a rank's cells under boxes of boxes, made once per grid.
///
/// find_crossings() gives what the function of that name gives on a rectilinear grid, with the same promise of being
/// watertight: the hits are those of exact arithmetic on centres moved by one infinitesimal (-e1, -e2, -e3), the same
/// for every link and triangle (docs/numerics/crossings.md).  Links are any segments; the grid may be left-handed.
///
/// A link that wraps around a periodic axis is searched at both ends of the domain, P moved by minus the period and N
/// by plus the period.  What is found is listed under face 0 and face `cells`.
class LinkTree {
 public:
  /// centres: of the owned cells, and in the halos those of the neighbours where they lie, not moved by a period.
  /// periods: how far a periodic axis moves the domain onto its next image; zero where it closes upon itself.
  LinkTree(const Decomposition& ranks, Field3<double> centres, const std::array<Vec3, 3>& periods);

  /// positions, triangles: as of the function find_crossings(), anywhere.  Local to the rank, serial; the same face
  /// gives the same bits on every rank.
  [[nodiscard]] std::vector<Crossing> find_crossings(std::span<const Vec3> positions,
                                                     std::span<const std::array<int, 3>> triangles) const;

 private:
  struct Box {
    std::array<float, 3> low;  ///< rounded outwards
    std::array<float, 3> high;
  };
  /// Boxes of blocks of links, i fastest; each level halves the number of blocks along every axis.
  struct Level {
    Index3 blocks;
    std::vector<Box> boxes;
  };
  /// The links through a box of faces normal to one axis, their ends P and N moved by `shift`.
  struct Branch {
    int axis;
    IndexBox faces;
    std::array<Vec3, 2> shift;
    std::vector<Level> levels;  ///< finest first
  };
  struct Triangle {
    Corners x;
    int number;
    Box box;
    Vec3 low, high;
  };

  void add_branch(int axis, const IndexBox& faces, const std::array<Vec3, 2>& shift);
  void add_levels(Branch& branch) const;
  [[nodiscard]] std::array<Vec3, 2> ends(const Branch& branch, const Index3& face) const;
  void visit(const Branch& branch, int level, const Index3& block, const Triangle& triangle,
             std::vector<Crossing>& found) const;
  void visit_links(const Branch& branch, const Index3& block, const Triangle& triangle,
                   std::vector<Crossing>& found) const;

  static Box box_around(std::span<const Vec3> points);
  static bool overlap(const Box& p, const Box& q);
  static IndexBox links_of_block(const Branch& branch, const Index3& block);

  Index3 cells_;
  Field3<double> centres_;
  std::vector<Branch> branches_;
};

/// The links of a curvilinear grid.  A period below round-off is that of a closed ring.  Collective.
[[nodiscard]] std::unique_ptr<const LinkTree> make_link_tree(const grid::Grid& grid);

}  // namespace luff::immersed
