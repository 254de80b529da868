// SPDX-License-Identifier: BSD-3-Clause
// Exchange of one layer of cells with the neighbouring blocks.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "parallel/decomposition.hpp"
#include "parallel/field.hpp"

namespace luff {

/// Fills the halos of fields over one decomposition: wraps periodic rows along i, then exchanges along j, then k, each
/// with the halos of the other axes, so that edges and corners are right too.  Halos on domain boundaries are left
/// alone; where they were filled before, neighbours get theirs.
///
/// `owned` and `cells` may be those of a coarser level that is split among the same ranks.
class HaloExchange {
 public:
  explicit HaloExchange(const Decomposition& ranks) : HaloExchange(ranks, ranks.owned(), ranks.cells()) {}
  HaloExchange(const Decomposition& ranks, const IndexBox& owned, const Index3& cells)
      : ranks_(&ranks), owned_(owned), cells_(cells)
  {
  }

  /// Collective.  All views hold the same box.
  template <class T>
  void exchange(std::span<const View<T>> fields);
  template <class T>
  void exchange(std::initializer_list<View<T>> fields)
  {
    exchange(std::span<const View<T>>(fields.begin(), fields.size()));
  }
  template <class T>
  void exchange(const View3<T>& fields)
  {
    exchange(std::span<const View<T>>(fields));
  }

 private:
  template <class T>
  void wrap_rows(const View<T>& field) const;
  template <class T>
  void exchange_along(int axis, std::span<const View<T>> fields);
  [[nodiscard]] IndexBox layer(int axis, int index) const;

  const Decomposition* ranks_;
  IndexBox owned_;
  Index3 cells_;
  std::vector<char> send_;
  std::vector<char> receive_;
};

}  // namespace luff
