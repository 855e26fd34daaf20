#include "cli/view/sessions.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <new>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rainref/error.h"

namespace rainref::cli {
namespace {

void append_number(std::string& to, std::size_t number) {
  for (int shift = 0; shift < 32; shift += 8) to += static_cast<char>(number >> shift & 0xff);
}

std::string message(std::string_view json, const std::vector<std::byte>& bytes = {}) {
  if (bytes.size() > UINT32_MAX) throw Error(ExitCode::usage, "expected at most 4 GiB for the page, found more");
  std::string all;
  all.reserve(8 + json.size() + bytes.size());
  append_number(all, json.size());
  append_number(all, bytes.size());
  all += json;
  all.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return all;
}

/// As src/web/pages/c_library.js has it.
std::string error_message(int code, const std::string& text) {
  const nlohmann::ordered_json error{{"error", {{"name", "RainrefError"}, {"message", text}, {"code", code}}}};
  return message(error.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

/// {session, operation}, or two empty texts.
std::pair<std::string, std::string> parts_of(std::string_view path) {
  const std::size_t slash = path.find('/');
  if (slash == std::string_view::npos) return {};
  std::string name(path.substr(0, slash));
  const bool is_name = !name.empty() && name.size() <= 32 && name.find_first_not_of("0123456789abcdef") == std::string::npos;
  return is_name ? std::pair{std::move(name), std::string(path.substr(slash + 1))} : std::pair<std::string, std::string>();
}

}  // namespace

std::shared_ptr<Session> Sessions::session(const std::string& name) {
  std::shared_ptr<Session> given_up;  // destroyed without the lock
  const std::lock_guard lock(mutex_);
  Used& used = sessions_[name];
  if (!used.session) used.session = std::make_shared<Session>(scenes_, threads_);
  used.when = ++now_;
  std::shared_ptr<Session> found = used.session;
  if (sessions_.size() > most) {
    const auto oldest =
        std::min_element(sessions_.begin(), sessions_.end(), [](const auto& a, const auto& b) { return a.second.when < b.second.when; });
    given_up = std::move(oldest->second.session);
    sessions_.erase(oldest);
  }
  return found;
}

void Sessions::answer(std::string_view path, const Sent& sent, const Write& write) {
  std::string last;
  try {
    const auto [name, operation] = parts_of(path);
    if (name.empty()) throw Error(ExitCode::usage, "expected run/SESSION/OPERATION");
    if (operation == "close") {
      std::shared_ptr<Session> closed;
      {
        const std::lock_guard lock(mutex_);
        if (const auto node = sessions_.extract(name)) closed = node.mapped().session;
      }
      last = message(R"({"result": null, "member": ""})");
    } else {
      const Result result = session(name)->run(
          operation, sent, [&](int done, int of) { return write(message(fmt::format(R"({{"progress": [{}, {}]}})", done, of))); });
      last = message(fmt::format(R"({{"result": {}, "member": "{}"}})", result.json, result.member), result.bytes);
    }
  } catch (const Error& e) {
    last = error_message(static_cast<int>(e.code()), e.what());
  } catch (const std::bad_alloc&) {
    last = error_message(static_cast<int>(ExitCode::usage), "not enough memory");
  } catch (const std::exception& e) {
    last = error_message(static_cast<int>(ExitCode::internal), fmt::format("internal error: {}", e.what()));
  }
  write(last);
}

}  // namespace rainref::cli
