// SPDX-License-Identifier: BSD-3-Clause
// A seal in front of a file that tells whether all of it is there and unchanged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <mpi.h>

namespace luff::output {

/// Bytes that a sealed file leaves free at its start.
inline constexpr std::int64_t seal_bytes = 512;

/// Writes the seal, a few lines of text (what the file is, its format, its length, a CRC-32 of what follows), and makes
/// the file last on disk.  Each rank reads a share of the file.  False on every rank if anything fails.  Collective.
[[nodiscard]] bool seal(MPI_Comm comm, const std::filesystem::path& file, int format);

/// Why a file cannot be trusted, in words; empty if it can.  The same on every rank.  Collective.
[[nodiscard]] std::string broken_seal(MPI_Comm comm, const std::filesystem::path& file, int format);

/// Makes what a file or folder holds last beyond a failure of power; false if the disk refuses.
[[nodiscard]] bool flush_to_disk(const std::filesystem::path& path);

}  // namespace luff::output
