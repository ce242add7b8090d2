#pragma once

#include <string>

namespace vspring::cli {

// What messages call a file.
[[nodiscard]] inline std::string input_name(const std::string& path) { return path == "-" ? "standard input" : path; }
[[nodiscard]] inline std::string output_name(const std::string& path) { return path == "-" ? "standard output" : path; }

}  // namespace vspring::cli
