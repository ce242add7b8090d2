#pragma once

namespace vspring::cli {

/// The page with the places @TITLE@, @FIGURES@ and @SCENE@; made of page/ when the program is built.
extern const char* const page_template;

}  // namespace vspring::cli
