// SPDX-License-Identifier: BSD-3-Clause
#include "output/checkpoint_file.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include "core/error.hpp"
#include "output/integrity.hpp"
#include "parallel/agreement.hpp"

namespace luff::output {

static_assert(std::is_same_v<hid_t, std::int64_t>);

namespace {

using Dims = std::vector<hsize_t>;

/// An object of HDF5 and how to close it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle()
  {
    if (id_ >= 0)
      close_(id_);
  }
  operator hid_t() const { return id_; }  // NOLINT: stands for its number

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

Handle access_by(MPI_Comm comm)
{
  const hid_t list = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_mpio(list, comm, MPI_INFO_NULL);
  H5Pset_libver_bounds(list, H5F_LIBVER_V110, H5F_LIBVER_V110);
  return {list, H5Pclose};
}

Handle together()
{
  const hid_t list = H5Pcreate(H5P_DATASET_XFER);
  H5Pset_dxpl_mpio(list, H5FD_MPIO_COLLECTIVE);
  return {list, H5Pclose};
}

/// HDF5 prints its failures by itself; we report them, once, in our own words.
void keep_hdf5_quiet()
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// Row-major, as HDF5 counts: k, j, i.
Dims dims_of(const IndexBox& box)
{
  return {hsize_t(box.extent(2)), hsize_t(box.extent(1)), hsize_t(box.extent(0))};
}

Dims start_of(const IndexBox& box)
{
  return {hsize_t(box.lo[2]), hsize_t(box.lo[1]), hsize_t(box.lo[0])};
}

/// The cells of all ranks, from those of each.  Collective.
IndexBox domain_of(MPI_Comm comm, const IndexBox& owned)
{
  IndexBox domain = owned;
  MPI_Allreduce(MPI_IN_PLACE, domain.hi.data(), 3, MPI_INT, MPI_MAX, comm);
  domain.lo = {0, 0, 0};
  return domain;
}

constexpr int no_axis = -1;

IndexBox with_faces(const IndexBox& box, int face_axis)
{
  return face_axis == no_axis ? box : box.faces(face_axis);
}

std::string component(const std::string& name, int axis)
{
  return name + "_" + std::string(1, "xyz"[axis]);
}

}  // namespace

/// The part of a data set that this rank writes.
struct CheckpointWriter::Slab {
  Dims whole;
  Dims start;
  Dims count;  ///< empty: nothing
};

CheckpointWriter::CheckpointWriter(MPI_Comm comm, std::filesystem::path file, std::int64_t bytes)
    : comm_(comm), path_(std::move(file)), beside_(path_)
{
  MPI_Comm_rank(comm_, &rank_);
  beside_ += ".tmp";
  reserve(bytes);
  if (good_)
    create();
}

/// Asks the disk for the room: one that is full is told from here, not from within HDF5, which does not survive it.
void CheckpointWriter::reserve(std::int64_t bytes)
{
  MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_INT64_T, MPI_SUM, comm_);
  bool granted = true;
  if (rank_ == 0) {
    const int file = ::open(beside_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    granted = file >= 0;
    // File systems that cannot promise room are asked when it is written.
    if (granted && fallocate(file, 0, 0, bytes + seal_bytes) != 0)
      granted = errno == EOPNOTSUPP || errno == ENOSYS;
    if (file >= 0)
      ::close(file);
  }
  good_ = on_all_ranks(comm_, granted);
}

void CheckpointWriter::create()
{
  keep_hdf5_quiet();
  const Handle layout(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_userblock(layout, seal_bytes);
  file_ = H5Fcreate(beside_.c_str(), H5F_ACC_TRUNC, layout, access_by(comm_));
  good_ = on_all_ranks(comm_, file_ >= 0);
  if (!good_)
    file_ = -1;  // on every rank, or those that have one would wait for the others
}

CheckpointWriter::~CheckpointWriter()
{
  if (file_ >= 0) {
    // HDF5 must still get rid of its own data to close the file, which a full disk would not let it.
    MPI_Barrier(comm_);
    std::error_code ignored;
    if (rank_ == 0)
      std::filesystem::resize_file(beside_, 0, ignored);
    MPI_Barrier(comm_);
    (void)close();
  }
  MPI_Barrier(comm_);
  std::error_code ignored;
  if (rank_ == 0)
    std::filesystem::remove(beside_, ignored);
}

bool CheckpointWriter::close()
{
  const hid_t file = std::exchange(file_, -1);
  return H5Fclose(file) >= 0;
}

void CheckpointWriter::write(const std::string& name, std::int64_t type, const Slab& slab, const void* numbers)
{
  if (file_ < 0)
    return;
  const int rank = static_cast<int>(slab.whole.size());
  const Handle space(H5Screate_simple(rank, slab.whole.data(), nullptr), H5Sclose);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  const Handle set(H5Dcreate2(file_, name.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  const Dims nothing(rank, 0);
  const Handle memory(H5Screate_simple(rank, (slab.count.empty() ? nothing : slab.count).data(), nullptr), H5Sclose);
  if (slab.count.empty()) {
    H5Sselect_none(space);
    H5Sselect_none(memory);
  } else {
    H5Sselect_hyperslab(space, H5S_SELECT_SET, slab.start.data(), nullptr, slab.count.data(), nullptr);
  }
  good_ = H5Dwrite(set, type, memory, space, together(), numbers) >= 0 && good_;
}

void CheckpointWriter::write_replicated(const std::string& name, std::int64_t type, std::int64_t size,
                                        const void* numbers)
{
  std::int64_t of_first = size;
  MPI_Bcast(&of_first, 1, MPI_INT64_T, 0, comm_);
  const bool writes = rank_ == 0 && size > 0;
  write(name, type, {{hsize_t(of_first)}, {0}, writes ? Dims{hsize_t(size)} : Dims{}}, numbers);
}

void CheckpointWriter::write_piece(const std::string& name, std::int64_t type, std::int64_t size, const void* numbers)
{
  std::int64_t first = 0, all = 0;
  MPI_Exscan(&size, &first, 1, MPI_INT64_T, MPI_SUM, comm_);
  MPI_Allreduce(&size, &all, 1, MPI_INT64_T, MPI_SUM, comm_);
  write(name, type, {{hsize_t(all)}, {hsize_t(rank_ == 0 ? 0 : first)}, size > 0 ? Dims{hsize_t(size)} : Dims{}},
        numbers);
}

/// Every face is written once: the low faces of each rank's cells, and the last ones of the domain.
void CheckpointWriter::write_box(const std::string& name, const Field<double>& field, int face_axis)
{
  const IndexBox domain = domain_of(comm_, field.owned());
  IndexBox mine = field.owned();
  if (face_axis != no_axis && mine.hi[face_axis] == domain.hi[face_axis])
    mine = mine.faces(face_axis);
  std::vector<double> packed;
  packed.reserve(mine.volume());
  for (int k = mine.lo[2]; k < mine.hi[2]; ++k)
    for (int j = mine.lo[1]; j < mine.hi[1]; ++j)
      packed.insert(packed.end(), field.view().row(j, k) + mine.lo[0], field.view().row(j, k) + mine.hi[0]);
  write(name, H5T_NATIVE_DOUBLE, {dims_of(with_faces(domain, face_axis)), start_of(mine), dims_of(mine)},
        packed.data());
}

void CheckpointWriter::value(const std::string& name, double x)
{
  write_replicated(name, H5T_NATIVE_DOUBLE, 1, &x);
}

void CheckpointWriter::count(const std::string& name, std::int64_t x)
{
  write_replicated(name, H5T_NATIVE_INT64, 1, &x);
}

void CheckpointWriter::value(const std::string& name, const std::string& text)
{
  write_replicated(name, H5T_NATIVE_UCHAR, static_cast<std::int64_t>(text.size()), text.data());
}

void CheckpointWriter::value(const std::string& name, const std::vector<double>& x)
{
  write_replicated(name, H5T_NATIVE_DOUBLE, static_cast<std::int64_t>(x.size()), x.data());
}

void CheckpointWriter::value(const std::string& name, const std::vector<std::int64_t>& x)
{
  write_replicated(name, H5T_NATIVE_INT64, static_cast<std::int64_t>(x.size()), x.data());
}

void CheckpointWriter::value(const std::string& name, const Eigen::VectorXd& x)
{
  write_replicated(name, H5T_NATIVE_DOUBLE, x.size(), x.data());
}

void CheckpointWriter::cells(const std::string& name, const Field<double>& field)
{
  write_box(name, field, no_axis);
}

void CheckpointWriter::cells(const std::string& name, const Field3<double>& field)
{
  for (int axis = 0; axis < 3; ++axis)
    write_box(component(name, axis), field[axis], no_axis);
}

void CheckpointWriter::faces(const std::string& name, const Field3<double>& field)
{
  for (int axis = 0; axis < 3; ++axis)
    write_box(component(name, axis), field[axis], axis);
}

void CheckpointWriter::pieces(const std::string& name, const std::vector<double>& mine)
{
  write_piece(name, H5T_NATIVE_DOUBLE, static_cast<std::int64_t>(mine.size()), mine.data());
}

void CheckpointWriter::pieces(const std::string& name, const std::vector<std::int64_t>& mine)
{
  write_piece(name, H5T_NATIVE_INT64, static_cast<std::int64_t>(mine.size()), mine.data());
}

void CheckpointWriter::commit()
{
  bool good = on_all_ranks(comm_, good_) && on_all_ranks(comm_, close()) && seal(comm_, beside_, checkpoint_format);
  std::error_code error;
  if (good && rank_ == 0) {
    std::filesystem::rename(beside_, path_, error);
    good = !error && flush_to_disk(path_.parent_path());
  }
  if (!on_all_ranks(comm_, good))
    fail_run("{}: cannot be written; is the disk full, or the folder gone?", path_.string());
}

CheckpointReader::CheckpointReader(MPI_Comm comm, std::filesystem::path file) : comm_(comm), path_(std::move(file))
{
  keep_hdf5_quiet();
  file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access_by(comm_));
  if (!on_all_ranks(comm_, file_ >= 0))
    fail_input("{}: cannot be read as a checkpoint", path_.string());
}

CheckpointReader::~CheckpointReader()
{
  if (file_ >= 0)
    H5Fclose(file_);
}

void CheckpointReader::fail(const std::string& name) const
{
  fail_input(
      "{}: '{}' is not in it as this version of luff expects: it was written by another version, or for another "
      "case",
      path_.string(), name);
}

std::int64_t CheckpointReader::open(const std::string& name) const
{
  const hid_t set = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
  if (set < 0)
    fail(name);
  return set;
}

std::int64_t CheckpointReader::length(const std::string& name) const
{
  const Handle set(open(name), H5Dclose);
  const Handle space(H5Dget_space(set), H5Sclose);
  return H5Sget_simple_extent_npoints(space);
}

void CheckpointReader::read_whole(const std::string& name, std::int64_t type, std::int64_t size, void* numbers) const
{
  const Handle set(open(name), H5Dclose);
  const Handle space(H5Dget_space(set), H5Sclose);
  const bool fits = H5Sget_simple_extent_npoints(space) == size;
  if (!on_all_ranks(comm_, fits && H5Dread(set, type, H5S_ALL, H5S_ALL, together(), numbers) >= 0))
    fail(name);
}

void CheckpointReader::read_box(const std::string& name, Field<double>& field, int face_axis) const
{
  const Handle set(open(name), H5Dclose);
  const Handle space(H5Dget_space(set), H5Sclose);
  const Dims whole = dims_of(with_faces(domain_of(comm_, field.owned()), face_axis));
  Dims found(whole.size());
  if (H5Sget_simple_extent_ndims(space) != static_cast<int>(whole.size()) ||
      H5Sget_simple_extent_dims(space, found.data(), nullptr) < 0 || found != whole)
    fail(name);
  const IndexBox mine = with_faces(field.owned(), face_axis);
  const Dims start = start_of(mine), count = dims_of(mine);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  const Handle memory(H5Screate_simple(3, count.data(), nullptr), H5Sclose);
  std::vector<double> packed(mine.volume());
  if (!on_all_ranks(comm_, H5Dread(set, H5T_NATIVE_DOUBLE, memory, space, together(), packed.data()) >= 0))
    fail(name);
  const double* row = packed.data();
  for (int k = mine.lo[2]; k < mine.hi[2]; ++k)
    for (int j = mine.lo[1]; j < mine.hi[1]; ++j, row += mine.extent(0))
      std::copy_n(row, mine.extent(0), field.view().row(j, k) + mine.lo[0]);
}

void CheckpointReader::value(const std::string& name, double& x) const
{
  read_whole(name, H5T_NATIVE_DOUBLE, 1, &x);
}

std::int64_t CheckpointReader::count(const std::string& name) const
{
  std::int64_t x = 0;
  read_whole(name, H5T_NATIVE_INT64, 1, &x);
  return x;
}

void CheckpointReader::value(const std::string& name, std::string& text) const
{
  text.resize(length(name));
  read_whole(name, H5T_NATIVE_UCHAR, static_cast<std::int64_t>(text.size()), text.data());
}

void CheckpointReader::value(const std::string& name, std::vector<double>& x) const
{
  x.resize(length(name));
  read_whole(name, H5T_NATIVE_DOUBLE, static_cast<std::int64_t>(x.size()), x.data());
}

void CheckpointReader::value(const std::string& name, std::vector<std::int64_t>& x) const
{
  x.resize(length(name));
  read_whole(name, H5T_NATIVE_INT64, static_cast<std::int64_t>(x.size()), x.data());
}

void CheckpointReader::value(const std::string& name, Eigen::VectorXd& x) const
{
  x.resize(length(name));
  read_whole(name, H5T_NATIVE_DOUBLE, x.size(), x.data());
}

void CheckpointReader::cells(const std::string& name, Field<double>& field) const
{
  read_box(name, field, no_axis);
}

void CheckpointReader::cells(const std::string& name, Field3<double>& field) const
{
  for (int axis = 0; axis < 3; ++axis)
    read_box(component(name, axis), field[axis], no_axis);
}

void CheckpointReader::faces(const std::string& name, Field3<double>& field) const
{
  for (int axis = 0; axis < 3; ++axis)
    read_box(component(name, axis), field[axis], axis);
}

}  // namespace luff::output
