// SPDX-License-Identifier: BSD-3-Clause
#include "output/integrity.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include "parallel/agreement.hpp"

namespace luff::output {

namespace {

constexpr const char* title = "luff checkpoint";
/// Files are read by blocks of this size, block n by rank n modulo the number of ranks; part of the format.
constexpr std::int64_t block_bytes = std::int64_t{1} << 22;

/// An open file; -1 where it could not be opened.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : number_(open(path.c_str(), flags | O_CLOEXEC)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor()
  {
    if (number_ >= 0)
      close(number_);
  }
  [[nodiscard]] bool good() const { return number_ >= 0; }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

bool read_fully(int file, std::int64_t from, std::vector<unsigned char>& bytes)
{
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = pread(file, bytes.data() + done, bytes.size() - done, from + static_cast<off_t>(done));
    if (got <= 0)
      return false;
    done += got;
  }
  return true;
}

/// CRC-32 of the CRC-32s of the blocks of [from, to).  Nothing if any rank cannot read its share.  Collective.
std::optional<std::uint32_t> checksum(MPI_Comm comm, const std::filesystem::path& path, std::int64_t from,
                                      std::int64_t to)
{
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  const Descriptor file(path, O_RDONLY);
  bool good = file.good();
  std::vector<std::uint32_t> of_block((std::max<std::int64_t>(to - from, 0) + block_bytes - 1) / block_bytes, 0);
  std::vector<unsigned char> bytes;
  for (std::size_t n = rank; good && n < of_block.size(); n += ranks) {
    const std::int64_t first = from + static_cast<std::int64_t>(n) * block_bytes;
    bytes.resize(std::min(block_bytes, to - first));
    good = read_fully(file.number(), first, bytes);
    of_block[n] = crc32_z(0, bytes.data(), bytes.size());
  }
  if (!on_all_ranks(comm, good))
    return std::nullopt;
  MPI_Allreduce(MPI_IN_PLACE, of_block.data(), static_cast<int>(of_block.size()), MPI_UINT32_T, MPI_BOR, comm);
  return crc32_z(0, reinterpret_cast<const unsigned char*>(of_block.data()), 4 * of_block.size());
}

std::int64_t size_of(const std::filesystem::path& path)
{
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return error ? -1 : static_cast<std::int64_t>(size);
}

/// What a seal says.
struct Statement {
  int format = 0;
  std::int64_t bytes = -1;
  std::uint32_t checksum = 0;
};

std::string text_of(const Statement& s)
{
  std::string text = fmt::format("{}\nformat {}\nbytes {}\nchecksum {:08x}\n", title, s.format, s.bytes, s.checksum);
  text.resize(seal_bytes, '\n');
  return text;
}

std::optional<Statement> read_statement(const std::filesystem::path& path)
{
  const Descriptor file(path, O_RDONLY);
  std::vector<unsigned char> bytes(seal_bytes);
  if (!file.good() || !read_fully(file.number(), 0, bytes))
    return std::nullopt;
  const std::string text(bytes.begin(), bytes.end());
  std::istringstream in(text);
  std::string first;
  std::string word;
  Statement s;
  std::getline(in, first);
  in >> word >> s.format >> word >> s.bytes >> word >> std::hex >> s.checksum;
  // A seal is the text that its numbers make, to the last byte.
  if (first != title || !in || text != text_of(s))
    return std::nullopt;
  return s;
}

bool write_statement(const std::filesystem::path& path, const Statement& statement)
{
  const Descriptor file(path, O_WRONLY);
  const std::string text = text_of(statement);
  return file.good() && pwrite(file.number(), text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()) &&
         fsync(file.number()) == 0;
}

}  // namespace

bool seal(MPI_Comm comm, const std::filesystem::path& file, int format)
{
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::int64_t bytes = size_of(file);
  MPI_Bcast(&bytes, 1, MPI_INT64_T, 0, comm);
  const std::optional<std::uint32_t> sum = checksum(comm, file, seal_bytes, bytes);
  bool good = sum.has_value() && bytes > seal_bytes;
  if (good && rank == 0)
    good = write_statement(file, {format, bytes, *sum});
  return on_all_ranks(comm, good);
}

std::string broken_seal(MPI_Comm comm, const std::filesystem::path& file, int format)
{
  std::int64_t bytes = size_of(file);
  MPI_Bcast(&bytes, 1, MPI_INT64_T, 0, comm);
  const std::optional<Statement> statement = read_statement(file);
  if (bytes < 0)
    return "it cannot be read";
  if (!on_all_ranks(comm, statement.has_value()))
    return "it does not begin as a checkpoint does: its first bytes are damaged, or it is another kind of file";
  if (statement->format != format)
    return fmt::format("it has format {}, and this version reads format {}", statement->format, format);
  if (bytes != statement->bytes)
    return fmt::format("it has {} bytes instead of {}: it was cut short or added to", bytes, statement->bytes);
  const std::optional<std::uint32_t> sum = checksum(comm, file, seal_bytes, bytes);
  if (!sum)
    return "it cannot be read to its end";
  if (*sum != statement->checksum)
    return "its checksum is wrong: bytes of it changed after it was written";
  return "";
}

bool flush_to_disk(const std::filesystem::path& path)
{
  const Descriptor file(path, O_RDONLY);
  return file.good() && fsync(file.number()) == 0;
}

}  // namespace luff::output
