// SPDX-License-Identifier: BSD-3-Clause
// Owning arrays over a box of cells, and the plain views that kernels capture by value.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <type_traits>

#include "parallel/index_box.hpp"
#include "parallel/kernel.hpp"
#include "parallel/memory.hpp"

namespace luff {

/// A window on a field, indexed by global (i, j, k), i fastest.  Trivially copyable; owns nothing.
template <class T>
struct View {
  T* origin = nullptr;  ///< address of cell (0, 0, 0), which may lie outside the allocation
  std::ptrdiff_t stride_j = 0;
  std::ptrdiff_t stride_k = 0;

  LUFF_KERNEL T& operator()(int i, int j, int k) const { return origin[i + j * stride_j + k * stride_k]; }
  LUFF_KERNEL T& operator()(const Index3& c) const { return (*this)(c[0], c[1], c[2]); }
  LUFF_KERNEL T* row(int j, int k) const { return origin + j * stride_j + k * stride_k; }
  [[nodiscard]] std::ptrdiff_t stride(int axis) const { return axis == 0 ? 1 : axis == 1 ? stride_j : stride_k; }

  LUFF_KERNEL operator View<const T>() const  // NOLINT: adding const is always right
      requires(!std::is_const_v<T>)
  {
    return {origin, stride_j, stride_k};
  }
};

/// One scalar per cell of `owned`, with a halo of one cell on every side.
///
/// Face values use the same storage: the value at (i, j, k) of a field of axis-a faces belongs to the LOW face of
/// cell (i, j, k), at i - 1/2; the halo holds the high face of the last cell.
/// Rows are padded so that the first owned cell of every row is aligned to 64 bytes.
template <class T>
class Field {
 public:
  static constexpr int halo = 1;

  Field() = default;
  explicit Field(const IndexBox& owned, T value = T{}) : owned_(owned)
  {
    constexpr std::ptrdiff_t line = 64 / sizeof(T);
    const std::ptrdiff_t row = (line + owned.extent(0) + halo + line - 1) / line * line;
    const std::ptrdiff_t plane = row * (owned.extent(1) + 2 * halo);
    size_ = plane * (owned.extent(2) + 2 * halo) + line;
    T* data = static_cast<T*>(allocate_for_kernels(size_ * sizeof(T) + way));
    storage_.reset(data);
    start_ = data + stagger() / sizeof(T);
    view_ = {start_ + line - owned.lo[0] + (halo - owned.lo[1]) * row + (halo - owned.lo[2]) * plane, row, plane};
    fill(value);
  }
  Field(const Field& other) : Field(other.owned_) { copy_from(other); }
  Field(Field&&) noexcept = default;
  Field& operator=(const Field& other)
  {
    if (this != &other) {
      if (owned_ != other.owned_ || !storage_)
        *this = Field(other.owned_);
      copy_from(other);
    }
    return *this;
  }
  Field& operator=(Field&&) noexcept = default;
  ~Field() = default;

  [[nodiscard]] const IndexBox& owned() const { return owned_; }
  [[nodiscard]] View<T> view() { return view_; }
  [[nodiscard]] View<const T> view() const { return view_; }
  T& operator()(int i, int j, int k) { return view_(i, j, k); }
  const T& operator()(int i, int j, int k) const { return view_(i, j, k); }

  void fill(T value) { std::fill_n(start_, size_, value); }

 private:
  struct Free {
    void operator()(T* p) const { free_for_kernels(p); }
  };
  void copy_from(const Field& other) { std::copy_n(other.start_, size_, start_); }

  /// Large allocations begin alike, so that the same cell of a dozen fields falls on the same lines of a cache: kernels
  /// that read them together were up to ten times slower (measured, curvilinear fluxes).  Each field therefore begins
  /// elsewhere in what a way of a second-level cache holds.
  static constexpr std::size_t way = 65536;
  static std::size_t stagger()
  {
    static std::atomic<std::size_t> fields{0};
    constexpr std::size_t lines = 395;  // has no divisor in common with the lines of a way, nor nearly so with a page's
    return 64 * lines * fields++ % way;
  }

  IndexBox owned_{};
  std::ptrdiff_t size_ = 0;
  std::unique_ptr<T[], Free> storage_;
  T* start_ = nullptr;
  View<T> view_{};
};

/// Three fields, one per axis or Cartesian component.
template <class T>
using Field3 = std::array<Field<T>, 3>;
template <class T>
using View3 = std::array<View<T>, 3>;

template <class T>
[[nodiscard]] Field3<T> make_field3(const IndexBox& owned)
{
  return {Field<T>(owned), Field<T>(owned), Field<T>(owned)};
}
template <class T>
[[nodiscard]] View3<T> views(Field3<T>& f)
{
  return {f[0].view(), f[1].view(), f[2].view()};
}
template <class T>
[[nodiscard]] View3<const T> views(const Field3<T>& f)
{
  return {f[0].view(), f[1].view(), f[2].view()};
}

}  // namespace luff
