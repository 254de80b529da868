// SPDX-License-Identifier: BSD-3-Clause
// Contact of shells with each other, with themselves and with rigid bodies.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "shell/block_matrix.hpp"
#include "shell/contact/barrier.hpp"
#include "shell/contact/crossings.hpp"
#include "shell/contact/pieces.hpp"

namespace luff::shell {

enum class ContactHessian : char {
  GaussNewton,  ///< pair_hessian(): positive semi-definite
  Exact         ///< exact_pair_hessian(): indefinite
};

struct ContactLaw {
  double distance = 0;   ///< where the force begins [L], > 0
  double stiffness = 0;  ///< pressure at about half that distance [M/(L T^2)], > 0
  bool self = true;      ///< also between parts of one connected surface
};

/// The pairs that push each other.
struct ContactReport {
  double smallest_gap = std::numeric_limits<double>::infinity();  ///< [L]; infinity when there are none
  int active_pairs = 0;
};

/// The pairs of surface pieces that may touch and their barrier energy. Pairs of a point and a triangle stand for half
/// the smaller of the point's area and twice the triangle's, pairs of edges for a quarter of the smaller edge area.
///
/// Left out are pairs that share a vertex, pairs of rigid pieces and, without `self`, pairs of one connected surface.
/// A pair closer than 2 * distance in the reference acts from half its reference distance on, so that nothing is pushed
/// apart at rest, neighbouring pieces of a fine mesh included, and yet nothing can pass.
class Contact {
 public:
  /// \throws InputError when numbers are out of range, the distance exceeds the mean edge length of a sheet, or the
  /// sheets touch or cross in the reference.
  Contact(std::span<const ContactSheet> sheets, const ContactLaw& law);

  const ContactPieces& pieces() const { return pieces_; }
  const ContactLaw& law() const { return law_; }
  const std::vector<ContactPair>& pairs() const { return pairs_; }

  /// Renew the pairs: all that can come to push each other while no vertex is more than `margin` away from
  /// its place in x. Depends on x and margin only.
  void gather(const Eigen::VectorXd& x, double margin);

  /// Sum over the pairs; infinite when any touches [M L^2/T^2].
  double energy(const Eigen::VectorXd& x) const;
  /// gradient += that of energy(), all vertices.
  void add_gradient(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const;
  /// K += the Hessians of the pairs on the vertices of K, which must come first.
  void add_stiffness(const Eigen::VectorXd& x, ContactHessian kind, BlockMatrix& K) const;
  /// Largest part of the move dx, at most 1, that leaves every pair half its distance.
  double safe_fraction(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) const;
  ContactReport report(const Eigen::VectorXd& x) const;

 private:
  void check_law() const;
  void check_reference();
  void gather_point_triangles(const Eigen::VectorXd& x, double margin);
  void gather_edges(const Eigen::VectorXd& x, double margin);
  void add_pair(ContactPair pair, const Eigen::VectorXd& x, double margin);
  bool may_touch(int a, int b) const;

  ContactPieces pieces_;
  ContactLaw law_;
  std::vector<ContactPair> pairs_;
  Boxes points_, edges_, triangles_;
  Sweep sweep_;
};

}  // namespace luff::shell
