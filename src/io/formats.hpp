#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/input_file.hpp"
#include "vspring/curve_file.hpp"
#include "vspring/surface_file.hpp"

namespace vspring {

/// The names of formats, as in extensions. A format is identified by its index here.
using FormatNames = std::span<const char* const>;

/// The extension with its dot; empty for a path without one and for "-".
std::string extension_of(const std::string& path);

/// The format of an extension, in any case, with or without a dot before it; nothing if no format has it.
std::optional<std::size_t> format_of_extension(std::string_view extension, FormatNames names);

/// The format to write: `asked`, else that of the extension, else `own`. Throws Error(invalid_argument) listing the
/// formats for an unknown extension.
std::size_t format_to_write(const std::string& path, std::optional<std::size_t> asked, std::optional<std::size_t> own,
                            FormatNames names);

/// The formats of an enumeration, whose values number them.
template <typename Format>
class Formats {
 public:
  constexpr explicit Formats(FormatNames names) : names_(names) {}

  [[nodiscard]] std::optional<Format> of_extension(std::string_view extension) const {
    const std::optional<std::size_t> number = format_of_extension(extension, names_);
    return number ? std::optional(static_cast<Format>(*number)) : std::nullopt;
  }
  [[nodiscard]] Format to_write(const std::string& path, std::optional<Format> asked, std::optional<Format> own) const {
    return static_cast<Format>(format_to_write(path, number_of(asked), number_of(own), names_));
  }

 private:
  static std::optional<std::size_t> number_of(std::optional<Format> format) {
    return format ? std::optional(static_cast<std::size_t>(*format)) : std::nullopt;
  }

  FormatNames names_;
};

/// The format that the content of a file shows; nothing if that is ambiguous. Reads the beginning of the file.
std::optional<SurfaceFormat> detect_format(std::string_view bytes);

/// "OBJ", "OFF", "PLY" or "STL".
const char* name_of(SurfaceFormat format);

/// The format that the content of a file shows. Throws Error(unusable_file) for a file of a surface. Cost: linear.
CurveFormat detect_curve_format(const InputFile& file);

}  // namespace vspring
