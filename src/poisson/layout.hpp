// SPDX-License-Identifier: BSD-3-Clause
// Where the cells of a level lie in memory: rows split by red-black colour.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>

#include "parallel/index_box.hpp"
#include "parallel/memory.hpp"

namespace luff::poisson {

/// Cells (i, j, k), i never split among ranks, with one layer of halo.  A plane k holds its cells of colour 0, those
/// with i + j + k even, row by row, then those of colour 1; cell i is the (i >> 1)-th of its colour in a row.  So a
/// half sweep of red-black Gauss-Seidel runs over contiguous values, and the neighbours of the n-th cell of a colour
/// along j and k are the n-th of the other colour.  Colours split by planes rather than by rows let the processor fetch
/// ahead from row to row: a tenth to a quarter less time for a solve.
struct Layout {
  IndexBox owned;
  std::ptrdiff_t row = 0;    ///< from j to j + 1
  std::ptrdiff_t half = 0;   ///< from colour 0 to colour 1
  std::ptrdiff_t plane = 0;  ///< from k to k + 1
  std::ptrdiff_t origin = 0;
  std::ptrdiff_t size = 0;

  /// Rows are padded to whole vectors of this many values, and at least one place beyond.
  static constexpr int vector = 8;
  [[nodiscard]] static constexpr int whole_vectors(int count) { return (count + vector - 1) & -vector; }

  Layout() = default;
  explicit Layout(const IndexBox& box) : owned(box)
  {
    constexpr std::ptrdiff_t line = 16;
    // Room for cells -1 and n: cell -1 lies in the padding at the end of the row before.
    row = whole_vectors((box.extent(0) + 1) / 2) + vector;
    half = (row * (box.extent(1) + 2) + line - 1) / line * line;
    plane = 2 * half;
    origin = line + row * (1 - box.lo[1]) + plane * (1 - box.lo[2]);
    size = line + plane * (box.extent(2) + 2) + line;
  }

  [[nodiscard]] std::ptrdiff_t start(int j, int k, int colour) const
  {
    return origin + j * row + k * plane + colour * half;
  }
  [[nodiscard]] std::ptrdiff_t index(int i, int j, int k) const { return start(j, k, (i + j + k) & 1) + (i >> 1); }
  [[nodiscard]] std::ptrdiff_t index(const Index3& c) const { return index(c[0], c[1], c[2]); }
  /// Parity of i of the cells of a colour in a row.
  [[nodiscard]] static int parity(int j, int k, int colour) { return (j + k + colour) & 1; }
  /// Number of owned cells of a parity in a row.
  [[nodiscard]] int count(int parity) const { return (owned.hi[0] - parity + 1) / 2; }
};

/// Places of the first cell of a colour in a row, and of its six neighbours; those of the n-th follow by n.
struct Stencil {
  std::ptrdiff_t own, left, right, j_low, j_high, k_low, k_high;
  int parity, count;

  Stencil(const Layout& layout, int j, int k, int colour)
      : own(layout.start(j, k, colour)), parity(Layout::parity(j, k, colour)), count(layout.count(parity))
  {
    right = layout.start(j, k, 1 - colour) + parity;
    left = right - 1;
    const std::ptrdiff_t other = own + (colour == 0 ? layout.half : -layout.half);
    j_low = other - layout.row;
    j_high = other + layout.row;
    k_low = other - layout.plane;
    k_high = other + layout.plane;
  }
};

/// Values of a level: those of its cells in the order of Layout, then those of unknowns that are no cell.
class Values {
 public:
  Values() = default;
  explicit Values(std::ptrdiff_t size) { resize(size); }

  /// All values become zero.
  void resize(std::ptrdiff_t size) { resize_from(0, size); }
  /// Values from a place on become zero; all of them where the allocation is too small.
  void resize_from(std::ptrdiff_t kept, std::ptrdiff_t size)
  {
    if (size > capacity_) {
      kept = 0;
      capacity_ = size + size / 8 + 64;
      data_.reset(static_cast<float*>(allocate_for_kernels(capacity_ * sizeof(float))));
    }
    size_ = size;
    std::fill_n(data_.get() + kept, size_ - kept, 0.0f);
  }
  [[nodiscard]] std::ptrdiff_t size() const { return size_; }
  [[nodiscard]] float* data() { return data_.get(); }
  [[nodiscard]] const float* data() const { return data_.get(); }
  float& operator[](std::ptrdiff_t q) { return data_[q]; }
  float operator[](std::ptrdiff_t q) const { return data_[q]; }

 private:
  struct Free {
    void operator()(float* p) const { free_for_kernels(p); }
  };
  std::ptrdiff_t size_ = 0;
  std::ptrdiff_t capacity_ = 0;
  std::unique_ptr<float[], Free> data_;
};

}  // namespace luff::poisson
