// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "file_checks.h"
#include "mesh/number_text.h"

#include "vtksys/SystemTools.hxx"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace palpate::io
{
namespace
{
constexpr const char* SealStart = "\n<!-- CRC-32 of all above: ";
constexpr const char* SealEnd = " -->\n";
constexpr std::size_t SealDigits = 8;

std::uint64_t sizeOf(std::ifstream& file)
{
  file.clear();
  file.seekg(0, std::ios::end);
  return static_cast<std::uint64_t>(std::max<std::streamoff>(file.tellg(), 0));
}

/// The last bytes of a file, at most `count`.
std::string endOf(std::ifstream& file, std::uint64_t count)
{
  const std::uint64_t size = sizeOf(file);
  count = std::min(count, size);
  std::string text(count, ' ');
  file.seekg(static_cast<std::streamoff>(size - count));
  file.read(&text[0], static_cast<std::streamsize>(count));
  return text;
}

/// CRC-32 of the first bytes of a file, as hexadecimal digits.
std::string checksum(std::ifstream& file, std::uint64_t size)
{
  std::vector<char> block(1 << 20);
  uLong sum = crc32(0, nullptr, 0);
  file.clear();
  file.seekg(0);
  while (size > 0 && file)
  {
    file.read(block.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(size, block.size())));
    sum = crc32(sum, reinterpret_cast<const Bytef*>(block.data()), static_cast<uInt>(file.gcount()));
    size -= static_cast<std::uint64_t>(file.gcount());
  }
  char digits[SealDigits + 1];
  std::snprintf(digits, sizeof digits, "%08lx", sum);
  return digits;
}
} // namespace

void requireReadable(const std::string& path)
{
  if (access(path.c_str(), R_OK) != 0)
  {
    throw std::runtime_error(errno == ENOENT || errno == ENOTDIR
        ? std::string("there is no such file")
        : std::string("cannot be read: ") + std::strerror(errno));
  }
  if (vtksys::SystemTools::FileIsDirectory(path))
  {
    throw std::runtime_error("is a folder, not a file");
  }
}

void sealXml(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  const std::string seal = SealStart + checksum(file, sizeOf(file)) + SealEnd;
  file.close();
  std::ofstream end(path, std::ios::binary | std::ios::app);
  end << seal;
  end.close();
  if (!file || !end)
  {
    throw std::runtime_error("the file cannot be written whole: is the disk full?");
  }
}

bool requireWholeXml(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  const std::string end = endOf(file, 256);
  const std::size_t root = end.rfind("</VTKFile>");
  if (root == std::string::npos)
  {
    throw std::runtime_error("the file is cut short or not a VTK file");
  }
  const std::size_t seal = end.find(SealStart, root);
  if (seal == std::string::npos)
  {
    return false;
  }
  const std::string stored = end.substr(seal + std::string(SealStart).size(), SealDigits);
  if (stored != checksum(file, sizeOf(file) - (end.size() - seal)))
  {
    throw std::runtime_error("the file is damaged: it has changed since it was written");
  }
  return true;
}

namespace
{
constexpr rlim_t LongestRehearsal = 120; // seconds of CPU time

/// What the rehearsing process does: quietly, within bounds, and without coming back.
[[noreturn]] void rehearseHere(std::uint64_t fileSize, const std::function<void()>& read)
{
  for (int signalNumber : { SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGINT, SIGTERM })
  {
    signal(signalNumber, SIG_DFL);
  }
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  std::uint64_t pagesInUse = 0;
  std::ifstream("/proc/self/statm") >> pagesInUse;
  const rlim_t memory = pagesInUse * sysconf(_SC_PAGESIZE) + 16 * fileSize + (rlim_t(1) << 30);
  const rlimit bounds[] = { { memory, memory }, { LongestRehearsal, LongestRehearsal }, { 0, 0 } };
  setrlimit(RLIMIT_AS, &bounds[0]);
  setrlimit(RLIMIT_CPU, &bounds[1]);
  setrlimit(RLIMIT_CORE, &bounds[2]);
  try
  {
    read();
  }
  catch (const std::bad_alloc&)
  {
    _exit(1);
  }
  catch (...)
  {
  }
  _exit(0);
}
} // namespace

void rehearse(const std::string& path, const std::function<void()>& read)
{
  std::ifstream file(path, std::ios::binary);
  const std::uint64_t size = sizeOf(file);
  const pid_t process = fork();
  if (process == 0)
  {
    rehearseHere(size, read);
  }
  if (process < 0)
  {
    return; // no process to be had: the reading proper will do
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR)
  {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
  {
    throw std::runtime_error("the file is damaged: it cannot be read");
  }
}

namespace
{
/// A corner such as 7, -7, 7/1, 7//3 or 7/1/3.
bool isCorner(const std::string& word)
{
  const std::size_t digits = word[0] == '-' ? 1 : 0;
  return word.size() > digits && word[digits] != '/' &&
    word.find_first_not_of("0123456789/-", digits) == std::string::npos;
}
} // namespace

void requireNumbersInObj(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::string line;
  for (long number = 1; std::getline(file, line); ++number)
  {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string kind, word;
    words >> kind;
    const bool isVertex = kind == "v";
    int count = 0;
    for (; (isVertex || kind == "f") && (words >> word) && word != "\\"; ++count)
    {
      if (isVertex ? count < 3 && !palpate::isNumber(word) : !isCorner(word))
      {
        throw std::runtime_error("the file is damaged: a " +
          std::string(isVertex ? "coordinate" : "corner") + " in line " + std::to_string(number) +
          " is not a number");
      }
    }
    if (isVertex && count < 3)
    {
      throw std::runtime_error("the file is damaged: the vertex in line " + std::to_string(number) +
        " has not three coordinates");
    }
  }
}

void requireWholeStl(const std::string& path)
{
  // As vtkSTLReader decides it: binary files, too, may begin with the word "solid".
  if (vtksys::SystemTools::DetectFileType(path.c_str()) == vtksys::SystemTools::FileTypeText)
  {
    return;
  }
  std::ifstream file(path, std::ios::binary);
  char start[84] = {};
  file.read(start, sizeof start);
  std::uint32_t triangles = 0; // little-endian
  for (int i = 3; i >= 0; --i)
  {
    triangles = triangles << 8 | static_cast<unsigned char>(start[80 + i]);
  }
  const std::uint64_t size = sizeOf(file);
  const std::uint64_t needed = 84 + 50 * static_cast<std::uint64_t>(triangles);
  if (size < needed)
  {
    throw std::runtime_error("the file is cut short or not an STL file: its " +
      std::to_string(triangles) + " triangles need " + std::to_string(needed) +
      " bytes, but there are " + std::to_string(size));
  }
}
} // namespace palpate::io
