#include "tools/station/server/web_server_shell.h"

#include <libwebsockets.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <map>
#include <stdexcept>
#include <utility>

namespace sprung::station {
namespace {

constexpr std::size_t kMostTexts = 256;
constexpr std::size_t kMostBinaries = 64;
constexpr std::size_t kFileChunk = 16384;
/// A page that takes nothing and says nothing: its machine is asleep, or the cable is out.
constexpr int kTimeout_s = 20;

/// On every answer. No page of another origin may frame this one (a button under the reader's mouse) or read
/// it, none may leave with its address, and nothing is loaded from elsewhere.
constexpr std::array<std::pair<const char*, const char*>, 4> kHeaders{{
    {"x-content-type-options:", "nosniff"},
    {"referrer-policy:", "no-referrer"},
    {"cache-control:", "no-store"},
    {"cross-origin-resource-policy:", "same-origin"},
}};

std::string header_of(lws* wsi, lws_token_indexes which) {
  const int length = lws_hdr_total_length(wsi, which);
  if (length <= 0) return "";
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  if (lws_hdr_copy(wsi, text.data(), length + 1, which) < 0) return "";
  text.resize(static_cast<std::size_t>(length));
  return text;
}

/// Of one HTTP request that is being answered.
struct Download {
  std::string_view bytes;
};

/// libwebsockets' memory of a connection: zeroed, never constructed.
struct Connection {
  int page;
  Download download;
};

}  // namespace

constexpr std::size_t kMostUnread = 64;  // times the longest text are heard out, then the door is shut

struct WebServer::Impl {
  struct Page {
    lws* wsi = nullptr;
    std::deque<std::pair<lws_write_protocol, std::string>> texts;
    SharedBytes state;
    SharedBytes frame;
    std::string incoming;
    std::size_t incoming_bytes = 0;  ///< of this message, also what was not kept
    bool close = false;
  };

  Impl(const WebServerOptions& wished, WebHandlers given)
      : options(wished), handlers(std::move(given)), door(wished.token, wished.other_origins) {}

  static int callback(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t size);
  Admission judge(lws* wsi) const;
  int answer(lws* wsi, Connection* connection);
  static int send_part(lws* wsi, Connection* connection);
  int filter(lws* wsi);
  void open(lws* wsi, Connection* connection);
  int receive(lws* wsi, Connection* connection, std::string_view part);
  int write(lws* wsi, Page& page);
  int write(lws* wsi, const std::string& bytes, lws_write_protocol kind);
  void create(const char* address, lws_context_creation_info& info);
  Page* find(int page) {
    const auto found = pages.find(page);
    return found == pages.end() ? nullptr : &found->second;
  }

  WebServerOptions options;
  WebHandlers handlers;
  Doorkeeper door;
  std::vector<lws_protocols> protocols;
  lws_context* context = nullptr;
  lws_sorted_usec_list_t timer{};
  int port = 0;
  int next_page = 1;
  std::map<int, Page> pages;
  std::vector<unsigned char> buffer;
  std::int64_t frames_sent = 0, frames_replaced = 0, refused = 0;
};

std::string content_policy(const std::string& nonce) {
  return "default-src 'none'; script-src 'self' 'nonce-" + nonce +
         "'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self'; base-uri "
         "'none'; "
         "form-action 'none'; frame-ancestors 'none'";
}

Admission WebServer::Impl::judge(lws* wsi) const {
  const std::string host = header_of(wsi, WSI_TOKEN_HOST), origin = header_of(wsi, WSI_TOKEN_ORIGIN),
                    path = header_of(wsi, WSI_TOKEN_GET_URI);
  return door.judge({host, origin, path});
}

int WebServer::Impl::answer(lws* wsi, Connection* connection) {
  const Admission admission = judge(wsi);
  if (admission != Admission::kAdmitted) {
    ++refused;
    lws_return_http_status(wsi, HTTP_STATUS_FORBIDDEN, name(admission));
    return -1;
  }
  const std::string path = header_of(wsi, WSI_TOKEN_GET_URI);
  const WebFile* const file = handlers.file(door.inner_path(path));
  if (file == nullptr) {
    lws_return_http_status(wsi, HTTP_STATUS_NOT_FOUND, "there is no such file");
    return -1;
  }
  std::array<unsigned char, LWS_PRE + 2048> head{};
  unsigned char* at = head.data() + LWS_PRE;
  unsigned char* const end = head.data() + head.size();
  const std::string type(file->type);
  if (lws_add_http_common_headers(wsi, HTTP_STATUS_OK, type.c_str(), file->bytes.size(), &at, end) != 0)
    return -1;
  const auto add = [&](const char* key, const char* value) {
    const auto* name = reinterpret_cast<const unsigned char*>(key);
    const auto* text = reinterpret_cast<const unsigned char*>(value);
    return lws_add_http_header_by_name(wsi, name, text, static_cast<int>(std::strlen(value)), &at, end) == 0;
  };
  for (const auto& [key, value] : kHeaders)
    if (!add(key, value)) return -1;
  if (!add("content-security-policy:", content_policy(options.nonce).c_str())) return -1;
  if (lws_finalize_write_http_header(wsi, head.data() + LWS_PRE, &at, end) != 0) return -1;
  connection->download = {file->bytes};
  lws_callback_on_writable(wsi);
  return 0;
}

int WebServer::Impl::send_part(lws* wsi, Connection* connection) {
  std::string_view& left = connection->download.bytes;
  const std::size_t size = std::min(left.size(), kFileChunk);
  std::array<unsigned char, LWS_PRE + kFileChunk> part;
  std::memcpy(part.data() + LWS_PRE, left.data(), size);
  left.remove_prefix(size);
  const lws_write_protocol kind = left.empty() ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP;
  if (lws_write(wsi, part.data() + LWS_PRE, size, kind) < static_cast<int>(size)) return -1;
  if (left.empty()) return lws_http_transaction_completed(wsi) != 0 ? -1 : 0;
  lws_callback_on_writable(wsi);
  return 0;
}

int WebServer::Impl::filter(lws* wsi) {
  const Admission admission = judge(wsi);
  if (admission == Admission::kAdmitted) return 0;
  ++refused;
  lws_return_http_status(wsi, HTTP_STATUS_FORBIDDEN, name(admission));
  return -1;
}

void WebServer::Impl::open(lws* wsi, Connection* connection) {
  connection->page = next_page++;
  pages[connection->page].wsi = wsi;
  handlers.opened(connection->page, lws_get_protocol(wsi)->name);
}

int WebServer::Impl::receive(lws* wsi, Connection* connection, std::string_view part) {
  Page* const page = find(connection->page);
  if (page == nullptr) return -1;
  const bool whole = lws_is_final_fragment(wsi) != 0 && lws_remaining_packet_payload(wsi) == 0;
  page->incoming_bytes += part.size();
  if (page->incoming_bytes > options.longest_text) {
    // With a part of it unread the kernel would reset the connection, and the reason be lost.
    if (!whole && page->incoming_bytes < kMostUnread * options.longest_text) return 0;
    lws_close_reason(wsi, LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE, nullptr, 0);
    return -1;
  }
  page->incoming += part;
  if (!whole) return 0;
  page->incoming_bytes = 0;
  const std::string text = std::exchange(page->incoming, {});
  handlers.text(connection->page, text);
  return 0;
}

int WebServer::Impl::write(lws* wsi, const std::string& bytes, lws_write_protocol kind) {
  buffer.resize(LWS_PRE + bytes.size());
  std::memcpy(buffer.data() + LWS_PRE, bytes.data(), bytes.size());
  const int wrote = lws_write(wsi, buffer.data() + LWS_PRE, bytes.size(), kind);
  return wrote < static_cast<int>(bytes.size()) ? -1 : 0;
}

/// One message a call, as libwebsockets asks: what was asked for first.
int WebServer::Impl::write(lws* wsi, Page& page) {
  int result = 0;
  if (!page.texts.empty()) {
    const auto [kind, bytes] = std::move(page.texts.front());
    page.texts.pop_front();
    result = write(wsi, bytes, kind);
  } else if (page.close) {
    lws_close_reason(wsi, LWS_CLOSE_STATUS_POLICY_VIOLATION, nullptr, 0);
    return -1;
  } else if (page.frame) {
    ++frames_sent;
    result = write(wsi, *std::exchange(page.frame, nullptr), LWS_WRITE_BINARY);
  } else if (page.state) {
    result = write(wsi, *std::exchange(page.state, nullptr), LWS_WRITE_TEXT);
  }
  if (!page.texts.empty() || page.state || page.frame || page.close) lws_callback_on_writable(wsi);
  return result;
}

int WebServer::Impl::callback(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t size) {
  lws_vhost* const vhost = lws_get_vhost(wsi);
  auto* const self = static_cast<Impl*>(vhost == nullptr ? nullptr : lws_get_vhost_user(vhost));
  auto* const connection = static_cast<Connection*>(user);
  if (self == nullptr) return 0;
  switch (reason) {
    case LWS_CALLBACK_HTTP:
      return self->answer(wsi, connection);
    case LWS_CALLBACK_HTTP_WRITEABLE:
      return send_part(wsi, connection);
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
      return self->filter(wsi);
    case LWS_CALLBACK_ESTABLISHED:
      self->open(wsi, connection);
      return 0;
    case LWS_CALLBACK_RECEIVE:
      return self->receive(wsi, connection, {static_cast<const char*>(in), size});
    case LWS_CALLBACK_SERVER_WRITEABLE:
      if (Page* const page = self->find(connection->page)) return self->write(wsi, *page);
      return -1;
    case LWS_CALLBACK_CLOSED:
      if (self->pages.erase(connection->page) != 0) self->handlers.closed(connection->page);
      return 0;
    default:
      return 0;
  }
}

void WebServer::Impl::create(const char* address, lws_context_creation_info& info) {
  info.iface = address;
  info.port = port;
  info.vhost_name = address;
  lws_vhost* const vhost = lws_create_vhost(context, &info);
  if (vhost == nullptr)
    throw std::runtime_error("cannot listen on " + std::string(address) + " port " + std::to_string(port) +
                             ": another program has it; choose one with --port, or --port 0 for any");
  port = lws_get_vhost_listen_port(vhost);
}

WebServer::WebServer(const WebServerOptions& options, WebHandlers handlers)
    : impl_(std::make_unique<Impl>(options, std::move(handlers))) {
  lws_set_log_level(0, nullptr);
  for (const std::string& protocol : impl_->options.protocols)
    impl_->protocols.push_back({protocol.c_str(), Impl::callback, sizeof(Connection), 4096, 0, nullptr, 0});
  impl_->protocols.push_back({});
  lws_context_creation_info info{};
  info.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS;
  info.gid = -1;
  info.uid = -1;
  info.user = impl_.get();
  info.protocols = impl_->protocols.data();
  info.timeout_secs = kTimeout_s;
  info.pt_serv_buf_size = 16384;
  impl_->context = lws_create_context(&info);
  if (impl_->context == nullptr) throw std::runtime_error("libwebsockets cannot begin: out of memory?");
  impl_->port = options.port;
  info.options = LWS_SERVER_OPTION_DISABLE_IPV6;
  impl_->create("127.0.0.1", info);
  info.options = LWS_SERVER_OPTION_IPV6_V6ONLY_MODIFY | LWS_SERVER_OPTION_IPV6_V6ONLY_VALUE;
  try {
    impl_->create("::1", info);
  } catch (const std::runtime_error&) {
    // A machine without IPv6: 127.0.0.1 is what is printed.
  }
}

WebServer::~WebServer() {
  if (impl_->context != nullptr) lws_context_destroy(impl_->context);
}

int WebServer::port() const noexcept { return impl_->port; }

const std::string& WebServer::token() const noexcept { return impl_->door.token(); }

/// lws_service() waits for sockets and its own timers alone: a timer bounds it.
void WebServer::service(int milliseconds) {
  lws_sul_schedule(
      impl_->context, 0, &impl_->timer, [](lws_sorted_usec_list_t*) {}, std::int64_t{milliseconds} * 1000);
  lws_service(impl_->context, 0);
}

void WebServer::send(int page, std::string text) {
  Impl::Page* const to = impl_->find(page);
  if (to == nullptr) return;
  if (to->texts.size() >= kMostTexts) {
    to->texts.clear();
    return close(page);
  }
  to->texts.emplace_back(LWS_WRITE_TEXT, std::move(text));
  lws_callback_on_writable(to->wsi);
}

bool WebServer::send_binary(int page, std::string bytes) {
  Impl::Page* const to = impl_->find(page);
  if (to == nullptr || to->texts.size() >= kMostBinaries) return false;
  to->texts.emplace_back(LWS_WRITE_BINARY, std::move(bytes));
  lws_callback_on_writable(to->wsi);
  return true;
}

void WebServer::send_state(int page, SharedBytes text) {
  Impl::Page* const to = impl_->find(page);
  if (to == nullptr) return;
  to->state = std::move(text);
  lws_callback_on_writable(to->wsi);
}

void WebServer::send_frame(int page, SharedBytes binary) {
  Impl::Page* const to = impl_->find(page);
  if (to == nullptr) return;
  if (to->frame) ++impl_->frames_replaced;
  to->frame = std::move(binary);
  lws_callback_on_writable(to->wsi);
}

void WebServer::close(int page) {
  Impl::Page* const to = impl_->find(page);
  if (to == nullptr) return;
  to->close = true;
  lws_callback_on_writable(to->wsi);
}

std::vector<int> WebServer::pages() const {
  std::vector<int> out;
  for (const auto& [page, unused] : impl_->pages) out.push_back(page);
  return out;
}

std::int64_t WebServer::frames_sent() const noexcept { return impl_->frames_sent; }
std::int64_t WebServer::frames_replaced() const noexcept { return impl_->frames_replaced; }
std::int64_t WebServer::refused() const noexcept { return impl_->refused; }

}  // namespace sprung::station
