// SPDX-License-Identifier: BSD-3-Clause
// The options of a grid, as plain data. Each key's meaning, unit, range and rules are in describe_grid.cpp.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "config/expression.hpp"
#include "config/mark.hpp"
#include "core/vec3.hpp"

namespace luff::config {

/// A stretch of an axis with cells of one size.
struct RefineOptions {
  double from = 0.0;
  double to = 0.0;
  double spacing = 0.0;

  bool operator==(const RefineOptions&) const = default;
};

struct AxisOptions {
  double from = 0.0;
  double to = 0.0;
  int cells = 0;  ///< in all, with those of `refine`
  std::optional<RefineOptions> refine;
  Mark mark = {};

  bool operator==(const AxisOptions&) const = default;
};

/// Cells along a direction whose length the grid's kind gives.
struct CellsOptions {
  int cells = 0;  ///< in all, with those of `refine`
  std::optional<RefineOptions> refine;
  Mark mark = {};

  bool operator==(const CellsOptions&) const = default;
};

/// Part of a circle about an axis, degrees.
struct AngleOptions {
  double from = 0.0;
  double to = 360.0;

  bool operator==(const AngleOptions&) const = default;
};

/// An arc of a circle.
struct BendOptions {
  double radius = 0.0;  ///< of the centreline
  double angle = 0.0;   ///< degrees
  Vec3 towards = Vec3::Zero();

  bool operator==(const BendOptions&) const = default;
};

/// [[grid.piece]]: exactly one of the two.
struct PieceOptions {
  std::optional<double> length;
  std::optional<BendOptions> bend;

  bool operator==(const PieceOptions&) const = default;
};

enum class GridKind { Box, MappedBox, Pipe, BentPipe, Aorta, Annulus, Channel, File };

/// Sides of these are named by the coordinates x, y, z, of all others by the index directions xi, eta, zeta.
inline bool is_curvilinear(GridKind kind)
{
  return kind != GridKind::Box;
}

/// [grid]; only with a fluid.
struct GridOptions {
  GridKind kind = GridKind::Box;
  std::array<AxisOptions, 3> axes;  ///< x, y, z of Box, MappedBox and Channel
  VectorExpression map;             ///< MappedBox: of place in the box

  Vec3 start = Vec3::Zero();  ///< Pipe, BentPipe, Annulus: centre of the first end
  Vec3 direction = Vec3::UnitZ();
  double length = 0.0;                              ///< Pipe, Annulus
  std::vector<PieceOptions> pieces;                 ///< BentPipe, unless `centreline` is given
  std::optional<std::filesystem::path> centreline;  ///< BentPipe: points of a file
  Expression radius;                                ///< Pipe, BentPipe: of arc length
  double annulus_radius = 0.0;                      ///< Aorta
  double inner_radius = 0.0;                        ///< Annulus
  double outer_radius = 0.0;                        ///< Annulus
  AngleOptions angle;                               ///< Annulus
  int across = 0;                                   ///< Pipe, BentPipe, Aorta: both ways
  CellsOptions along;                               ///< Pipe, BentPipe, Aorta, Annulus
  CellsOptions outwards;                            ///< Annulus
  int around = 0;                                   ///< Annulus

  Expression lower;  ///< Channel: y of its walls, of x
  Expression upper;

  std::filesystem::path path;  ///< File; absolute once read
  double scale = 1.0;
  Mark mark = {};

  bool operator==(const GridOptions&) const = default;
};

}  // namespace luff::config
