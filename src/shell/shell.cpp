// SPDX-License-Identifier: BSD-3-Clause
// A shell: reference configuration, properties and supports; assembles energy, force, tangent and mass.
#include "shell/shell.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "surface/validation.hpp"

namespace luff::shell {

namespace {

Eigen::Matrix<double, 2, 3> area_coordinate_gradients(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 e1 = (b - a).normalized();
  const Vec3 twice_area = (b - a).cross(c - a);
  const Vec3 N = twice_area.normalized();
  const Vec3 e2 = N.cross(e1);
  const Vec3 scaled = N / twice_area.norm();
  Eigen::Matrix<double, 2, 3> gradient;
  const std::array<Vec3, 3> sides{c - b, a - c, b - a};
  for (int i = 0; i < 3; ++i) {
    const Vec3 g = scaled.cross(sides[i]);
    gradient.col(i) << e1.dot(g), e2.dot(g);
  }
  return gradient;
}

}  // namespace

Shell::Shell(surface::TriangleMesh reference, const Properties& properties, std::vector<Support> supports,
             std::string name)
    : name_(std::move(name)), reference_(std::move(reference)), properties_(properties)
{
  surface::validate(reference_, "shell '" + name_ + "'");
  validate(properties_, name_);
  topology_ = surface::topology(reference_);
  size_ = surface::bounding_box(reference_.vertices).size();
  reference_positions_ = surface::interleaved(reference_.vertices);
  const Constraints held_and_mirrors = constraints(reference_, topology_, supports, name_);
  held_ = held_and_mirrors.held;
  const double h = properties_.thickness;
  const Mat3 C = plane_stress_moduli(properties_);
  rigidity_ = {h * C, h * h * h / 12 * C};
  make_elements(bending_operator(properties_.bending, reference_, topology_, held_and_mirrors.mirrors, C, name_));
  make_pattern();
  colour_elements();
  make_mass();
}

void Shell::make_elements(const BendingOperator& bending)
{
  images_ = bending.images;
  worst_conic_ = bending.worst_conic;
  worst_conic_triangle_ = bending.worst_triangle;
  n_hinge_patches_ = bending.n_replaced;
  for (int t = 0; t < reference_.n_triangles(); ++t) {
    const auto& stencil = bending.stencils[t];
    ensure(stencil.size() <= max_nodes, "a bending stencil has more nodes than the element holds");
    Element e;
    e.n_nodes = static_cast<int>(stencil.size());
    e.vertex.fill(stencil[0].vertex);
    e.image.fill(-1);
    e.H.setZero();
    for (int i = 0; i < e.n_nodes; ++i) {
      e.vertex[i] = stencil[i].vertex;
      e.image[i] = stencil[i].image;
      e.H.col(i) = stencil[i].H;
      e.has_images = e.has_images || e.image[i] >= 0;
    }
    const auto& corner = reference_.triangles[t];
    const auto& X = reference_.vertices;
    e.gradient = area_coordinate_gradients(X[corner[0]], X[corner[1]], X[corner[2]]);
    e.area = surface::area(reference_, t);
    e.kappa_0 = curvature(e, gather(e, reference_positions_));
    elements_.push_back(e);
  }
}

void Shell::make_pattern()
{
  std::vector<std::vector<int>> groups;
  for (const Element& e : elements_)
    groups.emplace_back(e.vertex.begin(), e.vertex.begin() + e.n_nodes);
  const auto pattern = std::make_shared<BlockPattern>(couple(n_vertices(), groups));
  slots_.resize(elements_.size());
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (int i = 0; i < elements_[e].n_nodes; ++i)
      for (int j = 0; j < elements_[e].n_nodes; ++j)
        slots_[e][max_nodes * i + j] = pattern->slot(elements_[e].vertex[i], elements_[e].vertex[j]);
  pattern_ = pattern;
}

/// Runs of consecutive elements, coloured greedily: runs of one colour share no vertex, so that they can add to shared
/// arrays in any order with the same bits. Runs rather than elements keep the memory they touch together (measured).
void Shell::colour_elements()
{
  constexpr int run_length = 64;
  std::vector<std::vector<char>> taken;  // per colour, per vertex
  const int n = static_cast<int>(elements_.size());
  for (int first = 0; first < n; first += run_length) {
    const ElementRun run{first, std::min(first + run_length, n)};
    std::size_t colour = 0;
    while (colour < taken.size() && touches(run, taken[colour]))
      ++colour;
    if (colour == taken.size()) {
      taken.emplace_back(n_vertices(), 0);
      colours_.emplace_back();
    }
    for (int e = run.first; e < run.last; ++e)
      for (const int v : elements_[e].vertex)
        taken[colour][v] = 1;
    colours_[colour].push_back(run);
  }
}

bool Shell::touches(ElementRun run, const std::vector<char>& vertices) const
{
  for (int e = run.first; e < run.last; ++e)
    for (const int v : elements_[e].vertex)
      if (vertices[v])
        return true;
  return false;
}

void Shell::make_mass()
{
  std::vector<Eigen::Triplet<double>> entries;
  for (int t = 0; t < reference_.n_triangles(); ++t)
    for (const int i : reference_.triangles[t])
      for (const int j : reference_.triangles[t])
        entries.emplace_back(i, j, properties_.mass_per_area() * elements_[t].area * (i == j ? 2 : 1) / 12);
  mass_.resize(n_vertices(), n_vertices());
  mass_.setFromTriplets(entries.begin(), entries.end());
  for (int row = 0; row < mass_.outerSize(); ++row)
    for (decltype(mass_)::InnerIterator entry(mass_, row); entry; ++entry)
      mass_slot_.push_back(pattern_->slot(row, static_cast<int>(entry.col())));
}

NodePositions Shell::gather(const Element& e, const Eigen::VectorXd& x) const
{
  const Vec3 origin = x.segment<3>(3 * e.vertex[0]);
  NodePositions y;
  for (int i = 0; i < max_nodes; ++i)
    y.col(i) = x.segment<3>(3 * e.vertex[i]) - origin;
  if (e.has_images)
    for (int i = 3; i < e.n_nodes; ++i)
      if (e.image[i] >= 0) {
        const Image& image = images_[e.image[i]];
        y.col(i) = image.T * x.segment<3>(3 * e.vertex[i]) + image.t - origin;
      }
  return y;
}

template <class Body>
void Shell::for_each_element(Body body) const
{
  // Below this a parallel region costs more than it saves (measured).
  constexpr int worth_threads = 2000;
#pragma omp parallel if (reference_.n_triangles() > worth_threads)
  for (const std::vector<ElementRun>& colour : colours_) {
    const int n = static_cast<int>(colour.size());
#pragma omp for schedule(static)
    for (int run = 0; run < n; ++run)
      for (int e = colour[run].first; e < colour[run].last; ++e)
        body(e);
  }
}

double Shell::elastic_energy(const Eigen::VectorXd& x) const
{
  double sum = 0;
  for (const Element& e : elements_)
    sum += energy(e, rigidity_, gather(e, x));
  return sum;
}

Eigen::VectorXd Shell::internal_force(const Eigen::VectorXd& x) const
{
  Eigen::VectorXd f = Eigen::VectorXd::Zero(x.size());
  for_each_element([&](int index) {
    const Element& e = elements_[index];
    const NodeForces nodal = force(e, rigidity_, gather(e, x));
    for (int i = 0; i < e.n_nodes; ++i) {
      if (e.image[i] < 0)
        f.segment<3>(3 * e.vertex[i]) += nodal.col(i);
      else
        f.segment<3>(3 * e.vertex[i]) += images_[e.image[i]].T.transpose() * nodal.col(i);
    }
  });
  return f;
}

/// Chain rule through the images, K_xx' = T' K_yy' T'.
void Shell::scatter(int index, const ElementTangent& tangent, BlockMatrix& K) const
{
  const Element& e = elements_[index];
  for (int i = 0; i < e.n_nodes; ++i)
    for (int j = 0; j < e.n_nodes; ++j) {
      Mat3 block = tangent.block(i, j);
      if (e.image[i] >= 0)
        block = (images_[e.image[i]].T.transpose() * block).eval();
      if (e.image[j] >= 0)
        block = (block * images_[e.image[j]].T).eval();
      K.block(slots_[index][max_nodes * i + j]) += block;
    }
}

void Shell::add_tangent(const Eigen::VectorXd& x, BlockMatrix& K) const
{
  for_each_element([&](int e) { scatter(e, tangent(elements_[e], rigidity_, gather(elements_[e], x)), K); });
}

void Shell::add_material_stiffness(const Eigen::VectorXd& x, BlockMatrix& K) const
{
  for_each_element([&](int e) { scatter(e, material_tangent(elements_[e], rigidity_, gather(elements_[e], x)), K); });
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

void Shell::clear_held(Eigen::VectorXd& v) const
{
  for (std::size_t i = 0; i < held_.size(); ++i)
    if (held_[i])
      v[static_cast<Eigen::Index>(i)] = 0;
}

}  // namespace luff::shell
