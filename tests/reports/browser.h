// A headless Chromium, driven over a pair of pipes (the DevTools protocol: JSON messages, each ended by a zero byte).
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/temporary_folder.h"

namespace rainref {

class Browser {
 public:
  using Json = nlohmann::json;

  static bool is_installed() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

  /// An empty tab whose console, network and exceptions are recorded. `more`: options besides the usual ones; with some,
  /// the graphics adapter is not turned off. Throws when the browser does not answer.
  explicit Browser(const std::vector<std::string>& more = {}) {
    int to[2], from[2];
    if (::pipe(to) != 0 || ::pipe(from) != 0) throw std::runtime_error("no pipe");
    const std::string profile = "--user-data-dir=" + folder_.path().string();
    child_ = ::fork();
    if (child_ == 0) {
      ::setpgid(0, 0);
      // The browser reads descriptor 3 and writes 4; what lies there first goes out of the way.
      const int in = ::fcntl(to[0], F_DUPFD, 10), out = ::fcntl(from[1], F_DUPFD, 10);
      ::dup2(in, 3);
      ::dup2(out, 4);
      const int nothing = ::open("/dev/null", O_RDWR);
      ::dup2(nothing, 1);
      ::dup2(nothing, 2);
      for (int d = 5; d < 64; ++d) ::close(d);
      // A sandbox needs rights that root in a container has not.
      std::vector<std::string> options{"chromium",
                                       "--headless",
                                       "--no-first-run",
                                       "--remote-debugging-pipe",
                                       profile,
                                       "--window-size=1400,1000",
                                       ::geteuid() == 0 ? "--no-sandbox" : "--disable-extensions"};
      if (more.empty()) options.push_back("--disable-gpu");
      options.insert(options.end(), more.begin(), more.end());
      std::vector<char*> arguments;
      for (std::string& option : options) arguments.push_back(option.data());
      arguments.push_back(nullptr);
      ::execvp("chromium", arguments.data());
      ::_exit(127);
    }
    ::close(to[0]);
    ::close(from[1]);
    write_ = to[1];
    read_ = from[0];
    const std::string target = call("Target.createTarget", {{"url", "about:blank"}})["targetId"];
    session_ = call("Target.attachToTarget", {{"targetId", target}, {"flatten", true}})["sessionId"];
    for (const char* domain : {"Page", "Runtime", "Log", "Network"}) call(std::string(domain) + ".enable");
  }
  ~Browser() {
    ::close(write_);
    ::close(read_);
    ::kill(-child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void open(const std::filesystem::path& file) {
    call("Page.navigate", {{"url", "file://" + file.string()}});
    while (!any("Page.loadEventFired")) events.push_back(message());
  }
  /// The value of an expression.
  Json value(const std::string& expression) {
    const Json result = call("Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
    if (result.contains("exceptionDetails")) throw std::runtime_error(result.dump());
    return result["result"].value("value", Json());
  }
  /// A key goes down and up.
  void press(const std::string& key) {
    Json down{{"type", "keyDown"}, {"key", key}};
    if (key.size() == 1) down["text"] = key;
    call("Input.dispatchKeyEvent", down);
    call("Input.dispatchKeyEvent", {{"type", "keyUp"}, {"key", key}});
  }
  Json call(const std::string& method, const Json& parameters = Json::object()) {
    Json request{{"id", ++last_id_}, {"method", method}, {"params", parameters}};
    if (!session_.empty()) request["sessionId"] = session_;
    const std::string text = request.dump() + '\0';
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t n = ::write(write_, text.data() + at, text.size() - at);
      if (n <= 0) throw std::runtime_error("the browser is gone");
      at += static_cast<std::size_t>(n);
    }
    for (;;) {
      Json answer = message();
      if (answer.value("id", 0) != last_id_) {
        events.push_back(std::move(answer));
        continue;
      }
      if (answer.contains("error")) throw std::runtime_error(method + ": " + answer["error"].dump());
      return answer["result"];
    }
  }
  bool any(const std::string& method) const {
    for (const Json& e : events)
      if (e.value("method", "") == method) return true;
    return false;
  }

  std::vector<Json> events;

 private:
  Json message() {
    for (;;) {
      if (const std::size_t end = pending_.find('\0'); end != std::string::npos) {
        Json out = Json::parse(pending_.substr(0, end));
        pending_.erase(0, end + 1);
        return out;
      }
      pollfd waiting{read_, POLLIN, 0};
      char buffer[65536];
      const ssize_t n = ::poll(&waiting, 1, 120'000) > 0 ? ::read(read_, buffer, sizeof buffer) : -1;
      if (n <= 0) throw std::runtime_error("the browser does not answer");
      pending_.append(buffer, static_cast<std::size_t>(n));
    }
  }

  TemporaryFolder folder_;
  pid_t child_ = -1;
  int write_ = -1, read_ = -1, last_id_ = 0;
  std::string session_, pending_;
};

}  // namespace rainref
