// SPDX-License-Identifier: BSD-3-Clause
// Spreads the way that one triangle faces over all that it is connected with.
#include "surface/orientation.hpp"

#include <algorithm>

#include "surface/topology.hpp"

namespace luff::surface {

namespace {

class Spreading {
 public:
  explicit Spreading(const TriangleMesh& mesh) : mesh_(mesh), edges_(edge_map(mesh)), sign_(mesh.triangles.size(), 0)
  {
    result_.piece.assign(mesh.triangles.size(), -1);
  }

  Orientation run()
  {
    int pieces = 0;
    for (int t = 0; t < mesh_.n_triangles(); ++t)
      if (sign_[t] == 0)
        spread_from(t, pieces++);
    std::sort(result_.flipped.begin(), result_.flipped.end());
    return std::move(result_);
  }

 private:
  void spread_from(int seed, int piece)
  {
    std::vector<int> reached{seed};
    sign_[seed] = 1;
    int sum = 0;
    for (std::size_t next = 0; next < reached.size(); ++next) {
      const int t = reached[next];
      sum += sign_[t];
      result_.piece[t] = piece;
      for (int k = 0; k < 3; ++k)
        visit_neighbour(t, k, reached);
    }
    const int minority = sum >= 0 ? -1 : 1;
    std::copy_if(reached.begin(), reached.end(), std::back_inserter(result_.flipped),
                 [&](int t) { return sign_[t] == minority; });
  }

  void visit_neighbour(int t, int k, std::vector<int>& reached)
  {
    const auto [a, b] = edge_vertices(mesh_.triangles[t], k);
    const std::vector<TriangleEdge>& sides = edges_.at(edge_key(a, b));
    if (sides.size() != 2)
      return;
    const TriangleEdge other = sides[0].triangle == t ? sides[1] : sides[0];
    const bool same_direction = edge_vertices(mesh_.triangles[other.triangle], other.edge).first == a;
    const int expected = same_direction ? -sign_[t] : sign_[t];
    if (sign_[other.triangle] == 0) {
      sign_[other.triangle] = expected;
      reached.push_back(other.triangle);
    } else if (sign_[other.triangle] != expected && result_.one_sided < 0) {
      result_.one_sided = other.triangle;
    }
  }

  const TriangleMesh& mesh_;
  std::map<EdgeKey, std::vector<TriangleEdge>> edges_;
  std::vector<int> sign_;
  Orientation result_;
};

}  // namespace

Orientation orientation(const TriangleMesh& mesh)
{
  return Spreading(mesh).run();
}

}  // namespace luff::surface
