// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_file_checks_h
#define palpate_file_checks_h

#include <functional>
#include <string>

/// What VTK's readers do not check before they trust a file.
namespace palpate::io
{
/// @throws std::runtime_error if there is no such file, or none that may be read.
void requireReadable(const std::string& path);

/// Appends to a finished .vtp file the CRC-32 of its bytes, as an XML comment behind the root element,
/// where readers do not look.
/// @throws std::runtime_error if the file cannot be read or written.
void sealXml(const std::string& path);

/// @return true if the file is sealed and whole; files of other programs carry no seal.
/// @throws std::runtime_error if the file ends before its root element does, or if it is sealed and
///         has changed since.
bool requireWholeXml(const std::string& path);

/// Reads a file in a process of its own first, with bounded time and memory: VTK's readers crash on
/// some damaged files.
/// @param read  what will be done with the file; what it throws is left to the reading proper.
/// @throws std::runtime_error if the process crashed or went beyond its bounds.
void rehearse(const std::string& path, const std::function<void()>& read);

/// @throws std::runtime_error naming the line if a vertex of an OBJ file has not three numbers or a face
///         not whole numbers for its corners, of which VTK would read what there is.
void requireNumbersInObj(const std::string& path);

/// @throws std::runtime_error if a binary STL file is shorter than its triangles need, of which VTK
///         would read what there is.
void requireWholeStl(const std::string& path);
} // namespace palpate::io

#endif
