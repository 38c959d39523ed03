// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_checked_read_h
#define palpate_checked_read_h

#include "file_checks.h"

#include "vtkAlgorithm.h"
#include "vtkNew.h"
#include "vtkType.h"

#include <stdexcept>
#include <string>

class vtkCellArray;
class vtkDataSetAttributes;

/// VTK's own readers, with what they do not check.
namespace palpate::io
{
/// VTK's readers print what is wrong and go on; this keeps them quiet and remembers that it was.
class QuietRead
{
public:
  explicit QuietRead(vtkAlgorithm* reader);
  ~QuietRead();
  bool HasFailed() const { return this->Failed; }

private:
  vtkTypeBool DisplayBefore;
  bool Failed = false;
};

/// @throws std::runtime_error if the reader reports an error.
template <class Reader, class Data>
void readWith(const std::string& path, Data* output)
{
  vtkNew<Reader> reader;
  const QuietRead quiet(reader);
  reader->SetFileName(path.c_str());
  reader->Update();
  if (quiet.HasFailed() || reader->GetErrorCode() != 0 || !reader->GetOutput())
  {
    throw std::runtime_error("the file is damaged or not of the kind that its extension says");
  }
  output->ShallowCopy(reader->GetOutput());
}

/// The same, rehearsed first.
template <class Reader, class Data>
void readWarily(const std::string& path, Data* output)
{
  rehearse(path,
    [&]
    {
      vtkNew<Data> unused;
      readWith<Reader>(path, unused.Get());
    });
  readWith<Reader>(path, output);
}

/// Reads VTK's XML: a sealed file at once, others rehearsed first.
/// @throws as requireWholeXml and readWith.
template <class Reader, class Data>
void readXml(const std::string& path, Data* output)
{
  if (requireWholeXml(path))
  {
    readWith<Reader>(path, output);
  }
  else
  {
    readWarily<Reader>(path, output);
  }
}

/// @throws std::runtime_error naming a point that a cell refers to and that is not there.
void requireConsistentCells(vtkCellArray* cells, vtkIdType pointCount);

/// @throws std::runtime_error naming an array that has not a tuple a `what`.
void requireConsistentArrays(vtkDataSetAttributes* attributes, vtkIdType count, const char* what);
} // namespace palpate::io

#endif
