#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// The contents of a file that is not written yet.
struct FileBytes {
  std::string bytes;  ///< the whole file
  /// What the source carried and the bytes do not, one line each; empty when nothing is lost.
  std::vector<std::string> losses = {};
};

/// Writes a whole file: it appears with all of `bytes` or not at all. path: a file, or "-" for standard output.
///
/// A regular file is written beside its place and renamed, so an older file stays until the new one is complete. The
/// new file keeps the permissions of the old one, and a symbolic link stays a link. A device or a pipe is written
/// directly. Throws Error(unusable_file) naming the path and the system's reason; no temporary file is left behind.
/// Cost: linear.
void write_file(const std::string& path, std::string_view bytes);

/// Throws what write_file() throws if a file cannot be written to `path`; for use before long work. Leaves no file.
void check_writable(const std::string& path);

}  // namespace vspring
