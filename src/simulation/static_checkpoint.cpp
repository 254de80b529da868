// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/static_checkpoint.hpp"

#include "config/changes.hpp"

namespace luff::simulation {

namespace {

/// The case and what was written of it, as text.
struct Texts {
  std::string keys;
  std::string marks;
};

// What is in a checkpoint: a line for each item. `File` is a CheckpointSize, CheckpointWriter or CheckpointReader, so
// that sizing, writing and reading cannot differ.

template <class File, class T>
void transfer_texts(File& file, T& texts)
{
  file.value("case", texts.keys);
  file.value("output", texts.marks);
}

template <class File, class Point>
void transfer_point(File& file, Point& point)
{
  file.value("path/step", point.step);
  file.value("path/load_factor", point.load_factor);
  file.value("path/x", point.positions);
  file.value("path/step_length", point.control.length);
  file.value("path/successes", point.control.successes);
  file.value("path/first_length", point.control.first_length);
  file.value("path/last_move", point.control.last_move);
}

template <class File, class R>
void transfer_record(File& file, R& record)
{
  file.value("static/steps", record.steps);
  file.value("static/shell", record.shell);
  transfer_point(file, record.point);
  file.value("static/sharp_folds", record.sharp_folds);
  file.value("static/most_pairs", record.contact.most_pairs);
  file.value("static/crossings", record.contact.crossings);
  file.value("static/smallest_gap", record.contact.smallest_gap);
  file.value("static/summary", record.summary);
}

std::vector<Shape> shapes_of(const std::vector<LoadedShell>& shells)
{
  std::vector<Shape> shapes;
  for (const LoadedShell& loaded : shells)
    for (const shell::PieceRange& piece : loaded.shell->pieces())
      shapes.push_back(shape_of_mesh(piece.name, loaded.shell->reference_of(piece)));
  return shapes;
}

}  // namespace

void write_checkpoint(const output::RunFolder& folder, const config::Case& options,
                      const std::vector<LoadedShell>& shells, const StaticRecord& record)
{
  const Texts texts{config::list_keys(options), output::text_of_marks(record.output)};
  const std::vector<Shape> shapes = shapes_of(shells);
  write_checkpoint_file(folder, record.steps, [&](auto& file) {
    transfer_texts(file, texts);
    for (const Shape& shape : shapes)
      file.value(shape.name, shape.numbers);
    transfer_record(file, record);
  });
}

StaticResumption resume_static(MPI_Comm comm, const RestartRequest& request, const config::Case& options,
                               const std::vector<LoadedShell>& shells)
{
  const output::FoundCheckpoint found = output::find_checkpoint(comm, request.from);
  const output::CheckpointReader file(comm, found.file);
  Texts texts;
  transfer_texts(file, texts);
  StaticResumption resumption;
  resumption.folder = std::filesystem::absolute(found.file).parent_path();
  resumption.passed_over = found.passed_over;
  resumption.changed = config::accept_changes(texts.keys, options, request.case_file, request.overrides);
  require_same_shapes(file, shapes_of(shells));
  transfer_record(file, resumption.record);
  resumption.record.output = output::marks_of_text(texts.marks);
  resumption.record.output.folder = resumption.folder;
  return resumption;
}

}  // namespace luff::simulation
