#include "cli/view/access.h"

#include <cerrno>
#include <cstdint>

#include <fmt/format.h>

#include "base/system.h"

namespace rainref::cli {

std::string Access::new_secret() {
  std::string secret;
  for (int half = 0; half < 2; ++half) {
    std::uint64_t bits = 0;
    if (system::random_bits(bits) != 0) throw_system_error(errno);
    secret += fmt::format("{:016x}", bits);
  }
  return secret;
}

std::string Access::address() const { return fmt::format("http://127.0.0.1:{}/{}/", port_, token_); }
std::string Access::address_once() const { return fmt::format("http://127.0.0.1:{}/{}/", port_, once_); }

bool Access::has(std::string_view path, const std::string& name) {
  const std::string expected = "/" + name + "/";
  unsigned differing = path.size() < expected.size();
  for (std::size_t i = 0; i < expected.size(); ++i)
    differing |= static_cast<unsigned char>(expected[i] ^ (i < path.size() ? path[i] : '\0'));
  return differing == 0;
}

std::optional<std::string> Access::refusal(const Sender& sender, std::string_view path) const {
  const std::string here = fmt::format("127.0.0.1:{}", port_), named = fmt::format("localhost:{}", port_);
  if (sender.host != here && sender.host != named) return fmt::format("Host: expected {}, found another host", here);
  if (!sender.origin.empty() && sender.origin != "http://" + sender.host)
    return "Origin: expected the page that rainref serves, found another";
  // A link to the page may stand anywhere.
  if (!sender.site.empty() && sender.site != "same-origin" && sender.site != "none" && !sender.is_visit)
    return "Sec-Fetch-Site: expected the page that rainref serves, found another";
  const bool is_page = has(path, token_), is_once = is_the_one(path);
  if (is_once && is_used_) return "expected the address that rainref view printed, found the one that its browser has used";
  if (!is_page && !is_once) return "expected the address that rainref view printed";
  return std::nullopt;
}

}  // namespace rainref::cli
