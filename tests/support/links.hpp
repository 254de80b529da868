// SPDX-License-Identifier: BSD-3-Clause
// Links between centres at any places.
#pragma once

#include <functional>

#include "immersed/link_tree.hpp"
#include "parallel/for_each.hpp"
#include "parallel/halo.hpp"
#include "surface/mesh.hpp"

namespace luff::test {

/// Cell (i, j, k) and its centre [L].
using Centres = std::function<Vec3(const Index3&)>;

/// Cells with centres of any kind, and the search tree over their links.
class Links {
 public:
  Links(MPI_Comm comm, const Index3& cells, const std::array<bool, 3>& periodic, const Centres& places,
        const std::array<Vec3, 3>& periods = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()})
      : ranks(comm, cells, periodic), centre(places), tree_(ranks, fields(), periods)
  {
  }

  [[nodiscard]] std::vector<immersed::Crossing> crossings(const surface::TriangleMesh& mesh) const
  {
    return tree_.find_crossings(mesh.vertices, mesh.triangles);
  }

  const Decomposition ranks;
  const Centres centre;

 private:
  [[nodiscard]] Field3<double> fields() const
  {
    auto x = make_field3<double>(ranks.owned());
    for_each_cell_in_order(ranks.owned(), [&](int i, int j, int k) {
      for (int d = 0; d < 3; ++d)
        x[d](i, j, k) = centre({i, j, k})[d];
    });
    HaloExchange(ranks).exchange(views(x));
    return x;
  }

  immersed::LinkTree tree_;
};

}  // namespace luff::test
