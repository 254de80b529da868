// SPDX-License-Identifier: BSD-3-Clause
// The file of a checkpoint: named values and fields in HDF5, written and read by all ranks together.
//
// CheckpointSize, CheckpointWriter and CheckpointReader know the same functions, so that one template says what is in a
// checkpoint: value("clock/t", t), cells("flow/p", p), faces("flow/U", U), pieces("offset", mine).
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Core>
#include <mpi.h>

#include "parallel/field.hpp"

namespace luff::output {

/// Number of the layout of names and values in a file; raise it when one is added, renamed or gets another meaning.
inline constexpr int checkpoint_format = 6;

/// Room that a checkpoint takes, before a byte of it is written.
class CheckpointSize {
 public:
  template <class T>
  void value(const std::string& /*name*/, const T& x)
  {
    bytes_ += per_item + size_of(x);
  }
  template <class T>
  void cells(const std::string& /*name*/, const T& field)
  {
    add_box(field);
  }
  template <class T>
  void faces(const std::string& /*name*/, const T& field)
  {
    add_box(field);
  }
  template <class T>
  void pieces(const std::string& /*name*/, const std::vector<T>& mine)
  {
    bytes_ += per_item + static_cast<std::int64_t>(sizeof(T) * mine.size());
  }
  /// Of what this rank writes.
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }

 private:
  static constexpr std::int64_t per_item = 1024;  ///< names and headers, generously
  template <class T>
  static std::int64_t size_of(const T& x)
  {
    if constexpr (std::is_arithmetic_v<T>)
      return sizeof(double);
    else
      return static_cast<std::int64_t>(sizeof(*x.data())) * static_cast<std::int64_t>(x.size());
  }
  void add_box(const Field<double>& field)
  {
    bytes_ += per_item + 8 * field.owned().faces(0).faces(1).faces(2).volume();
  }
  void add_box(const Field3<double>& field)
  {
    for (const Field<double>& component : field)
      add_box(component);
  }

  std::int64_t bytes_ = 0;
};

/// Writes a file whole or not at all: beside its name first, renamed when all of it is on disk.
///
/// Nothing throws but commit(), on every rank, so that all ranks make the same calls.  Every function is collective;
/// a value is the same on all ranks, and the first rank's is written.
class CheckpointWriter {
 public:
  /// `bytes`: room that this rank's part will take; it is asked of the disk at once.
  CheckpointWriter(MPI_Comm comm, std::filesystem::path file, std::int64_t bytes);
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;
  /// Leaves no trace of a file that was not committed.  Collective.
  ~CheckpointWriter();

  void value(const std::string& name, double x);
  template <std::integral T>
  void value(const std::string& name, T x)
  {
    count(name, static_cast<std::int64_t>(x));
  }
  void value(const std::string& name, const std::string& text);
  void value(const std::string& name, const std::vector<double>& x);
  void value(const std::string& name, const std::vector<std::int64_t>& x);
  void value(const std::string& name, const Eigen::VectorXd& x);
  /// A field over the cells of the domain.
  void cells(const std::string& name, const Field<double>& field);
  void cells(const std::string& name, const Field3<double>& field);
  /// Fields over the faces normal to each axis, those on the domain's sides included.
  void faces(const std::string& name, const Field3<double>& field);
  /// What each rank has, one after the other.
  void pieces(const std::string& name, const std::vector<double>& mine);
  void pieces(const std::string& name, const std::vector<std::int64_t>& mine);

  /// Throws RunError if any of it could not be written; then the file that had the name before is still there.
  void commit();

 private:
  struct Slab;
  void count(const std::string& name, std::int64_t x);
  void reserve(std::int64_t bytes);
  void create();
  void write(const std::string& name, std::int64_t type, const Slab& slab, const void* numbers);
  void write_replicated(const std::string& name, std::int64_t type, std::int64_t size, const void* numbers);
  void write_piece(const std::string& name, std::int64_t type, std::int64_t size, const void* numbers);
  void write_box(const std::string& name, const Field<double>& field, int face_axis);
  bool close();

  MPI_Comm comm_;
  std::filesystem::path path_;
  std::filesystem::path beside_;
  int rank_ = 0;
  std::int64_t file_ = -1;
  bool good_ = true;
};

/// Reads what a CheckpointWriter wrote, on any number of ranks.  Every function is collective and throws InputError on
/// every rank if the file does not hold what is asked for.
class CheckpointReader {
 public:
  /// The file must have passed broken_seal().
  CheckpointReader(MPI_Comm comm, std::filesystem::path file);
  CheckpointReader(const CheckpointReader&) = delete;
  CheckpointReader& operator=(const CheckpointReader&) = delete;
  ~CheckpointReader();

  void value(const std::string& name, double& x) const;
  template <std::integral T>
  void value(const std::string& name, T& x) const
  {
    x = static_cast<T>(count(name));
  }
  void value(const std::string& name, std::string& text) const;
  void value(const std::string& name, std::vector<double>& x) const;
  void value(const std::string& name, std::vector<std::int64_t>& x) const;
  void value(const std::string& name, Eigen::VectorXd& x) const;
  /// Fills the owned cells of a field; its domain must be the file's.
  void cells(const std::string& name, Field<double>& field) const;
  void cells(const std::string& name, Field3<double>& field) const;
  /// Fills all faces of owned cells.
  void faces(const std::string& name, Field3<double>& field) const;
  /// The pieces of all ranks together.
  void pieces(const std::string& name, std::vector<double>& all) const { value(name, all); }
  void pieces(const std::string& name, std::vector<std::int64_t>& all) const { value(name, all); }

 private:
  [[noreturn]] void fail(const std::string& name) const;
  [[nodiscard]] std::int64_t count(const std::string& name) const;
  [[nodiscard]] std::int64_t open(const std::string& name) const;
  [[nodiscard]] std::int64_t length(const std::string& name) const;
  void read_whole(const std::string& name, std::int64_t type, std::int64_t size, void* numbers) const;
  void read_box(const std::string& name, Field<double>& field, int face_axis) const;

  MPI_Comm comm_;
  std::filesystem::path path_;
  std::int64_t file_ = -1;
};

}  // namespace luff::output
