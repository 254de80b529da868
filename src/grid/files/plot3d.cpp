// SPDX-License-Identifier: BSD-3-Clause
#include "grid/files/plot3d.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>

#include "core/error.hpp"
#include "grid/files/dimensions.hpp"
#include "grid/files/plot3d_text.hpp"

namespace luff::grid {

namespace {

using Path = std::filesystem::path;

enum class ByteOrder { Ours, Swapped };

template <class Number>
Number number_at(const char* bytes, ByteOrder order)
{
  std::array<char, sizeof(Number)> copy{};
  std::memcpy(copy.data(), bytes, sizeof(Number));
  if (order == ByteOrder::Swapped)
    std::reverse(copy.begin(), copy.end());
  return std::bit_cast<Number>(copy);
}

/// A stretch of a file that holds data.
struct Stretch {
  std::int64_t begin = 0;   ///< place of its first byte among all bytes of data
  std::int64_t offset = 0;  ///< and in the file
  std::int64_t size = 0;
};

/// The data of a file as if they lay side by side, records' markers left out.
class DataFile {
 public:
  DataFile(const Path& file, ByteOrder order) : in_(file, std::ios::binary), order_(order) {}

  void add(std::int64_t offset, std::int64_t size)
  {
    stretches_.push_back({size_, offset, size});
    size_ += size;
  }
  [[nodiscard]] std::int64_t size() const { return size_; }

  void read(std::int64_t begin, std::int64_t count, char* bytes)
  {
    auto stretch = std::upper_bound(stretches_.begin(), stretches_.end(), begin,
                                    [](std::int64_t place, const Stretch& s) { return place < s.begin; });
    for (--stretch; count > 0; ++stretch) {
      const std::int64_t skipped = begin - stretch->begin;
      const std::int64_t part = std::min(count, stretch->size - skipped);
      in_.seekg(stretch->offset + skipped);
      in_.read(bytes, part);
      bytes += part;
      begin += part;
      count -= part;
    }
  }

  template <class Number>
  std::vector<Number> numbers(std::int64_t begin, std::int64_t count)
  {
    std::vector<char> bytes(count * sizeof(Number));
    read(begin, std::ssize(bytes), bytes.data());
    std::vector<Number> values(count);
    for (std::int64_t n = 0; n < count; ++n)
      values[n] = number_at<Number>(bytes.data() + n * sizeof(Number), order_);
    return values;
  }

 private:
  std::ifstream in_;
  ByteOrder order_;
  std::vector<Stretch> stretches_;
  std::int64_t size_ = 0;
};

/// How the numbers of a file lie in it.
struct Layout {
  ByteOrder order = ByteOrder::Ours;
  std::vector<std::array<std::int64_t, 2>> stretches;  ///< offset and size of what is no marker
  Index3 nodes{};
  std::int64_t coordinates = 0;  ///< where they begin among the data
  int bytes = 8;                 ///< of a coordinate
};

DataFile data_of(const Path& file, const Layout& layout)
{
  DataFile data(file, layout.order);
  for (const auto& [offset, size] : layout.stretches)
    data.add(offset, size);
  return data;
}

/// Bytes of a coordinate when so many nodes, blanked (4 bytes each) or not, fill so many bytes.
std::optional<int> coordinate_bytes(double nodes, double bytes)
{
  for (const int size : {4, 8})
    for (const int blanking : {0, 4})
      if (nodes * (3 * size + blanking) == bytes)
        return size;
  return std::nullopt;
}

std::string needed(const Index3& nodes)
{
  const double count = double(nodes[0]) * nodes[1] * nodes[2];
  return fmt::format("{} x {} x {} nodes take {:.0f} bytes in single or {:.0f} in double precision", nodes[0], nodes[1],
                     nodes[2], 12.0 * count, 24.0 * count);
}

// ---- Fortran's records: marker, data, marker --------------------------------------------------------------------

struct Record {
  std::int64_t size = 0;
  std::vector<std::array<std::int64_t, 2>> stretches;
};

template <class Marker>
class RecordScanner {
 public:
  RecordScanner(const Path& file, ByteOrder order)
      : file_(file), in_(file, std::ios::binary), order_(order), size_(static_cast<std::int64_t>(file_size(file)))
  {
  }

  /// Whether the file begins with a record of the number of blocks, or of dimensions.
  bool fits()
  {
    for (const std::int64_t first : {4, 8, 12})
      if (size_ >= first + 2 * marker && marker_at(0) == first && marker_at(marker + first) == first)
        return true;
    return false;
  }

  std::vector<Record> records()
  {
    std::vector<Record> result;
    bool continued = false;
    for (std::int64_t place = 0; place < size_;) {
      if (place + marker > size_)
        fail_input("{}: ends within the marker of record {}, at byte {}", file_.string(), result.size() + 1, place);
      const std::int64_t size = marker_at(place);
      const std::int64_t length = std::abs(size);  // negative: the record goes on in another part
      if (place + 2 * marker + length > size_)
        fail_input("{}: is cut short: record {} at byte {} has {} bytes, of which the file holds {}", file_.string(),
                   result.size() + (continued ? 0 : 1), place, length, size_ - place - marker);
      if (std::abs(marker_at(place + marker + length)) != length)
        fail_input("{}: record {} at byte {} has {} bytes by its first marker and {} by its last; it is damaged",
                   file_.string(), result.size() + (continued ? 0 : 1), place, length,
                   marker_at(place + marker + length));
      if (!continued)
        result.emplace_back();
      result.back().size += length;
      result.back().stretches.push_back({place + marker, length});
      continued = size < 0;
      place += 2 * marker + length;
    }
    return result;
  }

 private:
  static constexpr std::int64_t marker = sizeof(Marker);

  std::int64_t marker_at(std::int64_t place)
  {
    std::array<char, sizeof(Marker)> bytes{};
    in_.seekg(place);
    in_.read(bytes.data(), marker);
    return number_at<Marker>(bytes.data(), order_);
  }

  Path file_;
  std::ifstream in_;
  ByteOrder order_;
  std::int64_t size_;
};

Layout layout_of_records(const Path& file, ByteOrder order, const std::vector<Record>& records)
{
  Layout layout{.order = order, .stretches = {}};
  for (const Record& record : records)
    layout.stretches.insert(layout.stretches.end(), record.stretches.begin(), record.stretches.end());
  DataFile data = data_of(file, layout);
  const bool counted = records.front().size == 4;
  if (counted)
    require_one_block(data.numbers<std::int32_t>(0, 1)[0], file.string());
  const std::size_t dimensions = counted ? 1 : 0;
  if (records.size() != dimensions + 2)
    fail_input("{}: has {} record(s); a grid of one block has its dimensions in one and its coordinates in another",
               file.string(), records.size() - dimensions);
  if (records[dimensions].size != 12)
    fail_input("{}: the record of its dimensions has {} bytes; three numbers of nodes take 12", file.string(),
               records[dimensions].size);
  const auto size = data.numbers<std::int32_t>(counted ? 4 : 0, 3);
  layout.nodes = {size[0], size[1], size[2]};
  require_cells(layout.nodes, file.string());
  layout.coordinates = counted ? 16 : 12;
  const std::int64_t found = records[dimensions + 1].size;
  const auto bytes = coordinate_bytes(double(size[0]) * size[1] * size[2], double(found));
  if (!bytes)
    fail_input("{}: {}; the record of its coordinates has {}", file.string(), needed(layout.nodes), found);
  layout.bytes = *bytes;
  return layout;
}

template <class Marker>
std::optional<Layout> find_records(const Path& file)
{
  for (const ByteOrder order : {ByteOrder::Ours, ByteOrder::Swapped})
    if (RecordScanner<Marker> scanner(file, order); scanner.fits())
      return layout_of_records(file, order, scanner.records());
  return std::nullopt;
}

// ---- numbers and nothing else -----------------------------------------------------------------------------------

/// What the first numbers say if they are in this order, with or without the number of blocks.
struct Header {
  std::vector<Index3> blocks;
  std::int64_t size = 0;  ///< in bytes

  [[nodiscard]] double nodes() const
  {
    double sum = 0.0;
    for (const Index3& n : blocks)
      sum += double(n[0]) * n[1] * n[2];
    return sum;
  }
};

std::optional<Header> header_of(DataFile& data, bool counted)
{
  constexpr int most_blocks = 100000;
  if (data.size() < 16)
    return std::nullopt;
  const int blocks = counted ? data.numbers<std::int32_t>(0, 1)[0] : 1;
  const std::int64_t before = counted ? 4 : 0;
  if (blocks < 1 || blocks > most_blocks || data.size() < before + 12 * blocks)
    return std::nullopt;
  Header header{.blocks = {}, .size = before + 12 * blocks};
  const auto sizes = data.numbers<std::int32_t>(before, 3 * blocks);
  for (int b = 0; b < blocks; ++b) {
    header.blocks.push_back({sizes[3 * b], sizes[3 * b + 1], sizes[3 * b + 2]});
    if (sizes[3 * b] < 1 || sizes[3 * b + 1] < 1 || sizes[3 * b + 2] < 1)
      return std::nullopt;
  }
  return header;
}

Layout layout_of_binary(const Path& file)
{
  const auto size = static_cast<std::int64_t>(file_size(file));
  std::string misfit;
  for (const ByteOrder order : {ByteOrder::Ours, ByteOrder::Swapped})
    for (const bool counted : {true, false}) {
      Layout layout{.order = order, .stretches = {{0, size}}};
      DataFile data = data_of(file, layout);
      const auto header = header_of(data, counted);
      if (!header)
        continue;
      if (const auto bytes = coordinate_bytes(header->nodes(), double(size - header->size))) {
        require_one_block(static_cast<int>(header->blocks.size()), file.string());
        require_cells(header->blocks[0], file.string());
        layout.nodes = header->blocks[0];
        layout.coordinates = header->size;
        layout.bytes = *bytes;
        return layout;
      }
      // Numbers of the wrong byte order are beyond any file.
      if (header->nodes() < 1e12 && header->blocks.size() == 1)
        misfit = fmt::format("{}; after its {} bytes of dimensions the file has {}", needed(header->blocks[0]),
                             header->size, size - header->size);
    }
  if (misfit.empty())
    fail_input(
        "{}: is no PLOT3D grid: neither text, nor Fortran's records, nor binary numbers that begin with its "
        "dimensions",
        file.string());
  fail_input("{}: {}", file.string(), misfit);
}

template <class Number>
std::vector<Vec3> read_nodes(DataFile& data, const Layout& layout, const IndexBox& box)
{
  std::vector<Vec3> nodes(box.volume());
  const auto [ni, nj, nk] = layout.nodes;
  for (int d = 0; d < 3; ++d) {
    std::size_t n = 0;
    for (int k = box.lo[2]; k < box.hi[2]; ++k)
      for (int j = box.lo[1]; j < box.hi[1]; ++j) {
        const std::int64_t first = ((std::int64_t(d) * nk + k) * nj + j) * ni + box.lo[0];
        for (const Number value : data.numbers<Number>(
                 layout.coordinates + first * static_cast<std::int64_t>(sizeof(Number)), box.extent(0)))
          nodes[n++][d] = value;
      }
  }
  return nodes;
}

}  // namespace

CurvilinearNodes open_plot3d(const std::filesystem::path& file)
{
  if (is_plot3d_text(file))
    return open_plot3d_text(file);
  auto layout = find_records<std::int32_t>(file);
  if (!layout)
    layout = find_records<std::int64_t>(file);
  if (!layout)
    layout = layout_of_binary(file);
  return {{layout->nodes[0] - 1, layout->nodes[1] - 1, layout->nodes[2] - 1},
          [file, layout = *layout](const IndexBox& box) {
            DataFile data = data_of(file, layout);
            return layout.bytes == 4 ? read_nodes<float>(data, layout, box) : read_nodes<double>(data, layout, box);
          }};
}

}  // namespace luff::grid
