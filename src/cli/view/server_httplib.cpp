#include <httplib.h>

#include <cstdint>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "cli/view/own_port.h"
#include "cli/view/server.h"
#include "rainref/error.h"

namespace rainref::cli {
namespace {

// A browser holds up to six connections, and each holds a thread while it is idle.
constexpr std::size_t server_threads = 16, most_bytes = std::size_t{512} << 20;

Sender sender_of(const httplib::Request& request) {
  return {request.get_header_value("Host"), request.get_header_value("Origin"), request.get_header_value("Sec-Fetch-Site"),
          request.get_header_value("Sec-Fetch-Dest") == "document"};
}

/// By value, because the answer is written after the request is gone.
Sent sent_by(const httplib::Request& request) {
  Sent sent;
  for (const auto& [name, part] : request.files) {
    if (name == "args")
      sent.args = part.content;
    else
      sent.files.push_back({part.filename, part.content});
  }
  return sent;
}

}  // namespace

class Server::Listening {
 public:
  explicit Listening(int port) {
    server_.new_task_queue = [] { return new httplib::ThreadPool(server_threads); };
    server_.set_keep_alive_max_count(1u << 30);
    server_.set_payload_max_length(most_bytes);
    server_.set_tcp_nodelay(true);
    // Not the library's SO_REUSEPORT, with which other programs of this user could share the port.
    server_.set_socket_options([](auto socket) { own_port(static_cast<std::uintptr_t>(socket)); });
    server_.set_default_headers({{"Cache-Control", "no-store"},
                                 {"Content-Security-Policy", "frame-ancestors 'none'"},
                                 {"Cross-Origin-Resource-Policy", "same-origin"},
                                 {"Referrer-Policy", "no-referrer"},
                                 {"X-Content-Type-Options", "nosniff"}});
    constexpr const char* here = "127.0.0.1";
    port_ = port != 0 ? (server_.bind_to_port(here, port) ? port : -1) : server_.bind_to_any_port(here);
    if (port_ <= 0)
      throw Error(ExitCode::io, port != 0 ? fmt::format("--port {}: expected a free port that this user may have", port)
                                          : fmt::format("view: no port of {} can be had", here));
  }

  int port() const { return port_; }

  void run(Served served) {
    server_.set_pre_routing_handler([&](const httplib::Request& request, httplib::Response& response) {
      const bool reads = request.method == "GET" || request.method == "HEAD";
      if (const auto why = served.refusal(sender_of(request), request.path)) {
        answer(response, {403, "text/plain", *why + "\n"});
      } else if (reads) {
        answer(response, served.get(request.path));
      } else if (request.method == "POST") {
        return httplib::Server::HandlerResponse::Unhandled;  // its body is read first
      } else {
        answer(response, {405, "text/plain", "expected GET or POST\n"});
      }
      return httplib::Server::HandlerResponse::Handled;
    });
    server_.Post("/.*", [&](const httplib::Request& request, httplib::Response& response) {
      const auto sent = std::make_shared<Sent>(sent_by(request));
      response.set_chunked_content_provider("application/octet-stream", [&served, sent, path = request.path](std::size_t,
                                                                                                             httplib::DataSink& sink) {
        served.post(path, *sent, [&sink](std::string_view bytes) { return sink.is_writable() && sink.write(bytes.data(), bytes.size()); });
        sink.done();
        return true;
      });
    });
    server_.listen_after_bind();
  }

 private:
  static void answer(httplib::Response& response, const Reply& reply) {
    response.status = reply.status;
    response.set_content(reply.body, reply.type);
    if (!reply.location.empty()) response.set_header("Location", reply.location);
  }

  httplib::Server server_;
  int port_ = -1;
};

void Server::require() {}
Server::Server(int port) : listening_(std::make_unique<Listening>(port)) {}
Server::~Server() = default;
int Server::port() const { return listening_->port(); }
void Server::run(Served served) { listening_->run(std::move(served)); }

}  // namespace rainref::cli
