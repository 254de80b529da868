// SPDX-License-Identifier: BSD-3-Clause
#include "poisson/cuts.hpp"

#include <algorithm>
#include <cmath>

#include "poisson/passages.hpp"

namespace luff::poisson {

namespace {

int add_cell(Cuts& cuts, const Box& box, const Index3& cell)
{
  const Unknown key = box.key(cell);
  int n = cuts.find.find(key);
  if (n < 0) {
    n = static_cast<int>(cuts.cells.size());
    cuts.find.insert(key, n);
    CutCell cut;
    cut.cell = cell;
    cut.measure = box.measure(cell);
    cuts.cells.push_back(cut);
  }
  return n;
}

void sort_links(std::vector<Link>& links)
{
  const auto order = [](const Link& a, const Link& b) {
    return std::tie(a.from, a.to, a.side) < std::tie(b.from, b.to, b.side);
  };
  std::sort(links.begin(), links.end(), order);
  std::size_t kept = 0;
  for (const Link& link : links) {
    if (kept > 0 && !order(links[kept - 1], link))
      links[kept - 1].coefficient += link.coefficient;
    else
      links[kept++] = link;
  }
  links.resize(kept);
}

/// Of sorted links.
void find_link_ranges(Cuts& cuts, const Box& box)
{
  for (std::size_t begin = 0, end = 0; begin < cuts.links.size(); begin = end) {
    const Unknown from = cuts.links[begin].from;
    while (end < cuts.links.size() && cuts.links[end].from == from)
      ++end;
    LinkRange& range =
        is_cell(from) ? cuts.cells[add_cell(cuts, box, box.cell(from))].links : cuts.extras[extra_number(from)].links;
    range = {static_cast<int>(begin), static_cast<int>(end)};
  }
}

/// Builds the cuts of one level from those of the next finer one.
class Coarsening {
 public:
  Coarsening(Cuts& fine_cuts, const Box& fine, const Box& coarse, const std::array<Merge, 3>& merges)
      : fine_cuts_(fine_cuts), fine_(fine), coarse_(coarse), merges_(merges)
  {
    fine_cuts_.parent_of_extra.assign(fine_cuts_.extras.size(), no_unknown);
    fine_cuts_.interpolation.clear();
  }

  Cuts run()
  {
    collect_boxes();
    for (std::size_t n = 0; n < boxes_.size(); ++n)
      split_into_parts(static_cast<int>(n));
    add_neighbours_of_split_cells();
    for (std::size_t n = 0; n < cuts_.cells.size(); ++n)
      sum_coefficients(static_cast<int>(n), n < boxes_.size() ? boxes_[n].extras : none_);
    sort_links(cuts_.links);
    find_link_ranges(cuts_, coarse_);
    for (std::size_t n = 0; n < cuts_.cells.size(); ++n)
      correct_interpolation(static_cast<int>(n), n < boxes_.size() ? boxes_[n].extras : none_);
    return std::move(cuts_);
  }

 private:
  struct Members {
    std::vector<int> extras;                                  // fine extras inside this coarse cell
    std::array<int, 8> cuts{-1, -1, -1, -1, -1, -1, -1, -1};  // fine cut cells, by their position in it
  };
  struct Child {
    Index3 cell;
    const CutCell* cut;
    int position;
  };

  [[nodiscard]] Index3 box_of(const Index3& c) const
  {
    return {merges_[0].parent[c[0]], merges_[1].parent[c[1]], merges_[2].parent[c[2]]};
  }
  [[nodiscard]] int position_in_box(const Index3& c) const
  {
    int position = 0;
    for (int a = 0; a < 3; ++a)
      position += (c[a] - merges_[a].first[merges_[a].parent[c[a]]]) << a;
    return position;
  }
  [[nodiscard]] Index3 fine_cell_of(Unknown x) const
  {
    return is_cell(x) ? fine_.cell(x) : fine_cuts_.extras[extra_number(x)].cell;
  }
  [[nodiscard]] double fine_coefficient(const Child& child, int side) const
  {
    return child.cut != nullptr ? child.cut->coefficient[side] : fine_.coefficient(child.cell, side);
  }
  [[nodiscard]] Unknown parent_of(Unknown x) const { return parent(fine_cuts_, fine_, cuts_, coarse_, merges_, x); }
  [[nodiscard]] Unknown parent_of_cell(const Index3& c) const
  {
    return poisson::parent_of_cell(cuts_, coarse_, merges_, c);
  }

  void collect_boxes()
  {
    const auto box_number = [&](const Index3& fine_cell) {
      const int n = add_cell(cuts_, coarse_, box_of(fine_cell));
      boxes_.resize(std::max<std::size_t>(boxes_.size(), n + 1));
      return n;
    };
    cuts_.find.reserve(fine_cuts_.cells.size() / 2);
    for (std::size_t n = 0; n < fine_cuts_.cells.size(); ++n) {
      const Index3& c = fine_cuts_.cells[n].cell;
      const int position = position_in_box(c);
      boxes_[box_number(c)].cuts[position] = static_cast<int>(n);
    }
    for (std::size_t e = 0; e < fine_cuts_.extras.size(); ++e)
      boxes_[box_number(fine_cuts_.extras[e].cell)].extras.push_back(static_cast<int>(e));
  }

  /// Cells that were added as neighbours hold no cut ones.
  void list_children(int n, std::vector<Child>& children) const
  {
    const Index3 C = cuts_.cells[n].cell;
    const Members* members = n < static_cast<int>(boxes_.size()) ? &boxes_[n] : nullptr;
    children.clear();
    const auto begin = [&](int a) { return merges_[a].first[C[a]]; };
    const auto end = [&](int a) { return merges_[a].first[C[a] + 1]; };
    for (int k = begin(2); k < end(2); ++k)
      for (int j = begin(1); j < end(1); ++j)
        for (int i = begin(0); i < end(0); ++i) {
          const int position = (i - begin(0)) + 2 * (j - begin(1)) + 4 * (k - begin(2));
          const int cut = members != nullptr ? members->cuts[position] : -1;
          children.push_back({{i, j, k}, cut < 0 ? nullptr : &fine_cuts_.cells[cut], position});
        }
  }

  /// Places of the unknowns inside one coarse cell in the lists of its children and, after them, of its extras.
  struct Places {
    Index3 lowest, count;
    int children;
    [[nodiscard]] int of_child(const Index3& c) const  // in the order of list_children()
    {
      return (c[0] - lowest[0]) + count[0] * ((c[1] - lowest[1]) + count[1] * (c[2] - lowest[2]));
    }
  };
  [[nodiscard]] Places places(const Index3& C) const
  {
    Places result{};
    for (int a = 0; a < 3; ++a) {
      result.lowest[a] = merges_[a].first[C[a]];
      result.count[a] = merges_[a].first[C[a] + 1] - result.lowest[a];
    }
    result.children = static_cast<int>(children_.size());
    return result;
  }

  /// Tells passages_ of the faces inside one coarse cell.
  void find_passages_of_children(const Index3& C)
  {
    const Places place = places(C);
    for (const Child& child : children_)
      for (const int side : {1, 3, 5}) {
        Index3 other;
        if (!fine_.neighbour(child.cell, side, other) || box_of(other) != C || other == child.cell)
          continue;
        const double c = fine_coefficient(child, side);
        if (c > 0.0)
          passages_.join(place.of_child(child.cell), place.of_child(other), c);
        else
          passages_.part(place.of_child(child.cell), place.of_child(other));
      }
  }

  /// Of the links of its extra unknowns; what shares a cell lies on two sides of a sheet.
  void find_passages_of_extras(const Index3& C, const std::vector<int>& extras)
  {
    const Places place = places(C);
    const auto place_of = [&](Unknown x) {
      if (is_cell(x)) {
        const Index3 c = fine_.cell(x);
        return box_of(c) == C ? place.of_child(c) : -1;
      }
      const auto found = std::find(extras.begin(), extras.end(), extra_number(x));
      return found == extras.end() ? -1 : place.children + static_cast<int>(found - extras.begin());
    };
    for (const int e : extras) {
      const int own = place_of(extra_unknown(e));
      for (const Link& link : fine_cuts_.links_from_extra(e))
        if (const int other = place_of(link.to); other >= 0 && other < own)
          passages_.join(own, other, link.coefficient);
      const Index3& cell = fine_cuts_.extras[e].cell;
      passages_.part(own, place.of_child(cell));
      for (int m = place.children; m < own; ++m)
        if (fine_cuts_.extras[extras[m - place.children]].cell == cell)
          passages_.part(own, m);
    }
  }

  [[nodiscard]] double coarse_over_fine(const Index3& C, int side) const
  {
    return merges_[side / 2].scale[C[side / 2] + side % 2];
  }

  /// Sum of the coarse coefficients of links out of a coarse cell.
  [[nodiscard]] double outward(const Index3& C, std::span<const Link> links) const
  {
    double sum = 0.0;
    for (const Link& link : links)
      if (link.to == outside || box_of(fine_cell_of(link.to)) != C)
        sum += link.coefficient * coarse_over_fine(C, link.side);
    return sum;
  }
  /// The same of all that leads out of it from one of its children.
  [[nodiscard]] double outward(const Index3& C, const Child& child) const
  {
    double sum = child.cut != nullptr ? outward(C, fine_cuts_.links_from(child.cut->links)) : 0.0;
    for (int side = 0; side < 6; ++side) {
      Index3 other;
      const double c = fine_coefficient(child, side);
      if (c > 0.0 && (!fine_.neighbour(child.cell, side, other) || box_of(other) != C))
        sum += c * coarse_over_fine(C, side);
    }
    return sum;
  }

  void split_into_parts(int n)
  {
    const Index3 C = cuts_.cells[n].cell;
    const std::vector<int>& extras = boxes_[n].extras;
    list_children(n, children_);
    const int cells = static_cast<int>(children_.size());
    const int members = cells + static_cast<int>(extras.size());
    passages_.reset(members);
    find_passages_of_children(C);
    find_passages_of_extras(C, extras);
    if (!passages_.has_sides())
      return;
    for (int m = 0; m < members; ++m)
      passages_.lead_out(
          m, m < cells ? outward(C, children_[m]) : outward(C, fine_cuts_.links_from_extra(extras[m - cells])));
    const std::vector<int>& part = passages_.parts();
    std::vector<double> measure(members, 0.0);
    std::vector<char> open(members, 0);
    for (int m = 0; m < members; ++m) {
      measure[part[m]] += m >= cells                    ? fine_cuts_.extras[extras[m - cells]].measure
                          : children_[m].cut != nullptr ? children_[m].cut->measure
                                                        : fine_.measure(children_[m].cell);
      open[part[m]] |= static_cast<char>(passages_.leads_out(m));
    }
    int largest = part[0];
    for (int m = 0; m < members; ++m)
      if (part[m] == m && std::pair(open[m], measure[m]) > std::pair(open[largest], measure[largest]))
        largest = m;
    std::vector<Unknown> unknown(members, no_unknown);
    for (int m = 0; m < members; ++m) {
      if (part[m] != m)
        continue;
      if (m == largest) {
        unknown[m] = coarse_.key(C);
      } else if (open[m] != 0) {
        unknown[m] = extra_unknown(static_cast<int>(cuts_.extras.size()));
        cuts_.extras.push_back({.cell = C, .measure = measure[m], .links = {}});
      } else {
        unknown[m] = first_pocket + cuts_.pockets++;
      }
    }
    cuts_.cells[n].measure = measure[largest];
    cuts_.cells[n].parts = static_cast<int>(cuts_.parts.size());
    std::array<Unknown, 8> parts;
    parts.fill(no_unknown);
    for (std::size_t m = 0; m < children_.size(); ++m)
      parts[children_[m].position] = unknown[part[m]];
    cuts_.parts.push_back(parts);
    for (std::size_t m = 0; m < extras.size(); ++m)
      fine_cuts_.parent_of_extra[extras[m]] = unknown[part[cells + m]];
  }

  [[nodiscard]] Unknown unknown_of(const CutCell& coarse, const Child& child) const
  {
    return coarse.split() ? cuts_.parts[coarse.parts][child.position] : coarse_.key(coarse.cell);
  }

  void add_neighbours_of_split_cells()
  {
    for (std::size_t n = 0; n < boxes_.size(); ++n)
      for (int side = 0; side < 6 && cuts_.cells[n].split(); ++side) {
        Index3 other;
        if (!coarse_.neighbour(cuts_.cells[n].cell, side, other))
          continue;
        const auto m = static_cast<std::size_t>(add_cell(cuts_, coarse_, other));
        beside_split_.resize(std::max(beside_split_.size(), m + 1));
        beside_split_[m] |= static_cast<unsigned char>(1u << (side ^ 1));
      }
    beside_split_.resize(cuts_.cells.size());
  }
  /// Whether the coarse cell on a side of the n-th cut one holds several values.
  [[nodiscard]] bool beside_split(int n, int side) const { return (beside_split_[n] >> side & 1) != 0; }

  /// A coarse coefficient is the sum of the fine ones of its face times fine over coarse distance; within a cell the
  /// plain sum.
  void sum_coefficients(int n, const std::vector<int>& extras)
  {
    CutCell& cut = cuts_.cells[n];
    const Index3 C = cut.cell;
    const Unknown key = coarse_.key(C);
    const auto add = [&](Unknown from, Unknown to, int side, double fine_coefficient) {
      const double c = fine_coefficient * coarse_over_fine(C, side);
      if (c == 0.0)
        return;
      if (from == key && (to == outside || is_cell(to)))
        cut.coefficient[side] += c;
      else
        cuts_.links.push_back({from, to, side, c});
    };
    const auto add_within = [&](Unknown from, Unknown to, double c) {
      if (from != to)
        cuts_.links.push_back({from, to, within, c});
    };
    const auto add_links = [&](Unknown own, std::span<const Link> links) {
      for (const Link& link : links)
        if (link.to == outside)
          add(own, outside, link.side, link.coefficient);
        else if (box_of(fine_cell_of(link.to)) != C)
          add(own, parent_of(link.to), link.side, link.coefficient);
        else
          add_within(own, parent_of(link.to), link.coefficient);
    };
    list_children(n, children_);
    for (const Child& child : children_) {
      const Unknown own = unknown_of(cut, child);
      for (int side = 0; side < 6; ++side) {
        const double c = fine_coefficient(child, side);
        Index3 other;
        if (!(c > 0.0))
          continue;
        const bool inside = fine_.neighbour(child.cell, side, other);
        if (inside && box_of(other) == C) {
          if (cut.split() && other != child.cell)
            add_within(own, parent_of_cell(other), c);
          continue;
        }
        if (!cut.split() && !beside_split(n, side))
          cut.coefficient[side] += c * coarse_over_fine(C, side);
        else
          add(own, inside ? parent_of_cell(other) : outside, side, c);
      }
      if (child.cut != nullptr)
        add_links(own, fine_cuts_.links_from(child.cut->links));
    }
    for (const int e : extras)
      add_links(fine_cuts_.parent_of_extra[e], fine_cuts_.links_from_extra(e));
  }

  /// Interpolation stays linear towards a neighbour that an open face joins, when neither cell is split; it becomes
  /// constant otherwise, and from its own part inside a split cell.
  void correct_interpolation(int n, const std::vector<int>& extras)
  {
    const CutCell& cut = cuts_.cells[n];
    const Unknown key = coarse_.key(cut.cell);
    std::vector<Interpolation>& list = fine_cuts_.interpolation;
    list_children(n, children_);
    for (const Child& child : children_) {
      const Unknown x = fine_.key(child.cell);
      const Unknown own = unknown_of(cut, child);
      double to_cell = own == key ? 0.0 : -1.0;
      for (int a = 0; a < 3; ++a) {
        const double w = merges_[a].weight[child.cell[a]];
        const int towards = merges_[a].towards[child.cell[a]];
        const int side = 2 * a + (towards + 1) / 2;
        if (w == 0.0 || (!cut.split() && cut.coefficient[side] > 0.0 && !beside_split(n, side)))
          continue;
        to_cell += w;
        Index3 other;
        if (coarse_.neighbour(cut.cell, side, other))
          list.push_back({x, coarse_.key(other), -w});
      }
      if (to_cell != 0.0)
        list.push_back({x, key, to_cell});
      if (own != key && !is_pocket(own))
        list.push_back({x, own, 1.0});
    }
    for (const int e : extras)
      if (!is_pocket(fine_cuts_.parent_of_extra[e]))
        list.push_back({extra_unknown(e), fine_cuts_.parent_of_extra[e], 1.0});
  }

  Cuts& fine_cuts_;
  const Box& fine_;
  const Box& coarse_;
  const std::array<Merge, 3>& merges_;
  Cuts cuts_;
  std::vector<Members> boxes_;
  std::vector<unsigned char> beside_split_;  // bit per side
  std::vector<Child> children_;
  Passages passages_;
  const std::vector<int> none_;
};

}  // namespace

/// The diagonal is h_j h_k a_i + h_i h_k a_j + h_i h_j a_k, a = 1/d + 1/d beside a cell; cross terms of its square go
/// by means along each axis.
double Box::typical_diagonal() const
{
  if (stored != nullptr)
    return std::sqrt(stored->diagonal_squares() / static_cast<double>(stored->cells()));
  std::array<double, 3> hh{}, aa{}, ha{};
  for (int axis = 0; axis < 3; ++axis) {
    const Line& line = lines[axis];
    for (int i = 0; i < line.n; ++i) {
      const double a = line.inverse_d[i] + line.inverse_d[i + 1];
      hh[axis] += line.h[i] * line.h[i] / line.n;
      aa[axis] += a * a / line.n;
      ha[axis] += line.h[i] * a / line.n;
    }
  }
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3;
    const int c = (axis + 2) % 3;
    square += aa[axis] * hh[b] * hh[c] + 2.0 * ha[axis] * ha[b] * hh[c];
  }
  return std::sqrt(square);
}

namespace {

/// visit(cell, side) for both cells beside a face that lie in the domain.
template <class Visit>
void for_cells_beside(const Box& box, const FaceIndex& face, Visit visit)
{
  Index3 high = face.cell;
  const int n = box.lines[face.axis].n;
  if (box.lines[face.axis].periodic)
    high[face.axis] %= n;
  Index3 low = high;
  low[face.axis] = box.lines[face.axis].periodic ? (high[face.axis] + n - 1) % n : high[face.axis] - 1;
  if (high[face.axis] < n)
    visit(high, 2 * face.axis);
  if (low[face.axis] >= 0)
    visit(low, 2 * face.axis + 1);
}

void sort_unique(std::vector<Index3>& cells)
{
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

}  // namespace

std::vector<Index3> cells_beside(const Box& box, std::span<const FaceIndex> faces)
{
  std::vector<Index3> cells;
  for (const FaceIndex& face : faces)
    for_cells_beside(box, face, [&](const Index3& cell, int) { cells.push_back(cell); });
  sort_unique(cells);
  return cells;
}

Cuts cuts_of_blocked_faces(const Box& box, std::span<const FaceIndex> faces)
{
  Cuts cuts;
  cuts.find.reserve(faces.size());
  for (const FaceIndex& face : faces)
    for_cells_beside(box, face, [&](const Index3& cell, int side) {
      const auto known = cuts.cells.size();
      CutCell& cut = cuts.cells[add_cell(cuts, box, cell)];
      if (cuts.cells.size() > known)
        for (int s = 0; s < 6; ++s)
          cut.coefficient[s] = box.coefficient(cell, s);
      if (box.stored == nullptr)
        cut.coefficient[side] = face.open * box.coefficient(cell, side);
    });
  return cuts;
}

std::vector<Index3> cells_near_cuts(const Cuts& fine_cuts, const Box& coarse, const std::array<Merge, 3>& merges)
{
  std::vector<Index3> boxes;
  const auto add_box_of = [&](const Index3& c) {
    boxes.push_back({merges[0].parent[c[0]], merges[1].parent[c[1]], merges[2].parent[c[2]]});
  };
  for (const CutCell& cut : fine_cuts.cells)
    add_box_of(cut.cell);
  for (const Extra& extra : fine_cuts.extras)
    add_box_of(extra.cell);
  sort_unique(boxes);
  const std::size_t own = boxes.size();
  for (std::size_t n = 0; n < own; ++n)
    for (int side = 0; side < 6; ++side) {
      Index3 other;
      if (coarse.neighbour(boxes[n], side, other))
        boxes.push_back(other);
    }
  sort_unique(boxes);
  std::vector<Index3> cells;
  for (const Index3& C : boxes)
    for (int k = merges[2].first[C[2]]; k < merges[2].first[C[2] + 1]; ++k)
      for (int j = merges[1].first[C[1]]; j < merges[1].first[C[1] + 1]; ++j)
        for (int i = merges[0].first[C[0]]; i < merges[0].first[C[0] + 1]; ++i)
          cells.push_back({i, j, k});
  sort_unique(cells);
  return cells;
}

Cuts coarsen_cuts(Cuts& fine_cuts, const Box& fine, const Box& coarse, const std::array<Merge, 3>& merges)
{
  return Coarsening(fine_cuts, fine, coarse, merges).run();
}

Unknown parent_of_cell(const Cuts& coarse_cuts, const Box& coarse, const std::array<Merge, 3>& merges,
                       const Index3& cell)
{
  const Index3 C{merges[0].parent[cell[0]], merges[1].parent[cell[1]], merges[2].parent[cell[2]]};
  const Unknown key = coarse.key(C);
  const CutCell* cut = coarse_cuts.at(key);
  if (cut == nullptr || !cut->split())
    return key;
  int position = 0;
  for (int a = 0; a < 3; ++a)
    position += (cell[a] - merges[a].first[C[a]]) << a;
  return coarse_cuts.parts[cut->parts][position];
}

Unknown parent(const Cuts& fine_cuts, const Box& fine, const Cuts& coarse_cuts, const Box& coarse,
               const std::array<Merge, 3>& merges, Unknown x)
{
  return is_cell(x) ? parent_of_cell(coarse_cuts, coarse, merges, fine.cell(x))
                    : fine_cuts.parent_of_extra[extra_number(x)];
}

}  // namespace luff::poisson
