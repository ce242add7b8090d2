#pragma once

#include <string>
#include <string_view>

namespace vspring {

/// Text as XML may hold it: marks escaped, and "?" for what is neither UTF-8 nor a character of XML.
std::string xml_text(std::string_view text);

}  // namespace vspring
