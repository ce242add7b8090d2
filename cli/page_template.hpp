#pragma once

namespace vspring::cli {

/// The page with the places @TITLE@, @FIGURES@ and @SCENE@; made of page/ when the program is built.
extern const char* const page_template;

/// The page from which a browser makes a picture, with the places @PICTURE@ and @SCENE@; see picture_page().
extern const char* const picture_template;

}  // namespace vspring::cli
