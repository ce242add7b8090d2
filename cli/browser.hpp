#pragma once

#include <optional>
#include <string>

#include "vspring/context.hpp"

namespace vspring::cli {

/// The browser that draws pictures: the first of chromium-headless-shell, chromium, chromium-browser and google-chrome
/// in PATH. Empty if there is none.
[[nodiscard]] std::optional<std::string> find_browser();

/// The markup of a page after it has loaded and run its scripts. The browser has no window, needs no display or
/// graphics card, and writes into a folder of its own that is removed afterwards. Throws Error(unusable_file) naming
/// the browser if it cannot be started or does not end. When cancelled, the browser is ended and the result is useless.
[[nodiscard]] std::string loaded_document(const std::string& browser, const std::string& page, const Context& context);

/// Asks the desktop to open an address. False if it has no program for that.
[[nodiscard]] bool open_in_browser(std::string address);

}  // namespace vspring::cli
