#include "cli/view/access.h"

#include <cerrno>
#include <cstdint>

#include <fmt/format.h>

#include "base/system.h"

namespace rainref::cli {

std::string Access::new_token() {
  std::string token;
  for (int half = 0; half < 2; ++half) {
    std::uint64_t bits = 0;
    if (system::random_bits(bits) != 0) throw_system_error(errno);
    token += fmt::format("{:016x}", bits);
  }
  return token;
}

std::string Access::address() const { return fmt::format("http://127.0.0.1:{}/{}/", port_, token_); }

std::optional<std::string> Access::refusal(const Sender& sender, std::string_view path) const {
  const std::string here = fmt::format("127.0.0.1:{}", port_), named = fmt::format("localhost:{}", port_);
  if (sender.host != here && sender.host != named) return fmt::format("Host: expected {}, found another host", here);
  if (!sender.origin.empty() && sender.origin != "http://" + sender.host)
    return "Origin: expected the page that rainref serves, found another";
  if (!sender.site.empty() && sender.site != "same-origin" && sender.site != "none")
    return "Sec-Fetch-Site: expected the page that rainref serves, found another";
  // Every character is compared, so the time does not tell how many are right.
  const std::string expected = "/" + token_ + "/";
  unsigned char differing = path.size() < expected.size();
  for (std::size_t i = 0; i < expected.size(); ++i)
    differing |= static_cast<unsigned char>(expected[i] ^ (i < path.size() ? path[i] : '\0'));
  if (differing != 0) return "expected the address that rainref view printed";
  return std::nullopt;
}

}  // namespace rainref::cli
