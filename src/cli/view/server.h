// An HTTP server for one page on this machine. CMake compiles one of server_<library>.cpp; no other file knows sockets.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/view/access.h"

namespace rainref::cli {

/// A whole answer. With a `location` the browser asks there instead.
struct Reply {
  int status = 404;
  std::string type, body, location{};
};
/// A file that a page sends.
struct Upload {
  std::string name, bytes;
};
/// The body of a POST: the field `args` of its form, and its files.
struct Sent {
  std::string args;
  std::vector<Upload> files;
};
/// Sends more of an answer. Returns false if nobody reads it.
using Write = std::function<bool(std::string_view)>;

/// What is served. Several threads call at once. Paths are decoded.
struct Served {
  /// Why a request is refused, or nothing; called before its body is read.
  std::function<std::optional<std::string>(const Sender&, std::string_view path)> refusal;
  std::function<Reply(std::string_view path)> get;
  /// Answers a POST bit by bit. Must not throw.
  std::function<void(std::string_view path, const Sent&, const Write&)> post;
};

class Server {
 public:
  /// Throws Error(usage) with a sentence if this build has no server.
  static void require();

  /// Listens at 127.0.0.1, and nowhere else. port 0: any free one. Throws Error(io) if the port cannot be had.
  explicit Server(int port);
  ~Server();
  int port() const;
  /// Serves until the process ends.
  void run(Served served);

 private:
  class Listening;
  std::unique_ptr<Listening> listening_;
};

}  // namespace rainref::cli
