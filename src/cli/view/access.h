// Who may ask the server of `rainref view`: the page that it serves, and nobody else.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rainref::cli {

/// What a request says of its sender; "" if it does not say so. Browsers let no page change these headers.
struct Sender {
  std::string host, origin, site;  ///< Host, Origin, Sec-Fetch-Site
};

/// A server on this machine's own address. Its pages lie below a secret name (`token`), which the printed address holds.
class Access {
 public:
  /// `token`: letters and digits.
  Access(std::string token, int port) : token_(std::move(token)), port_(port) {}

  /// A new token of 128 random bits. Throws std::system_error.
  static std::string new_token();

  /// "http://127.0.0.1:PORT/TOKEN/"
  std::string address() const;
  /// Why this request is refused, or nothing. A foreign host is refused because its name may lead to this machine (DNS rebinding); a
  /// foreign origin or site because it is another page.
  std::optional<std::string> refusal(const Sender& sender, std::string_view path) const;
  /// What follows "/TOKEN/" in an accepted path.
  std::string_view name_in(std::string_view path) const { return path.substr(token_.size() + 2); }

 private:
  std::string token_;
  int port_;
};

}  // namespace rainref::cli
