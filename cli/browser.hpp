#pragma once

#include <optional>
#include <string>

#include "vspring/context.hpp"

namespace vspring::cli {

/// The browser that draws pictures: the first of chromium-headless-shell, chromium, chromium-browser and google-chrome
/// that PATH has. Empty where there is none.
[[nodiscard]] std::optional<std::string> find_browser();

/// What the document of a page is once it has loaded, scripts run, as markup. The browser has no window, needs no
/// display, draws without a graphics card, and keeps what it writes in a folder of its own that is gone afterwards.
/// Throws Error(unusable_file) naming the browser where it does not come to an end of its own or cannot be started.
/// When cancelled, the browser is ended and what is returned is of no use.
[[nodiscard]] std::string loaded_document(const std::string& browser, const std::string& page, const Context& context);

/// Has the desktop open an address. False where it has no program for that.
[[nodiscard]] bool open_in_browser(std::string address);

}  // namespace vspring::cli
