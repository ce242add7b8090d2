#pragma once

#include <httplib.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <functional>
#include <string>

namespace vspring::cli {

/// Limits of one request. They are tight until its head has been checked.
struct RequestLimits {
  std::chrono::milliseconds head_time{2000};  ///< for the whole head
  std::chrono::milliseconds whole_time{60000};
  std::size_t head_bytes = 64 << 10;
  std::size_t body_bytes = 1 << 30;
};

/// A connection that ends when its request exceeds a limit, or when the server ends.
class GuardedConnection : public httplib::Stream {
 public:
  GuardedConnection(socket_t socket, const RequestLimits& limits, const std::atomic<bool>& ending)
      : socket_(socket),
        ending_(&ending),
        whole_end_(Clock::now() + limits.whole_time),
        end_(Clock::now() + limits.head_time),
        bytes_left_(limits.head_bytes),
        body_bytes_(limits.body_bytes) {}

  /// Call it when the head is complete: the body may follow.
  void head_has_come() {
    end_ = whole_end_;
    bytes_left_ = body_bytes_;
  }

  /// Reads and drops remaining input: otherwise closing the connection may lose the answer.
  void drain() {
    ::shutdown(socket_, SHUT_WR);
    end_ = Clock::now() + std::chrono::milliseconds(500);
    for (bytes_left_ = 1 << 20; fill() > 0;) filled_ = taken_;
  }

  [[nodiscard]] bool is_readable() const override { return taken_ < filled_ || waits_for(POLLIN); }
  [[nodiscard]] bool is_writable() const override { return waits_for(POLLOUT); }
  [[nodiscard]] socket_t socket() const override { return socket_; }

  ssize_t read(char* bytes, std::size_t size) override {
    if (taken_ == filled_ && fill() <= 0) return -1;
    const std::size_t count = std::min(size, filled_ - taken_);
    std::memcpy(bytes, buffer_.data() + taken_, count);
    taken_ += count;
    return static_cast<ssize_t>(count);
  }

  ssize_t write(const char* bytes, std::size_t size) override {
    for (;;) {
      if (!waits_for(POLLOUT)) return -1;
      const ssize_t count = ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count >= 0 || (errno != EAGAIN && errno != EINTR)) return count;
    }
  }

  // Not used: permission depends on the head only.
  void get_remote_ip_and_port(std::string& /*address*/, int& /*port*/) const override {}
  void get_local_ip_and_port(std::string& /*address*/, int& /*port*/) const override {}

 private:
  using Clock = std::chrono::steady_clock;

  /// Waits for the event; false if it does not come in time.
  [[nodiscard]] bool waits_for(short event) const {
    constexpr std::chrono::milliseconds slice(100);
    for (;;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end_ - Clock::now());
      if (*ending_ || left.count() <= 0) return false;
      pollfd waiting{socket_, event, 0};
      const int found = ::poll(&waiting, 1, static_cast<int>(std::min(left, slice).count()));
      if (found > 0) return true;
      if (found < 0 && errno != EINTR) return false;
    }
  }

  /// The number of bytes that can be read; none if too many have come.
  ssize_t fill() {
    if (bytes_left_ == 0 || !waits_for(POLLIN)) return -1;
    const ssize_t count = ::recv(socket_, buffer_.data(), std::min(buffer_.size(), bytes_left_), 0);
    taken_ = 0;
    filled_ = count > 0 ? static_cast<std::size_t>(count) : 0;
    bytes_left_ -= filled_;
    return count;
  }

  socket_t socket_;
  const std::atomic<bool>* ending_;
  Clock::time_point whole_end_;
  Clock::time_point end_;
  std::size_t bytes_left_;
  std::size_t body_bytes_;
  std::array<char, 16384> buffer_{};
  std::size_t taken_ = 0;
  std::size_t filled_ = 0;
};

/// Answers one request per connection, within limits: the library's own server accepts a head of any length and waits
/// for each byte of it anew.
class GuardedServer : public httplib::Server {
 public:
  explicit GuardedServer(const RequestLimits& limits) : limits_(limits) {
    // Enough threads that some may wait for heads that never come while others answer.
    new_task_queue = [] { return new httplib::ThreadPool(32); };
    set_payload_max_length(limits.body_bytes);
  }

  /// Ends soon, even with open connections.
  void end() {
    ending_ = true;
    stop();
  }

 private:
  bool process_and_close_socket(socket_t socket) override {
    GuardedConnection connection(socket, limits_, ending_);
    bool is_closed = false;
    const bool answered = process_request(connection, true, is_closed,
                                          [&](httplib::Request& /*request*/) { connection.head_has_come(); });
    connection.drain();
    ::close(socket);
    return answered;
  }

  RequestLimits limits_;
  std::atomic<bool> ending_ = false;
};

}  // namespace vspring::cli
