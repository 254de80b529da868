// SPDX-License-Identifier: BSD-3-Clause
// One multigrid level on one rank: the scaled operator in single precision and its red-black Gauss-Seidel sweeps.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "poisson/cuts.hpp"
#include "poisson/layout.hpp"
#include "poisson/row_exchange.hpp"

namespace luff::poisson {

/// Away from blocked faces the operator is a product of 1-D tables, so no coefficient but the inverse diagonal, which
/// rows of equal widths across them share, is read from memory:
///
///   (A u)_ijk = h_j h_k [ (u_i - u_i-1)/d_i + (u_i - u_i+1)/d_i+1 ] + h_i [ h_k (...)_j + h_j (...)_k ].
///
/// Where it is no such product (Kind::Stored), coefficients are read from memory.  Cells whose coefficients differ,
/// most of them beside blocked faces, and extra unknowns have explicit rows instead, applied after the clean ones.
class Level {
 public:
  enum class Kind { Product, Stored };
  Level(const Box& box, const IndexBox& owned, const Neighbourhood* neighbourhood, Kind kind = Kind::Product);
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;

  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] const Layout& layout() const { return layout_; }
  [[nodiscard]] bool distributed() const { return distributed_; }
  [[nodiscard]] int extras() const { return extras_; }
  [[nodiscard]] RowExchange& exchange() { return exchange_; }
  /// Colours that carry a residual after a black half sweep: red, or both where colours clash at an odd periodic seam.
  [[nodiscard]] Colours residual_colours() const { return residual_colours_; }
  /// Whether cells of one colour meet at an odd periodic seam.
  [[nodiscard]] bool colours_clash() const { return colours_clash_; }
  /// Both colours carry one from now on.
  void keep_whole_residual() { residual_colours_ = Colours::Both; }

  /// Coefficients of a level of Kind::Stored.
  [[nodiscard]] StoredCoefficients& coefficients() { return *stored_; }
  [[nodiscard]] const StoredCoefficients& coefficients() const { return *stored_; }

  /// Takes the explicit rows of this rank's cells and extras, and resizes the arrays.
  void set_cuts(const Cuts& cuts);
  [[nodiscard]] const std::vector<int>& owned_extras() const { return owned_extras_; }
  /// Place of an unknown in the arrays, for a reader near this rank's block; -1 where this rank does not hold it.
  [[nodiscard]] std::ptrdiff_t place(Unknown x) const;

  /// x = b / diagonal on cells of a colour of plane k: a half sweep for A x = b from x = 0.
  void start_plane(int k, int colour, Values& x, const Values& b);
  void relax_plane(int k, int colour, Values& x, const Values& b);
  void start_plane(int k) { start_plane(k, 0, u, f); }
  void relax_plane(int k, int colour) { relax_plane(k, colour, u, f); }
  /// Of the cells that blocked faces touch only.
  void relax_cut_cells_plane(int k, int colour, Values& x, const Values& b);
  void relax_cut_cells_plane(int k, int colour) { relax_cut_cells_plane(k, colour, u, f); }
  /// r = f - A u on cells of a colour.
  void residual_plane(int k, int colour);
  /// q = A p; returns the sum of p q over plane k.
  double apply_plane(int k, const float* p, float* q) const;

  enum class Order { Forward, Backward };
  /// Gauss-Seidel over this rank's extras, those of even planes first, then shares them.  From u = 0, only extras are
  /// read.
  void relax_extras(Order order, bool from_zero, Values& x, const Values& b);
  void relax_extras(Order order, bool from_zero) { relax_extras(order, from_zero, u, f); }
  /// The same for those of one plane.
  void relax_extras_plane(int k, Order order);
  void residual_extras();
  void share_extras(float* values) const;
  /// Collective: what every rank contributed to the values of a level that all hold whole.
  void sum_over_ranks(Values& values) const;

  Values u, f, r;

 private:
  struct Entry {
    std::int32_t place;
    float coefficient;
  };
  struct Row {
    std::int32_t place;
    int begin, end;  // entries
    float grounded;  // coefficient to p = 0 beyond a Dirichlet side, where that is no halo cell
    float inverse;   // 1 / diagonal, 0 for an isolated cell
  };
  /// Coefficients of a row (j, k), and where the inverse diagonals of its even cells are; the odd ones' follow.
  struct RowCoefficients {
    float row, j_low, j_high, k_low, k_high;
    std::ptrdiff_t inverse;
  };
  void make_tables();
  void make_row_coefficients();
  template <class Work>
  void for_rows(int k, int colour, const float* values, Work work) const;
  void add_cell_row(const Cuts& cuts, const CutCell& cut);
  void add_extra_rows(const Cuts& cuts);
  void add_extra_row(const Cuts& cuts, int e);
  void finish_row(std::int32_t place, int begin, double grounded, std::vector<Row>& rows);
  [[nodiscard]] std::ptrdiff_t place_beside(const Index3& cell, int side, Unknown x) const;
  [[nodiscard]] bool differs(const CutCell& cut) const;
  [[nodiscard]] const Row* rows_begin(int k, int colour) const;
  [[nodiscard]] const Row* rows_end(int k, int colour) const;
  [[nodiscard]] float neighbour_sum(const Row& row, const float* values) const;
  [[nodiscard]] float sum_of_extras(const Row& row, const float* values) const;
  void relax_extra_rows(int begin, int end, Order order, Values& x, const Values& b) const;
  [[nodiscard]] float image(const Row& row, const float* values) const;

  Layout layout_;
  std::unique_ptr<StoredCoefficients> stored_;
  Box box_;
  bool distributed_;
  const Neighbourhood* neighbourhood_;
  RowExchange exchange_;
  bool colours_clash_;
  Colours residual_colours_;
  int places_;                                  // of cells of one parity along rows, whole vectors
  std::array<Values, 2> left_, right_, width_;  // along rows, per parity of i; 0 beyond
  std::vector<RowCoefficients> row_coefficients_;
  Values inverse_diagonals_;  // 0 beyond the ends of rows; computing them anew for every row costs 6 to 10 %
  int extras_ = 0;
  std::vector<int> owned_extras_;
  std::vector<Row> rows_;
  std::vector<int> first_row_;                            // per (plane, colour)
  std::vector<Row> extra_rows_;                           // of even planes, then of odd ones
  std::vector<std::pair<int, int>> extra_rows_of_plane_;  // first, and one after the last
  std::vector<Entry> entries_;
};

}  // namespace luff::poisson
