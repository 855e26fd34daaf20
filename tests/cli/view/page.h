// A `rainref view` that runs while the test goes on, and what a page asks of it.
#pragma once

#include <httplib.h>

#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/running.h"

namespace rainref::cli {

/// A message of the program: cli/view/sessions.h.
struct Message {
  nlohmann::json json;
  std::string bytes;
};
inline std::vector<Message> messages_of(const std::string& body) {
  std::vector<Message> all;
  for (std::size_t at = 0; at < body.size();) {
    std::uint32_t sizes[2];
    if (body.size() - at < sizeof sizes) break;
    std::memcpy(sizes, body.data() + at, sizeof sizes);
    at += sizeof sizes;
    all.push_back({nlohmann::json::parse(body.substr(at, sizes[0])), body.substr(at + sizes[0], sizes[1])});
    at += sizes[0] + sizes[1];
  }
  return all;
}

class ServedPage {
 public:
  ServedPage(const std::filesystem::path& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "view");
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    program_ = start_rainref(folder, std::move(arguments), ends[1]);
    ::close(ends[1]);
    for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) address_ += c;
    ::close(ends[0]);
    const std::size_t host = address_.find("//") + 2, slash = address_.find('/', host);
    host_ = address_.substr(host, slash - host);
    root_ = address_.substr(slash, address_.find('/', slash + 1) + 1 - slash);
    client_.emplace("http://" + host_);
    client_->set_read_timeout(120);
    client_->set_url_encode(false);
  }

  const std::string& address() const { return address_; }
  const std::string& host() const { return host_; }
  /// "/TOKEN/"
  const std::string& root() const { return root_; }
  ChildProcess& program() { return *program_; }
  httplib::Client& client() { return *client_; }

  httplib::Result get(const std::string& name, const httplib::Headers& headers = {}) { return client_->Get(root_ + name, headers); }
  std::vector<Message> run(const std::string& operation, const nlohmann::json& args, const std::string& session = "1",
                           const httplib::MultipartFormDataItems& files = {}) {
    httplib::MultipartFormDataItems form{{"args", args.dump(), "", ""}};
    form.insert(form.end(), files.begin(), files.end());
    const httplib::Result result = client_->Post(root_ + "run/" + session + "/" + operation, form);
    if (!result || result->status != 200) throw std::runtime_error("no answer");
    return messages_of(result->body);
  }
  /// The only message of an operation that succeeds.
  Message good(const std::string& operation, const nlohmann::json& args, const std::string& session = "1") {
    std::vector<Message> all = run(operation, args, session);
    EXPECT_EQ(all.size(), 1u);
    EXPECT_TRUE(all.at(0).json.contains("result")) << all.at(0).json;
    return all.at(0);
  }

 private:
  std::unique_ptr<ChildProcess> program_;
  std::string address_, host_, root_;
  std::optional<httplib::Client> client_;
};

}  // namespace rainref::cli
