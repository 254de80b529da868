// SPDX-License-Identifier: BSD-3-Clause
// Contact of shells with each other, with themselves and with rigid bodies.
#include "shell/contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "shell/contact/advancement.hpp"

namespace luff::shell {

Contact::Contact(std::span<const ContactSheet> sheets, const ContactLaw& law) : pieces_(sheets), law_(law)
{
  check_law();
  check_reference();
}

void Contact::check_law() const
{
  if (!(law_.distance > 0 && std::isfinite(law_.distance)))
    fail_input("contact.distance = {} must be greater than 0 and finite", law_.distance);
  if (!(law_.stiffness > 0 && std::isfinite(law_.stiffness)))
    fail_input("contact.stiffness = {} must be greater than 0 and finite", law_.stiffness);
  if (law_.distance > pieces_.shortest_mean_edge())
    fail_input(
        "contact.distance = {} must be at most the mean edge length of every shell, {:.6g} for '{}': pieces that far "
        "apart have several others in between; decrease contact.distance or coarsen the mesh",
        law_.distance, pieces_.shortest_mean_edge(), pieces_.finest_sheet());
}

void Contact::check_reference()
{
  const Crossings found = crossings(pieces_, pieces_.reference(), law_.self);
  if (found.count > 0)
    fail_input(
        "the surfaces cross each other at the start, at {} places, the first near {} ({:.6g}, {:.6g}, {:.6g}); contact "
        "needs a gap: move them apart",
        found.count, pieces_.name_of(found.vertex), found.place.x(), found.place.y(), found.place.z());
  gather(pieces_.reference(), 0);
  for (const ContactPair& pair : pairs_)
    if (!(pair.reach > 0)) {
      const Vec3 place = vertex(pieces_.reference(), pair.vertex[0]);
      fail_input(
          "the surfaces touch at the start, {} at ({:.6g}, {:.6g}, {:.6g}) and {}; contact needs a gap: move them "
          "apart",
          pieces_.name_of(pair.vertex[0]), place.x(), place.y(), place.z(), pieces_.name_of(pair.vertex[3]));
    }
}

bool Contact::may_touch(int a, int b) const
{
  return (pieces_.deforms(a) || pieces_.deforms(b)) && (law_.self || pieces_.surface(a) != pieces_.surface(b));
}

void Contact::gather(const Eigen::VectorXd& x, double margin)
{
  ensure(x.size() == pieces_.reference().size(), "contact needs the positions of all vertices, rigid ones included");
  pairs_.clear();
  gather_point_triangles(x, margin);
  gather_edges(x, margin);
}

void Contact::gather_point_triangles(const Eigen::VectorXd& x, double margin)
{
  box_vertices(pieces_, x, points_);
  box_triangles(pieces_, x, triangles_);
  points_.grow(law_.distance + 2 * margin);
  sweep_(points_, triangles_, [&](int point, int triangle) {
    const auto& [a, b, c] = pieces_.triangles()[triangle];
    if (point == a || point == b || point == c || !may_touch(point, a))
      return;
    const double area = 0.5 * std::min(pieces_.vertex_area(point), 2 * pieces_.triangle_area(triangle));
    add_pair({{point, a, b, c}, PairKind::PointTriangle, area, law_.distance, 0}, x, margin);
  });
}

void Contact::gather_edges(const Eigen::VectorXd& x, double margin)
{
  // Of |a|^2 |b|^2: the sine of 13 degrees, squared. Symmetric meshes have many edges close to parallel.
  constexpr double nearly_parallel = 0.05;
  box_edges(pieces_, x, edges_);
  edges_.grow(0.5 * law_.distance + margin);
  const Eigen::VectorXd& X = pieces_.reference();
  sweep_(edges_, edges_, [&](int e, int f) {
    if (e >= f)
      return;  // visited both ways around
    const auto& [a, b] = pieces_.edges()[e];
    const auto& [c, d] = pieces_.edges()[f];
    if (a == c || a == d || b == c || b == d || !may_touch(a, c))
      return;
    const double area = 0.25 * std::min(pieces_.edge_area(e), pieces_.edge_area(f));
    const double lengths = (vertex(X, b) - vertex(X, a)).squaredNorm() * (vertex(X, d) - vertex(X, c)).squaredNorm();
    add_pair({{a, b, c, d}, PairKind::EdgeEdge, area, law_.distance, nearly_parallel * lengths}, x, margin);
  });
}

/// Keeps the pair if it can come within its reach. The reach needs the distance in the reference only when that is
/// short.
void Contact::add_pair(ContactPair pair, const Eigen::VectorXd& x, double margin)
{
  const double distance = closest(pair.kind, corners(x, pair.vertex)).distance;
  if (distance >= law_.distance + 2 * margin)
    return;
  const double at_rest = closest(pair.kind, corners(pieces_.reference(), pair.vertex)).distance;
  pair.reach = std::min(law_.distance, 0.5 * at_rest);
  if (distance < pair.reach + 2 * margin || at_rest == 0)
    pairs_.push_back(pair);
}

double Contact::energy(const Eigen::VectorXd& x) const
{
  double sum = 0;
  for (const ContactPair& pair : pairs_)
    sum += pair_energy(pair, corners(x, pair.vertex), law_.stiffness);
  return sum;
}

void Contact::add_gradient(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const
{
  for (const ContactPair& pair : pairs_) {
    const Corners y = corners(x, pair.vertex);
    if (closest(pair.kind, y).distance >= pair.reach)
      continue;
    const PairGradient g = pair_gradient(pair, y, law_.stiffness);
    for (int k = 0; k < 4; ++k)
      gradient.segment<3>(3 * pair.vertex[k]) += g.segment<3>(3 * k);
  }
}

void Contact::add_stiffness(const Eigen::VectorXd& x, ContactHessian kind, BlockMatrix& K) const
{
  const int n = K.pattern().n_rows();
  for (const ContactPair& pair : pairs_) {
    const Corners y = corners(x, pair.vertex);
    if (closest(pair.kind, y).distance >= pair.reach)
      continue;
    const PairHessian H = kind == ContactHessian::Exact ? exact_pair_hessian(pair, y, law_.stiffness)
                                                        : pair_hessian(pair, y, law_.stiffness);
    for (int k = 0; k < 4; ++k)
      for (int l = 0; l < 4; ++l)
        if (pair.vertex[k] < n && pair.vertex[l] < n)
          K.block(K.pattern().slot(pair.vertex[k], pair.vertex[l])) += H.block<3, 3>(3 * k, 3 * l);
  }
}

double Contact::safe_fraction(const Eigen::VectorXd& x, const Eigen::VectorXd& dx) const
{
  constexpr double keep = 0.5;
  double fraction = 1;
  for (const ContactPair& pair : pairs_)
    fraction = shell::safe_fraction(pair.kind, corners(x, pair.vertex), corners(dx, pair.vertex), keep, fraction);
  return fraction;
}

ContactReport Contact::report(const Eigen::VectorXd& x) const
{
  ContactReport report;
  for (const ContactPair& pair : pairs_) {
    const double distance = closest(pair.kind, corners(x, pair.vertex)).distance;
    if (distance >= pair.reach)
      continue;
    report.smallest_gap = std::min(report.smallest_gap, distance);
    ++report.active_pairs;
  }
  return report;
}

}  // namespace luff::shell
