#pragma once

namespace CLI {
class App;
}

namespace vspring::cli {

struct PictureArguments;

/// --picture and --picture-size, and with `surfaces` --picture-style and --view. `arguments` must outlive the command.
void add_picture_options(CLI::App& command, PictureArguments& arguments, bool surfaces);

}  // namespace vspring::cli
