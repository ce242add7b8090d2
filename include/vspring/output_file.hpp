#pragma once

#include <string>
#include <string_view>

namespace vspring {

/// Writes a whole file: it appears with all of `bytes` or not at all. path: a file, or "-" for standard output.
///
/// A regular file is written beside its place and renamed, so a file that was there before stays until the new one is
/// complete; it hands on its permissions, and a symbolic link stays a link. What exists and is not a regular file (a
/// device, a pipe) is written directly. Throws Error(unusable_file) naming the path and the system's reason; no
/// temporary file is left behind. Cost: linear.
void write_file(const std::string& path, std::string_view bytes);

/// Throws as write_file() does where a file cannot be written to `path`, before anything long begins. Leaves nothing.
void check_writable(const std::string& path);

}  // namespace vspring
