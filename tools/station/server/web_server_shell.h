#pragma once
/// HTTP and WebSocket on this machine's own addresses, by libwebsockets: files from memory, and pages that
/// speak texts and hear texts and frames. One thread. Who is slow misses frames and states, never makes a
/// queue grow.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tools/station/server/admission.h"
#include "tools/station/server/page_files.h"

namespace sprung::station {

struct WebServerOptions {
  int port = 0;                            ///< 0: any that is free
  std::string token;                       ///< of Doorkeeper
  std::vector<std::string> protocols;      ///< WebSocket's subprotocols; the first is for who names none
  std::vector<std::string> other_origins;  ///< likewise
  std::size_t longest_text = 4096;         ///< of a page; a longer one ends its connection
  std::string nonce;                       ///< of scripts that stand in a page itself
};

/// What a server asks of whoever uses it, from within service(). None may throw.
struct WebHandlers {
  std::function<const WebFile*(std::string_view path)> file;  ///< nullptr: there is none
  std::function<void(int page, std::string_view protocol)> opened;
  std::function<void(int page)> closed;
  std::function<void(int page, std::string_view text)> text;
};

/// Bytes that several pages are sent.
using SharedBytes = std::shared_ptr<const std::string>;

class WebServer {
 public:
  /// Listens. @throws std::runtime_error when it cannot, with what to do.
  WebServer(const WebServerOptions& options, WebHandlers handlers);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  int port() const noexcept;
  const std::string& token() const noexcept;
  /// Handles what comes, for at most that long.
  void service(int milliseconds);

  /// In order, and none is lost; a page that does not take 256 of them is closed.
  void send(int page, std::string text);
  /// In order; a page that has not taken 64 of them yet does without. @return whether it gets this one.
  bool send_binary(int page, std::string bytes);
  /// The newest alone counts: one that has not gone yet is replaced.
  void send_state(int page, SharedBytes text);
  void send_frame(int page, SharedBytes binary);
  void close(int page);  ///< once it has taken its texts
  std::vector<int> pages() const;

  std::int64_t frames_sent() const noexcept;
  std::int64_t frames_replaced() const noexcept;  ///< of slow pages
  std::int64_t refused() const noexcept;          ///< requests, by the doorkeeper

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sprung::station
