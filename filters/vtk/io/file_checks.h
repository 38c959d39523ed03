// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_file_checks_h
#define palpate_file_checks_h

#include <string>

/// What VTK's readers do not check before they trust a file.
namespace palpate::io
{
/// Appends to a finished .vtp file the CRC-32 of its bytes, as an XML comment behind the root element,
/// where readers do not look.
/// @throws std::runtime_error if the file cannot be read or written.
void sealXml(const std::string& path);

/// @throws std::runtime_error if the file ends before its root element does, or if it is sealed and
///         has changed since. Files of other programs carry no seal.
void requireWholeXml(const std::string& path);

/// @throws std::runtime_error if a binary STL file is shorter than its triangles need, of which VTK
///         would read what there is.
void requireWholeStl(const std::string& path);
} // namespace palpate::io

#endif
