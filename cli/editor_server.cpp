#include "editor_server.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <random>
#include <thread>
#include <utility>

#include "guarded_server.hpp"
#include "vspring/error.hpp"
#include "vspring/input_file.hpp"
#include "vspring/output_file.hpp"

namespace vspring::cli {

namespace {

constexpr const char* loopback = "127.0.0.1";

/// 128 random bits, which cannot be guessed.
std::string random_word() {
  std::random_device source;
  std::string word;
  for (int k = 0; k < 4; ++k) word += fmt::format("{:08x}", source());
  return word;
}

/// Percent-encodes a part of an address.
std::string encoded(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                       c == '.' || c == '_' || c == '~';
    result += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return result;
}

std::string name_of(const std::string& path) { return std::filesystem::path(path).filename().string(); }

void answer(httplib::Response& response, int status, const std::string& text) {
  response.status = status;
  response.set_content(text, "text/plain; charset=utf-8");
}

}  // namespace

class EditorServer::Running {
 public:
  Running(const std::string& page, EditedFile file, int port, std::function<void()> saved)
      : file_(std::move(file)), saved_(std::move(saved)) {
    // Browsers allow the page and its worker to share memory only if no other origin takes part.
    server_.set_default_headers({{"Cross-Origin-Opener-Policy", "same-origin"},
                                 {"Cross-Origin-Embedder-Policy", "require-corp"},
                                 {"Cross-Origin-Resource-Policy", "same-origin"},
                                 {"Referrer-Policy", "same-origin"},
                                 {"X-Content-Type-Options", "nosniff"},
                                 {"X-Frame-Options", "DENY"},
                                 {"Cache-Control", "no-store"}});
    server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      if (!permitted(request)) {
        answer(response, 403, "Not from here: open the address that vspring edit has printed.\n");
      } else if (request.has_header("Content-Encoding")) {
        // Compressed requests are refused: a small one may unpack to a large one.
        answer(response, 415, "Send the bytes of the file as they are.\n");
      } else {
        return httplib::Server::HandlerResponse::Unhandled;
      }
      return httplib::Server::HandlerResponse::Handled;
    });
    server_.Get(".*",
                [this](const httplib::Request& request, httplib::Response& response) { read(request, response); });
    server_.Put(".*",
                [this](const httplib::Request& request, httplib::Response& response) { write(request, response); });
    if (!server_.set_mount_point(root_, page))
      throw Error(ErrorCode::unusable_file, fmt::format("{}: not a folder", page));
    // A port of another program counts as taken, even if that program would share it.
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    port_ = port == 0 ? server_.bind_to_any_port(loopback) : server_.bind_to_port(loopback, port) ? port : -1;
    if (port_ < 0)
      throw Error(
          ErrorCode::unusable_file,
          fmt::format("{}:{}: the port cannot be used, perhaps another program uses it; choose another by --port, or "
                      "leave it out",
                      loopback, port));
    address_ = fmt::format("http://{}:{}{}/", loopback, port_, root_);
    if (!file_.input.empty()) {
      input_ = "/shape/" + name_of(file_.input);
      output_ = "/shape/" + name_of(file_.output);
      address_ += fmt::format("?file={}&save={}", encoded("shape/" + encoded(name_of(file_.input))),
                              encoded("shape/" + encoded(name_of(file_.output))));
    }
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    // stop() before the thread listens would have no effect.
    while (!server_.is_running()) std::this_thread::yield();
  }
  ~Running() {
    server_.end();
    thread_.join();
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  [[nodiscard]] const std::string& address() const noexcept { return address_; }

 private:
  /// Whether the address has the word, and the request comes from no page of another origin or of a name rebound to
  /// this machine.
  [[nodiscard]] bool permitted(const httplib::Request& request) const {
    const std::string here = fmt::format("{}:{}", loopback, port_);
    const std::string origin = request.get_header_value("Origin");
    return request.get_header_value("Host") == here && (origin.empty() || origin == "http://" + here) &&
           request.path.starts_with(root_ + "/");
  }

  void read(const httplib::Request& request, httplib::Response& response) const {
    if (input_.empty() || request.path != root_ + input_) return answer(response, 404, "There is no such file.\n");
    try {
      response.set_content(read_file(file_.input), "application/octet-stream");
    } catch (const Error& error) {
      return answer(response, 500, error.what());
    }
  }

  void write(const httplib::Request& request, httplib::Response& response) const {
    if (output_.empty() || request.path != root_ + output_) return answer(response, 404, "There is no such file.\n");
    if (request.body.empty()) return answer(response, 400, "There is nothing to save.\n");
    try {
      write_file(file_.output, request.body);
    } catch (const Error& error) {
      return answer(response, 500, error.what());
    }
    saved_();
    response.status = 204;
  }

  EditedFile file_;
  std::function<void()> saved_;
  std::string root_ = fmt::format("/{}", random_word());
  std::string input_;
  std::string output_;
  std::string address_;
  int port_ = -1;
  GuardedServer server_{RequestLimits{}};
  std::thread thread_;
};

EditorServer::EditorServer(const std::string& page, EditedFile file, int port, std::function<void()> saved)
    : running_(std::make_unique<Running>(page, std::move(file), port, std::move(saved))) {}

EditorServer::~EditorServer() = default;

const std::string& EditorServer::address() const noexcept { return running_->address(); }

}  // namespace vspring::cli
