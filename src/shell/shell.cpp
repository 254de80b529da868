// SPDX-License-Identifier: BSD-3-Clause
// A shell: reference configuration, properties and supports, put together from its pieces.
#include "shell/shell.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/Dense>

#include "core/bounding_box.hpp"
#include "core/error.hpp"
#include "shell/fibres.hpp"
#include "shell/patch_quadratic.hpp"
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

/// Column k: 2/h_k m_k (x) m_k = 2 h_k g_k (x) g_k in Voigt order.
Mat3 curvatures_of_turns(const Eigen::Matrix<double, 2, 3>& gradient)
{
  Mat3 turning;
  for (int k = 0; k < 3; ++k)
    turning.col(k) = 2 / gradient.col(k).norm() * dyad(gradient.col(k));
  return turning;
}

}  // namespace

Shell::Shell(surface::TriangleMesh reference, const Properties& properties, std::vector<Support> supports,
             std::string name)
    : Shell(std::vector<Piece>{{std::move(reference), properties, std::move(supports), std::move(name)}})
{
}

Shell::Shell(std::vector<Piece> pieces)
{
  ensure(!pieces.empty(), "a shell has at least one piece");
  for (Piece& piece : pieces)
    append(std::move(piece));
  topology_ = surface::topology(reference_);
  reference_positions_ = surface::interleaved(reference_.vertices);
  for (Element& e : elements_)
    e.kappa_0 = kinematics(e, gather(e, reference_positions_, images_)).kappa;
  make_pattern();
  colour_elements();
  make_mass();
}

void Shell::append(Piece piece)
{
  surface::validate(piece.reference, "shell '" + piece.name + "'");
  validate(piece.properties, piece.name);
  const surface::Topology topology = surface::topology(piece.reference);
  const Constraints supports = constraints(piece.reference, topology, piece.supports, piece.name);
  const Mat3 moduli = reference_moduli(piece.properties.material);
  const BendingOperator bending =
      bending_operator(piece.properties.bending, piece.reference, topology, supports.mirrors, moduli, piece.name);
  const int first_vertex = n_vertices();
  pieces_.push_back({piece.name, piece.properties, first_vertex, piece.reference.n_vertices(), reference_.n_triangles(),
                     piece.reference.n_triangles()});
  sections_.push_back(
      make_section(piece.properties.material, piece.properties.thickness, piece.properties.thickness_points));
  append_elements(piece, topology, bending, first_vertex);
  append_mirrors(piece, supports, first_vertex);
  held_.append(supports.held);
  springs_.append(supports.springs, first_vertex);
  reference_.vertices.insert(reference_.vertices.end(), piece.reference.vertices.begin(),
                             piece.reference.vertices.end());
  for (const auto& [a, b, c] : piece.reference.triangles)
    reference_.triangles.push_back({a + first_vertex, b + first_vertex, c + first_vertex});
  size_ = std::max(size_, bounding_box(piece.reference.vertices).size());
  name_ += name_.empty() ? piece.name : ", " + piece.name;
}

void Shell::append_elements(const Piece& piece, const surface::Topology& topology, const BendingOperator& bending,
                            int first_vertex)
{
  const std::vector<Fibre> fibres = fibres_in_triangles(piece.reference, piece.fibres, piece.name);
  const int first_image = static_cast<int>(images_.size());
  for (Image image : bending.images) {
    for (int& mirror : image.mirrors)
      mirror += static_cast<int>(mirrors_.size());
    images_.push_back(image);
  }
  for (int t = 0; t < piece.reference.n_triangles(); ++t) {
    const auto& stencil = bending.stencils[t];
    ensure(stencil.size() <= max_nodes, "a bending stencil has more nodes than the element holds");
    Element e;
    e.n_nodes = static_cast<int>(stencil.size());
    e.vertex.fill(stencil[0].vertex + first_vertex);
    e.image.fill(-1);
    e.H.setZero();
    for (int i = 0; i < e.n_nodes; ++i) {
      e.vertex[i] = stencil[i].vertex + first_vertex;
      e.image[i] = stencil[i].image < 0 ? -1 : stencil[i].image + first_image;
      e.H.col(i) = stencil[i].H;
      e.has_images = e.has_images || e.image[i] >= 0;
    }
    const auto& corner = piece.reference.triangles[t];
    const auto& X = piece.reference.vertices;
    e.gradient = area_coordinate_gradients(X[corner[0]], X[corner[1]], X[corner[2]]);
    e.turning = curvatures_of_turns(e.gradient);
    e.turns = e.turning.inverse();
    e.area = surface::area(piece.reference, t);
    e.fibre = fibres[t];
    if (piece.properties.membrane == MembraneKind::Smoothed) {
      e.smoothed = static_cast<int>(smoothed_.size());
      smoothed_.push_back(smoothed_membrane(piece.reference, topology, t, e, first_vertex));
    }
    elements_.push_back(e);
  }
  if (bending.worst_conic > worst_conic_) {
    worst_conic_ = bending.worst_conic;
    worst_conic_triangle_ = pieces_.back().first_triangle + bending.worst_triangle;
  }
  n_hinge_patches_ += bending.n_replaced;
}

void Shell::append_mirrors(const Piece& piece, const Constraints& supports, int first_vertex)
{
  const int first_motion = static_cast<int>(held_.motions.size());
  for (const MirrorEdge& mirror : supports.mirrors) {
    const auto [a, b] = surface::edge_vertices(piece.reference.triangles[mirror.edge.triangle], mirror.edge.edge);
    const int motion = mirror.motion < 0 ? -1 : mirror.motion + first_motion;
    mirrors_.push_back({.edge = {pieces_.back().first_triangle + mirror.edge.triangle, mirror.edge.edge},
                        .normal = mirror.normal,
                        .a = a + first_vertex,
                        .b = b + first_vertex,
                        .motion = motion});
  }
}

Vec3 Shell::normal_of(const Mirror& mirror, double t, double factor) const
{
  return mirror.motion < 0 ? mirror.normal : Vec3(held_.motions[mirror.motion].turn(t, factor) * mirror.normal);
}

surface::TriangleMesh Shell::reference_of(const PieceRange& piece) const
{
  const auto first = reference_.vertices.begin() + piece.first_vertex;
  surface::TriangleMesh mesh{{first, first + piece.n_vertices}, {}};
  for (int t = piece.first_triangle; t < piece.first_triangle + piece.n_triangles; ++t) {
    auto corners = reference_.triangles[t];
    for (int& v : corners)
      v -= piece.first_vertex;
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

/// Mirrors that move: normal R n, through the middle of the edge where x has it.
Images Shell::images_at(const Eigen::VectorXd& x, double t, double factor) const
{
  Images now = images_;
  for (Image& image : now) {
    if (image.mirrors.empty())
      continue;
    Image chain{Mat3::Identity(), Vec3::Zero()};
    for (const int m : image.mirrors) {
      const Mirror& mirror = mirrors_[m];
      const Vec3 middle = 0.5 * (x.segment<3>(3 * mirror.a) + x.segment<3>(3 * mirror.b));
      chain = compose(chain, reflection(normal_of(mirror, t, factor), middle));
    }
    image.T = chain.T;
    image.t = chain.t;
  }
  return now;
}

const PieceRange& Shell::piece_of_vertex(int vertex) const
{
  return *std::prev(std::upper_bound(pieces_.begin(), pieces_.end(), vertex,
                                     [](int v, const PieceRange& piece) { return v < piece.first_vertex; }));
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
  for (int p = 0; p < static_cast<int>(pieces_.size()); ++p) {
    const int end = pieces_[p].first_triangle + pieces_[p].n_triangles;
    for (int first = pieces_[p].first_triangle; first < end; first += run_length)
      colour_run({first, std::min(first + run_length, end), p}, taken);
  }
}

void Shell::colour_run(ElementRun run, std::vector<std::vector<char>>& taken)
{
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
  for (const PieceRange& piece : pieces_)
    for (int t = piece.first_triangle; t < piece.first_triangle + piece.n_triangles; ++t) {
      const double mass = piece.properties.mass_per_area() * elements_[t].area;
      for (const int i : reference_.triangles[t])
        for (const int j : reference_.triangles[t])
          if (!piece.properties.lumped_mass)
            entries.emplace_back(i, j, mass * (i == j ? 2 : 1) / 12);
          else if (i == j)
            entries.emplace_back(i, i, mass / 3);
    }
  mass_.resize(n_vertices(), n_vertices());
  mass_.setFromTriplets(entries.begin(), entries.end());
  for (int row = 0; row < mass_.outerSize(); ++row)
    for (decltype(mass_)::InnerIterator entry(mass_, row); entry; ++entry)
      mass_slot_.push_back(pattern_->slot(row, static_cast<int>(entry.col())));
}

}  // namespace luff::shell
