// SPDX-License-Identifier: BSD-3-Clause
// A shell's energy, force, tangent, damping and mass: loops over its elements.
#include <algorithm>
#include <memory>
#include <variant>

#include "shell/element_response.hpp"
#include "shell/shell.hpp"

namespace luff::shell {

/// Null for the constant strain.
const SmoothedMembrane* Shell::membrane_of(const Element& e) const
{
  return e.smoothed < 0 ? nullptr : &smoothed_[e.smoothed];
}

NodePositions Shell::gather(const Element& e, const Eigen::VectorXd& x, const Images& images) const
{
  const Vec3 origin = x.segment<3>(3 * e.vertex[0]);
  NodePositions y;
  for (int i = 0; i < max_nodes; ++i)
    y.col(i) = x.segment<3>(3 * e.vertex[i]) - origin;
  if (e.has_images)
    for (int i = 3; i < e.n_nodes; ++i)
      if (e.image[i] >= 0) {
        const Image& image = images[e.image[i]];
        y.col(i) = image.T * x.segment<3>(3 * e.vertex[i]) + image.t - origin;
      }
  return y;
}

/// Calls body(section, element) with the section of the element's piece: the kind of section is chosen once per run.
template <class Body>
void Shell::for_each_element(Body body) const
{
  // Below this a parallel region costs more than it saves (measured).
  constexpr int worth_threads = 2000;
#pragma omp parallel if (reference_.n_triangles() > worth_threads)
  for (const std::vector<ElementRun>& colour : colours_) {
    const int n = static_cast<int>(colour.size());
#pragma omp for schedule(static)
    for (int r = 0; r < n; ++r)
      std::visit(
          [&, run = colour[r]](const auto& section) {
            for (int e = run.first; e < run.last; ++e)
              body(section, e);
          },
          sections_[colour[r].piece]);
  }
}

/// The same, one element after the other.
template <class Body>
void Shell::for_each_element_in_order(Body body) const
{
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    std::visit(
        [&](const auto& section) {
          for (int e = pieces_[p].first_triangle; e < pieces_[p].first_triangle + pieces_[p].n_triangles; ++e)
            body(section, e);
        },
        sections_[p]);
}

double Shell::elastic_energy(const Eigen::VectorXd& x, const Images& images) const
{
  double sum = springs_.energy(reference_positions_, x);
  for_each_element_in_order([&](const auto& section, int index) {
    const Element& e = elements_[index];
    sum += element_energy(section, e, membrane_of(e), gather(e, x, images));
  });
  return sum;
}

Eigen::VectorXd Shell::internal_force(const Eigen::VectorXd& x, const Images& images) const
{
  Eigen::VectorXd f = Eigen::VectorXd::Zero(x.size());
  for_each_element([&](const auto& section, int index) {
    const Element& e = elements_[index];
    const NodeForces nodal = element_force(section, e, membrane_of(e), gather(e, x, images));
    for (int i = 0; i < e.n_nodes; ++i) {
      if (e.image[i] < 0)
        f.segment<3>(3 * e.vertex[i]) += nodal.col(i);
      else
        f.segment<3>(3 * e.vertex[i]) += images[e.image[i]].T.transpose() * nodal.col(i);
    }
  });
  springs_.add_force(reference_positions_, x, f);
  return f;
}

/// Mean of the forces on the images at both ends times the way that T and t carry them, (T_1 - T_0) x + t_1 - t_0.
double Shell::image_work(const Eigen::VectorXd& x_0, const Images& images_0, const Eigen::VectorXd& x_1,
                         const Images& images_1) const
{
  double work = 0;
  for_each_element_in_order([&](const auto& section, int index) {
    const Element& e = elements_[index];
    if (!e.has_images)
      return;
    const auto forces = [&](const Eigen::VectorXd& x, const Images& images) {
      return element_force(section, e, membrane_of(e), gather(e, x, images));
    };
    const NodeForces mean = 0.5 * (forces(x_0, images_0) + forces(x_1, images_1));
    for (int i = 0; i < e.n_nodes; ++i)
      if (e.image[i] >= 0) {
        const Image &before = images_0[e.image[i]], &after = images_1[e.image[i]];
        const Vec3 x = 0.5 * (x_0.segment<3>(3 * e.vertex[i]) + x_1.segment<3>(3 * e.vertex[i]));
        work += mean.col(i).dot((after.T - before.T) * x + after.t - before.t);
      }
  });
  return work;
}

/// K += factor * tangent. Chain rule through the images, K_xx' = T' K_yy' T'.
void Shell::scatter(int index, const ElementTangent& tangent, const Images& images, double factor, BlockMatrix& K) const
{
  const Element& e = elements_[index];
  for (int i = 0; i < e.n_nodes; ++i)
    for (int j = 0; j < e.n_nodes; ++j) {
      Mat3 block = tangent.block(i, j);
      if (e.image[i] >= 0)
        block = (images[e.image[i]].T.transpose() * block).eval();
      if (e.image[j] >= 0)
        block = (block * images[e.image[j]].T).eval();
      K.block(slots_[index][max_nodes * i + j]) += factor * block;
    }
}

void Shell::add_tangent(const Eigen::VectorXd& x, const Images& images, BlockMatrix& K) const
{
  for_each_element([&](const auto& section, int index) {
    const Element& e = elements_[index];
    scatter(index, element_tangent(section, e, membrane_of(e), gather(e, x, images)), images, 1, K);
  });
  springs_.add_stiffness(x, K);
}

void Shell::add_material_stiffness(const Eigen::VectorXd& x, BlockMatrix& K) const
{
  add_material_stiffness(
      x, images_, [](const Properties&) { return 1.0; }, K);
}

template <class Factor>
void Shell::add_material_stiffness(const Eigen::VectorXd& x, const Images& images, Factor factor_of_piece,
                                   BlockMatrix& K) const
{
  for_each_element([&](const auto& section, int index) {
    const Element& e = elements_[index];
    const double factor = factor_of_piece(piece_of_vertex(e.vertex[0]).properties);
    if (factor == 0)
      return;
    scatter(index, element_stiffness(section, e, membrane_of(e), gather(e, x, images)), images, factor, K);
  });
}

bool Shell::is_damped() const
{
  return std::any_of(pieces_.begin(), pieces_.end(), [](const PieceRange& piece) {
    return piece.properties.damping_mass > 0 || piece.properties.damping_stiffness > 0;
  });
}

void Shell::add_damping(const Eigen::VectorXd& x, const Images& images, BlockMatrix& D) const
{
  for (int row = 0; row < mass_.outerSize(); ++row) {
    const double f_m = piece_of_vertex(row).properties.damping_mass;
    for (int s = mass_.outerIndexPtr()[row]; s < mass_.outerIndexPtr()[row + 1]; ++s)
      D.block(mass_slot_[s]).diagonal().array() += f_m * mass_.valuePtr()[s];
  }
  add_material_stiffness(
      x, images, [](const Properties& p) { return p.damping_stiffness; }, D);
}

Eigen::VectorXd Shell::mass_times(const Eigen::VectorXd& v) const
{
  using PerVertex = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  Eigen::VectorXd result(v.size());
  Eigen::Map<PerVertex>(result.data(), n_vertices(), 3).noalias() =
      mass_ * Eigen::Map<const PerVertex>(v.data(), n_vertices(), 3);
  return result;
}

void Shell::add_mass(double factor, BlockMatrix& K) const
{
  for (int s = 0; s < mass_.nonZeros(); ++s)
    K.block(mass_slot_[s]).diagonal().array() += factor * mass_.valuePtr()[s];
}

BlockMatrix Shell::mass_matrix() const
{
  const int* start = mass_.outerIndexPtr();
  const int* column = mass_.innerIndexPtr();
  const auto pattern = std::make_shared<BlockPattern>(
      BlockPattern{{start, start + n_vertices() + 1}, {column, column + mass_.nonZeros()}});
  BlockMatrix M(pattern);
  for (int s = 0; s < mass_.nonZeros(); ++s)
    M.block(s).diagonal().setConstant(mass_.valuePtr()[s]);
  return M;
}

}  // namespace luff::shell
