// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace palpate {

/// Puts a file in its place when it is whole. Whatever fails, an older file of that name stays as
/// it was and nothing else is left; a symbolic link goes on to lead where it led.
/// @param write  writes the file under the name that it is given, which lies beside `path`.
/// @throws what `write` throws; std::runtime_error that begins with `path` if the finished file
///         cannot be moved to its place.
void replaceFile(const std::string& path, const std::function<void(const std::string&)>& write);

/// The same through a stream of bytes.
/// @throws as above; std::runtime_error that begins with `path` if it cannot be written.
void writeWholeFile(const std::string& path, const std::function<void(std::ostream&)>& write);

}  // namespace palpate
