#pragma once

#include <functional>
#include <memory>
#include <string>

namespace vspring::cli {

/// What the page may read and write besides itself: empty where it may not.
struct EditedFile {
  std::string input;
  std::string output;
};

/// Serves the editor's page to this machine alone, from its making to its end, in threads of its own. Only addresses
/// that begin with a random word are answered, and only where no page of another origin asks.
class EditorServer {
 public:
  /// page: the folder of the built page. port: 0 for any free one. saved: called when the output has been written.
  /// Throws Error(unusable_file) where the port is taken.
  EditorServer(const std::string& page, EditedFile file, int port, std::function<void()> saved);
  ~EditorServer();
  EditorServer(const EditorServer&) = delete;
  EditorServer& operator=(const EditorServer&) = delete;

  /// Where the page is, with the file open in it.
  [[nodiscard]] const std::string& address() const noexcept;

 private:
  class Running;
  std::unique_ptr<Running> running_;
};

}  // namespace vspring::cli
