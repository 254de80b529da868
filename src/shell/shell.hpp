// SPDX-License-Identifier: BSD-3-Clause
// A shell: reference configuration, properties and supports; assembles energy, force, tangent and mass.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "shell/bending_operator.hpp"
#include "shell/block_matrix.hpp"
#include "shell/element.hpp"
#include "shell/membrane.hpp"
#include "shell/properties.hpp"
#include "shell/section.hpp"
#include "shell/support.hpp"
#include "surface/mesh.hpp"
#include "surface/topology.hpp"

namespace luff::shell {

/// A connected or unconnected mesh of one make. Pieces of one shell are solved together but share no vertex.
struct Piece {
  surface::TriangleMesh reference;
  Properties properties;
  std::vector<Support> supports{};
  std::string name = "shell";
  /// Direction of the material at each triangle, projected on it; empty: along the triangle's first side.
  std::vector<Vec3> fibres{};
};

/// Where a piece is among all vertices and triangles of its shell.
struct PieceRange {
  std::string name;
  Properties properties;
  int first_vertex = 0;
  int n_vertices = 0;
  int first_triangle = 0;
  int n_triangles = 0;
};

/// One or more pieces that are solved together. Vectors hold x0 y0 z0 x1 ... of all vertices, the held ones included
/// (3n numbers), the pieces one after the other. Results don't depend on the number of threads, to the last bit. The
/// object is immutable.
class Shell {
 public:
  /// \throws InputError for a bad mesh, property or support, naming the piece.
  explicit Shell(std::vector<Piece> pieces);
  /// One piece. \throws as above.
  Shell(surface::TriangleMesh reference, const Properties& properties, std::vector<Support> supports,
        std::string name = "shell");

  /// Of all pieces, joined by commas.
  const std::string& name() const { return name_; }
  const std::vector<PieceRange>& pieces() const { return pieces_; }
  const PieceRange& piece_of_vertex(int vertex) const;
  const surface::TriangleMesh& reference() const { return reference_; }
  /// In its own numbering.
  surface::TriangleMesh reference_of(const PieceRange& piece) const;
  const surface::Topology& topology() const { return topology_; }
  int n_vertices() const { return reference_.n_vertices(); }
  /// Diagonal of the bounding box of the largest piece's reference [L].
  double size() const { return size_; }
  const Eigen::VectorXd& reference_positions() const { return reference_positions_; }
  /// What supports hold, and where they take it.
  const Held& supports() const { return held_; }
  /// 3n flags: 1 where a component of the displacement is held.
  const std::vector<char>& held() const { return held_.flags; }
  const std::shared_ptr<const BlockPattern>& pattern() const { return pattern_; }
  const std::vector<Element>& elements() const { return elements_; }

  /// A boundary edge between the vertices a and b across which the shell continues as its mirror image.
  struct Mirror {
    surface::TriangleEdge edge;
    Vec3 normal;  ///< in the reference, unit
    int a, b;
    int motion;  ///< number of the motion, or -1
  };
  const std::vector<Mirror>& mirrors() const { return mirrors_; }
  /// Normal of a mirror at time t, turned with its support; a factor other than 1 takes that part of the motion.
  Vec3 normal_of(const Mirror& mirror, double t, double factor = 1) const;

  /// Images of vertices beyond clamped and symmetry edges at time t, with what supports hold in configuration x as they
  /// hold it; the reference's where no support moves. A factor other than 1 takes that part of the supports' motion.
  Images images_at(const Eigen::VectorXd& x, double t, double factor = 1) const;

  /// Of the shell and of elastic supports. Like the next ones with the images of the reference when none are given.
  double elastic_energy(const Eigen::VectorXd& x, const Images& images) const;
  double elastic_energy(const Eigen::VectorXd& x) const { return elastic_energy(x, images_); }
  /// Gradient of elastic_energy.
  Eigen::VectorXd internal_force(const Eigen::VectorXd& x, const Images& images) const;
  Eigen::VectorXd internal_force(const Eigen::VectorXd& x) const { return internal_force(x, images_); }
  /// K += Hessian of elastic_energy.
  void add_tangent(const Eigen::VectorXd& x, const Images& images, BlockMatrix& K) const;
  void add_tangent(const Eigen::VectorXd& x, BlockMatrix& K) const { add_tangent(x, images_, K); }
  /// K += the part A B'DB of the shell: positive semi-definite, without force on rigid motions.
  void add_material_stiffness(const Eigen::VectorXd& x, BlockMatrix& K) const;
  /// Work that the images do on the shell when they move while it goes from x_0 to x_1.
  double image_work(const Eigen::VectorXd& x_0, const Images& images_0, const Eigen::VectorXd& x_1,
                    const Images& images_1) const;
  /// Mass times a vector, M_ij = rho h A (1 + delta_ij)/12, or rho h A/3 on the diagonal where it is lumped.
  Eigen::VectorXd mass_times(const Eigen::VectorXd& v) const;
  /// K += factor * mass.
  void add_mass(double factor, BlockMatrix& K) const;
  /// The mass alone, on its own smaller pattern.
  BlockMatrix mass_matrix() const;
  /// Has any piece Rayleigh damping?
  bool is_damped() const;
  /// D += f_m M + f_k K_mat(x), with each piece's factors; K_mat as in add_material_stiffness.
  void add_damping(const Eigen::VectorXd& x, const Images& images, BlockMatrix& D) const;
  void add_damping(const Eigen::VectorXd& x, BlockMatrix& D) const { add_damping(x, images_, D); }

  /// Put zeros where the displacement is held.
  void clear_held(Eigen::VectorXd& v) const { held_.clear(v); }

  /// Largest conic degeneracy q of a bending patch, its triangle, and how many patches use hinge angles instead.
  double worst_conic() const { return worst_conic_; }
  int worst_conic_triangle() const { return worst_conic_triangle_; }
  int n_hinge_patches() const { return n_hinge_patches_; }

 private:
  /// Elements first .. last - 1 of one piece.
  struct ElementRun {
    int first;
    int last;
    int piece;
  };

  void append(Piece piece);
  void append_elements(const Piece& piece, const surface::Topology& topology, const BendingOperator& bending,
                       int first_vertex);
  const SmoothedMembrane* membrane_of(const Element& element) const;
  NodePositions gather(const Element& element, const Eigen::VectorXd& x, const Images& images) const;
  template <class Body>
  void for_each_element(Body body) const;
  template <class Body>
  void for_each_element_in_order(Body body) const;
  template <class Factor>
  void add_material_stiffness(const Eigen::VectorXd& x, const Images& images, Factor factor_of_piece,
                              BlockMatrix& K) const;
  void scatter(int element, const ElementTangent& tangent, const Images& images, double factor, BlockMatrix& K) const;
  void append_mirrors(const Piece& piece, const Constraints& constraints, int first_vertex);
  void make_pattern();
  void colour_elements();
  void colour_run(ElementRun run, std::vector<std::vector<char>>& taken);
  bool touches(ElementRun run, const std::vector<char>& vertices) const;
  void make_mass();

  std::string name_;
  surface::TriangleMesh reference_;
  surface::Topology topology_;
  std::vector<PieceRange> pieces_;
  std::vector<Section> sections_;  ///< of each piece
  double size_ = 0;
  Eigen::VectorXd reference_positions_;
  Held held_;
  Springs springs_;
  std::vector<Mirror> mirrors_;
  Images images_;  ///< of the reference
  std::vector<Element> elements_;
  std::vector<SmoothedMembrane> smoothed_;  ///< of the elements that name one
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<std::array<int, max_nodes * max_nodes>> slots_;  ///< of each element's blocks in the pattern
  std::vector<std::vector<ElementRun>> colours_;               ///< runs of one colour share no vertex
  Eigen::SparseMatrix<double, Eigen::RowMajor> mass_;          ///< n x n, the same for x, y and z
  std::vector<int> mass_slot_;                                 ///< of each entry of mass_ in the pattern
  double worst_conic_ = 0;
  int worst_conic_triangle_ = -1;
  int n_hinge_patches_ = 0;
};

}  // namespace luff::shell
