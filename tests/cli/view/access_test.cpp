// Who may ask the server of `rainref view`.
#include "cli/view/access.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rainref::cli {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Optional;

const std::string token = "00112233445566778899aabbccddeeff", path = "/" + token + "/live.html";
const std::string once = "ffeeddccbbaa99887766554433221100";
Access access(token, once, 8123);

TEST(ViewAccess, ThePageMay) {
  EXPECT_EQ(access.address(), "http://127.0.0.1:8123/" + token + "/");
  EXPECT_EQ(access.name_in(path), "live.html");
  for (const char* host : {"127.0.0.1:8123", "localhost:8123"}) {
    EXPECT_EQ(access.refusal({host, "", ""}, path), std::nullopt);
    EXPECT_EQ(access.refusal({host, "", "none"}, path), std::nullopt);
    EXPECT_EQ(access.refusal({host, std::string("http://") + host, "same-origin"}, path), std::nullopt);
  }
}

TEST(ViewAccess, AForeignHostMayNot) {
  for (const char* host :
       {"", "rain.example", "rain.example:8123", "127.0.0.1", "127.0.0.1:8124", "127.0.0.1:8123.rain.example", "LOCALHOST:8123"})
    EXPECT_THAT(access.refusal({host, "", ""}, path), Optional(HasSubstr("Host"))) << host;
}

TEST(ViewAccess, AForeignPageMayNot) {
  for (const char* origin : {"null", "http://rain.example", "https://127.0.0.1:8123", "http://127.0.0.1:8124", "http://127.0.0.1:8123/",
                             "http://localhost:8123"})
    EXPECT_THAT(access.refusal({"127.0.0.1:8123", origin, ""}, path), Optional(HasSubstr("Origin"))) << origin;
  for (const char* site : {"cross-site", "same-site", "x"})
    EXPECT_THAT(access.refusal({"127.0.0.1:8123", "", site}, path), Optional(HasSubstr("Sec-Fetch-Site"))) << site;
}

TEST(ViewAccess, NobodyMayWithoutTheToken) {
  std::string other = path;
  other[5] ^= 1;
  for (const std::string& wrong : {std::string(), std::string("/"), std::string("/live.html"), "/" + token, path.substr(1),
                                   "//" + token + "/live.html", "/" + token + "0/live.html", other})
    EXPECT_THAT(access.refusal({"127.0.0.1:8123", "", ""}, wrong), Optional(HasSubstr("address"))) << wrong;
}

TEST(ViewAccess, ALinkToThePageMayStandAnywhere) {
  EXPECT_EQ(access.refusal({"127.0.0.1:8123", "", "cross-site", true}, path), std::nullopt);
  EXPECT_THAT(access.refusal({"127.0.0.1:8123", "http://rain.example", "cross-site", true}, path), Optional(HasSubstr("Origin")));
}

TEST(ViewAccess, TheBrowsersAddressLeadsThereOnce) {
  Access fresh(token, once, 8123);
  const std::string first = "/" + once + "/";
  EXPECT_EQ(fresh.address_once(), "http://127.0.0.1:8123" + first);
  EXPECT_FALSE(fresh.leads_to_page(path));
  EXPECT_FALSE(fresh.leads_to_page(first + "live.html"));
  EXPECT_THAT(fresh.refusal({"127.0.0.1:8123", "", ""}, first + "live.html"), Optional(HasSubstr("address")));
  EXPECT_EQ(fresh.refusal({"127.0.0.1:8123", "", ""}, first), std::nullopt);
  EXPECT_TRUE(fresh.leads_to_page(first));
  EXPECT_FALSE(fresh.leads_to_page(first));
  EXPECT_THAT(fresh.refusal({"127.0.0.1:8123", "", ""}, first), Optional(HasSubstr("has used")));
  EXPECT_EQ(fresh.refusal({"127.0.0.1:8123", "", ""}, path), std::nullopt);
}

TEST(ViewAccess, SecretsAreNew) {
  const std::string a = Access::new_secret(), b = Access::new_secret();
  EXPECT_THAT(a, MatchesRegex("[0-9a-f]{32}"));
  EXPECT_NE(a, b);
}

}  // namespace
}  // namespace rainref::cli
