// The scenes of all pages that are open, and their messages.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "cli/view/session.h"

namespace rainref::cli {

/// A page chooses a name for its session, and another one to leave an operation that takes long. Beyond `most` sessions the one that was
/// used least recently is given up; an operation that runs in it goes on to its end.
class Sessions {
 public:
  static constexpr std::size_t most = 4;

  Sessions(const SceneList& scenes, int threads) : scenes_(scenes), threads_(threads) {}

  /// Answers the POST of "SESSION/OPERATION". The answer is a sequence of messages, each of two numbers of 32 bits, little endian, that
  /// many bytes of JSON, and that many more bytes. Each but the last is {"progress": [done, of]}. The last is {"result": value, "member":
  /// name of the bytes}, or {"error": {name, message, code}}. `close` ends a session. Does not throw.
  void answer(std::string_view path, const Sent& sent, const Write& write);

 private:
  std::shared_ptr<Session> session(const std::string& name);

  struct Used {
    std::shared_ptr<Session> session;
    std::uint64_t when = 0;
  };
  const SceneList& scenes_;
  int threads_;
  std::mutex mutex_;
  std::map<std::string, Used> sessions_;
  std::uint64_t now_ = 0;
};

}  // namespace rainref::cli
