#pragma once

#include <functional>
#include <memory>
#include <string>

namespace vspring::cli {

/// The files that the page may read and write; empty: none.
struct EditedFile {
  std::string input;
  std::string output;
};

/// Serves the editor's page to this machine only, as long as it lives, in threads of its own. It answers only addresses
/// that begin with a random word, and no pages of another origin.
class EditorServer {
 public:
  /// page: the folder of the built page. port: 0: any free one. saved: called when the output has been written. Throws
  /// Error(unusable_file) if the port is taken.
  EditorServer(const std::string& page, EditedFile file, int port, std::function<void()> saved);
  ~EditorServer();
  EditorServer(const EditorServer&) = delete;
  EditorServer& operator=(const EditorServer&) = delete;

  /// The address of the page with the file opened.
  [[nodiscard]] const std::string& address() const noexcept;

 private:
  class Running;
  std::unique_ptr<Running> running_;
};

}  // namespace vspring::cli
