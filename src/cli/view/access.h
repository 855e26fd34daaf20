// Who may ask the server of `rainref view`: the page that it serves, and nobody else.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <string_view>

namespace rainref::cli {

/// What a request says of its sender; "" if it does not say so. Browsers let no page change these headers.
struct Sender {
  std::string host, origin, site;  ///< Host, Origin, Sec-Fetch-Site
  bool is_visit = false;           ///< a browser shows the answer as a page of its own (Sec-Fetch-Dest: document)
};

/// A server on this machine's own address. Its pages lie below a secret name, `token`, which the printed address holds. Another secret
/// name, `once`, leads there a single time: it is for the command line of a browser, which other users of the machine may see.
class Access {
 public:
  /// `token`, `once`: letters and digits, of one length.
  Access(std::string token, std::string once, int port) : token_(std::move(token)), once_(std::move(once)), port_(port) {}

  /// 128 random bits in 32 digits. Throws std::system_error.
  static std::string new_secret();

  /// "http://127.0.0.1:PORT/TOKEN/"
  std::string address() const;
  /// "http://127.0.0.1:PORT/ONCE/"
  std::string address_once() const;
  /// Why this request is refused, or nothing. A foreign host is refused because its name may lead to this machine (DNS rebinding); a
  /// foreign origin or site because it is another page.
  std::optional<std::string> refusal(const Sender& sender, std::string_view path) const;
  /// True for the first accepted request of address_once().
  bool leads_to_page(std::string_view path) { return is_the_one(path) && !is_used_.exchange(true); }
  /// What follows "/TOKEN/" in an accepted path.
  std::string_view name_in(std::string_view path) const { return path.substr(token_.size() + 2); }

 private:
  /// Whether a path begins with this name. The time that this takes does not tell how many characters are right.
  static bool has(std::string_view path, const std::string& name);
  bool is_the_one(std::string_view path) const { return path.size() == once_.size() + 2 && has(path, once_); }

  std::string token_, once_;
  int port_;
  std::atomic<bool> is_used_ = false;
};

}  // namespace rainref::cli
