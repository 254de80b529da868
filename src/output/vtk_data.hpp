// SPDX-License-Identifier: BSD-3-Clause
// From plain numbers to VTK's data objects and files; only the sources of this folder see VTK.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkSmartPointer.h>
#include <vtkXMLWriter.h>

#include "output/snapshot.hpp"

namespace luff::output {

/// The field's numbers as a VTK array that refers to them: the field must outlive it.
vtkSmartPointer<vtkDataArray> vtk_array(const NamedField& field);

/// Adds the fields, each of which must have numbers for `tuples` points or cells.
void add_fields(vtkDataSetAttributes& attributes, const std::vector<NamedField>& fields, std::size_t tuples);

/// Gives the data set the time that ParaView shows.
void set_time(vtkDataSet& data, double time);

/// Writes the data appended, raw and compressed with zlib; false if that fails, with nothing printed.
bool write_vtk(vtkXMLWriter& writer, vtkDataSet& data, const std::filesystem::path& file);

/// VTK's name of the numbers' type in files: Float32 or Float64.
std::string vtk_type(const NamedField& field);

}  // namespace luff::output
