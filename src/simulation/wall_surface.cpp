// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/wall_surface.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace luff::simulation {

namespace {

/// A face of a wall, as ranks send it: plain numbers.
struct WallFace {
  int side = 0;
  Index3 cell{};  ///< whose low face it is
  std::array<Index3, 4> nodes{};
  std::array<std::array<double, 3>, 4> places{};  ///< [L]
  std::array<double, 3> shear{};                  ///< [M/(L T^2)]
  double pressure = 0.0;                          ///< [M/(L T^2)]
  double mean_shear = 0.0;                        ///< TAWSS
  double oscillation = 0.0;                       ///< OSI
};

WallFace wall_face(const grid::Grid& grid, const fluid::SideStress& stress, const Index3& cell, std::size_t n)
{
  WallFace face{.side = 2 * stress.axis + stress.end, .cell = stepped(cell, stress.axis, stress.end)};
  const int b = (stress.axis + 1) % 3;
  const int c = (stress.axis + 2) % 3;
  face.nodes = {face.cell, stepped(face.cell, b, 1), stepped(stepped(face.cell, b, 1), c, 1), stepped(face.cell, c, 1)};
  for (int m = 0; m < 4; ++m) {
    const auto [i, j, k] = face.nodes[m];
    const Vec3 x = grid.node(i, j, k);
    face.places[m] = {x[0], x[1], x[2]};
  }
  face.shear = {stress.shear[n][0], stress.shear[n][1], stress.shear[n][2]};
  face.pressure = stress.pressure[n];
  return face;
}

std::vector<WallFace> own_faces(const fluid::FlowSolver& flow, const ShearHistory* history)
{
  std::vector<WallFace> faces;
  for (const fluid::SideStress& stress : flow.side_stresses(/*walls_only=*/true)) {
    std::size_t n = 0;
    for_each_cell_in_order(stress.cells, [&](int i, int j, int k) {
      const std::size_t place = faces.size();
      WallFace& face = faces.emplace_back(wall_face(flow.grid(), stress, {i, j, k}, n++));
      if (history == nullptr)
        return;
      face.mean_shear = history->mean_magnitude(place);
      face.oscillation = history->oscillation(place);
    });
  }
  return faces;
}

/// Those of all ranks on the first, in an order that does not depend on their number.
std::vector<WallFace> gather(const std::vector<WallFace>& mine, MPI_Comm comm)
{
  int ranks = 1;
  int rank = 0;
  MPI_Comm_size(comm, &ranks);
  MPI_Comm_rank(comm, &rank);
  const int bytes = static_cast<int>(mine.size() * sizeof(WallFace));
  std::vector<int> counts(ranks);
  MPI_Gather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
  std::vector<int> starts(ranks, 0);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  std::vector<WallFace> all(rank == 0 ? (starts.back() + counts.back()) / sizeof(WallFace) : 0);
  MPI_Gatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, 0, comm);
  const auto place = [](const WallFace& f) { return std::array{f.side, f.cell[2], f.cell[1], f.cell[0]}; };
  std::sort(all.begin(), all.end(), [&](const WallFace& a, const WallFace& b) { return place(a) < place(b); });
  return all;
}

}  // namespace

output::SurfaceSnapshot wall_snapshot(const fluid::FlowSolver& flow, MPI_Comm comm, const ShearHistory* history)
{
  output::SurfaceSnapshot snapshot;
  std::map<Index3, int> numbers;  // of nodes
  std::vector<double> shear;
  std::vector<double> pressure;
  std::vector<double> side;
  std::vector<double> mean_shear;
  std::vector<double> oscillation;
  for (const WallFace& face : gather(own_faces(flow, history), comm)) {
    std::array<int, 4> corners{};
    for (int m = 0; m < 4; ++m) {
      const auto [entry, is_new] = numbers.try_emplace(face.nodes[m], static_cast<int>(snapshot.points.size()));
      if (is_new)
        snapshot.points.emplace_back(face.places[m].data());
      corners[m] = entry->second;
    }
    snapshot.quadrilaterals.push_back(corners);
    shear.insert(shear.end(), face.shear.begin(), face.shear.end());
    pressure.push_back(face.pressure);
    side.push_back(face.side);
    mean_shear.push_back(face.mean_shear);
    oscillation.push_back(face.oscillation);
  }
  snapshot.face_fields = {
      {"shear_stress", 3, std::move(shear)}, {"pressure", 1, std::move(pressure)}, {"side", 1, std::move(side)}};
  if (history != nullptr) {
    snapshot.face_fields.push_back({"tawss", 1, std::move(mean_shear)});
    snapshot.face_fields.push_back({"osi", 1, std::move(oscillation)});
  }
  return snapshot;
}

std::vector<Vec3> wall_shear(const fluid::FlowSolver& flow)
{
  std::vector<Vec3> all;
  for (const fluid::SideStress& stress : flow.side_stresses(/*walls_only=*/true))
    all.insert(all.end(), stress.shear.begin(), stress.shear.end());
  return all;
}

std::vector<std::int64_t> wall_faces(const fluid::FlowSolver& flow)
{
  std::vector<std::int64_t> all;
  for (const fluid::SideStress& stress : flow.side_stresses(/*walls_only=*/true))
    for_each_cell_in_order(stress.cells, [&](int i, int j, int k) {
      all.push_back(flow.links().key(stress.axis, stepped({i, j, k}, stress.axis, stress.end)));
    });
  return all;
}

}  // namespace luff::simulation
