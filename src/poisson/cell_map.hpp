// SPDX-License-Identifier: BSD-3-Clause
// A small hash table from cells to numbers.
#pragma once

#include <cstdint>
#include <vector>

namespace luff::poisson {

/// Maps non-negative keys to numbers, by open addressing.
class CellMap {
 public:
  /// The number stored under a key, or -1.
  [[nodiscard]] int find(std::int64_t key) const
  {
    if (slots_.empty())
      return -1;
    for (std::size_t s = hash(key);; s = (s + 1) & (slots_.size() - 1)) {
      if (slots_[s].key == key)
        return slots_[s].value;
      if (slots_[s].key < 0)
        return -1;
    }
  }

  /// Makes room for this many keys and one more.
  void reserve(std::size_t count)
  {
    while (2 * (count + 1) > slots_.size())
      grow();
  }

  /// Stores a number under a key that is not there yet.
  void insert(std::int64_t key, int value)
  {
    reserve(count_);
    place(key, value);
    ++count_;
  }

 private:
  struct Slot {
    std::int64_t key = -1;
    int value = -1;
  };
  [[nodiscard]] std::size_t hash(std::int64_t key) const
  {
    return (static_cast<std::uint64_t>(key) * 0x9E3779B97F4A7C15ull >> 20) & (slots_.size() - 1);
  }
  void place(std::int64_t key, int value)
  {
    std::size_t s = hash(key);
    while (slots_[s].key >= 0)
      s = (s + 1) & (slots_.size() - 1);
    slots_[s] = {key, value};
  }
  void grow()
  {
    std::vector<Slot> old(slots_.empty() ? 64 : 2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.key >= 0)
        place(slot.key, slot.value);
  }

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

}  // namespace luff::poisson
