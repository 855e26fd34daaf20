// The HTML page: what it holds, without a browser; what its script makes of it, in one where Chromium is installed.
#include "reports/html.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "faults/diagnose.h"
#include "judge/validate.h"
#include "reports/browser.h"
#include "reports/example_judgement.h"
#include "reports/json.h"

namespace rainref::reports {
namespace {

using namespace judge;

using capture::Array;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

/// One of the page's objects: "judgement" or "buffers".
Json part(const std::string& page, const std::string& id) {
  const std::string begin = fmt::format("<script type=\"application/json\" id=\"{}\">", id);
  const std::size_t at = page.find(begin) + begin.size();
  return Json::parse(page.substr(at, page.find("</script>", at) - at));
}
std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) ++n;
  return n;
}

/// The corrected small pack, and a port of it whose shade is upside down.
class ReportPage : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const capture::Pack pack(small_pack("puddle-corrected"));
    write_port(pack, *folder_ / "bad", [](const capture::PackCase& c, const std::string&, Array& a) {
      if (c.pass == "shade") flip_rows(a);
    });
    write_port(pack, *folder_ / "good");
    for (const std::string port : {"bad", "good"}) put(*folder_ / (port + ".html"), page(pack, *folder_ / port));
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static std::string page(const capture::Pack& pack, const std::filesystem::path& port) {
    const parallel::Executor executor;
    ValidateOptions options;
    options.executor = &executor;
    options.explain = faults::diagnose;
    PortJudgement j = validate(pack, port, options);
    j.command = "rainref validate pack --port port";
    const PageSource source = page_source(std::make_shared<const capture::Pack>(pack.folder()), port);
    const std::string text = report_html(j, 1, source);
    EXPECT_EQ(part(text, "judgement"), Json::parse(report_json(j, 1, source)));
    return text;
  }
  static TemporaryFolder* folder_;
};
TemporaryFolder* ReportPage::folder_ = nullptr;

TEST_F(ReportPage, HoldsTheJudgementAndPictures) {
  const std::string text = contents(*folder_ / "bad.html");
  EXPECT_THAT(text, HasSubstr("<title>FAIL: puddle corrected, vulkan</title>"));
  const Json judgement = part(text, "judgement"), buffers = part(text, "buffers");
  EXPECT_EQ(judgement["first_bad_pass"], "shade");
  EXPECT_EQ(judgement["command"], "rainref validate pack --port port");
  // Two failing cases of shade; a sample of each other pass: wave, hit in four channels, normal in four, picture.
  std::vector<std::size_t> views;
  for (const Json& pass : buffers["passes"]) {
    views.push_back(0);
    for (const Json& shown : pass) views.back() += shown.value("views", Json::array()).size();
  }
  EXPECT_THAT(views, testing::ElementsAre(0u, 2u, 4u + 4u, 2u, 1u));
  EXPECT_EQ(count(text, "\"data:image/png;base64,"), 4u * (2 + 4 + 4 + 2 + 1));
  const Json& shade = buffers["passes"][3][0];
  EXPECT_EQ(shade["is_left_out"], false);
  EXPECT_EQ(shade["views"][0]["label"], "colour");
  const std::vector<int> verdicts = shade["verdicts"];
  EXPECT_EQ(std::accumulate(verdicts.begin(), verdicts.end(), 0), 35 * 21);
  EXPECT_EQ(shade["views"][0]["colours"].size() % 2, 1u);  // from the lowest difference to the highest, 0 in the middle
  EXPECT_EQ(part(contents(*folder_ / "good.html"), "judgement")["status"], "PASS");
}

// Who has no scripts reads the text of the terminal.
TEST_F(ReportPage, WithoutScriptsItSaysTheVerdict) {
  const std::string text = contents(*folder_ / "bad.html"), words = text.substr(text.find("<noscript>"), text.find("</noscript>"));
  EXPECT_THAT(words, HasSubstr("FAIL shade is outside the as-written envelope of puddle.shade.corrected/2"));
  EXPECT_THAT(words, HasSubstr("(1 FAIL, 4 PASS)"));
  PortJudgement j;
  j.reason = "port: there is no such <folder>";
  EXPECT_THAT(report_html(j, 4, {}), HasSubstr("UNTESTED:  against , profile &#10;  port: there is no such &lt;folder&gt;"));
}

// The worst output of the first failing case comes before its others.
TEST_F(ReportPage, OpensOnWhatFailsWorst) {
  const TemporaryFolder folder;
  const capture::Pack pack(small_pack("puddle-corrected"));
  // Of hit one texel is off by 0.1 of 4 m in y, of normal many in z, by up to 0.29 of 2.
  write_port(pack, folder.path(), [](const capture::PackCase& c, const std::string& name, Array& a) {
    if (c.id != "puddle.surface_hit/0012.0") return;
    const float y = 0.1f;
    if (name == "hit") std::memcpy(&a.levels[0].edit()[16 * 40 + 4], &y, 4);
    if (name == "normal")
      for (std::size_t at = 4; at < a.levels[0].size(); at += 8) a.levels[0].edit()[at + 1] ^= std::byte{0x80};
  });
  const std::string text = page(pack, folder.path());
  const Json judgement = part(text, "judgement"), worst = judgement["passes"][2]["worst"], shown = part(text, "buffers")["passes"][2];
  EXPECT_EQ(worst["case"], "puddle.surface_hit/0012.0");
  EXPECT_EQ(worst["output"], "normal");
  EXPECT_EQ(worst["quantity"], "z");
  EXPECT_EQ(shown[0]["output"], "normal");
  EXPECT_EQ(shown[1]["output"], "hit");
  EXPECT_EQ(shown[1]["case"], worst["case"]);
  if (!Browser::is_installed()) return;
  put(folder / "page.html", text);
  Browser browser;
  browser.open(folder / "page.html");
  EXPECT_EQ(browser.value("[...document.querySelectorAll('main > section')].map(s => s.id).filter(id => id).slice(0, 4).join()"),
            "pass-surface_hit,dataflow,overview,pass-raindrops");
  EXPECT_THAT(browser.value("document.querySelector('.summary').textContent").get<std::string>(),
              HasSubstr("Worst in channel z of out.normal, off by up to "));
  const std::string viewer = "document.querySelector('#pass-surface_hit .viewer')";
  EXPECT_EQ(browser.value("[..." + viewer + ".querySelectorAll('.view:not([hidden])')].map(v => v.dataset.label).join()"), "z");
  EXPECT_EQ(browser.value(viewer + ".querySelectorAll('.view:not([hidden]) .mark').length"), 4);  // in each picture
}

TEST_F(ReportPage, ListsHaveRowsOfFields) {
  const TemporaryFolder folder;
  const capture::Pack pack(small_pack("windshield-corrected"));
  write_port(pack, folder.path(), [](const capture::PackCase& c, const std::string&, Array& a) {
    if (c.id == "windshield.integrate/0012.0") a.levels[0].edit()[6] ^= std::byte{0x10};  // of the first drop's position
  });
  const std::string text = page(pack, folder.path());
  const Json passes = part(text, "judgement")["passes"];
  const auto at = std::find_if(passes.begin(), passes.end(), [](const Json& p) { return p["pass"] == "integrate"; });
  ASSERT_NE(at, passes.end());
  EXPECT_EQ((*at)["worst"]["quantity"], "position.y");
  const Json shown = part(text, "buffers")["passes"][static_cast<std::size_t>(at - passes.begin())][0];
  ASSERT_FALSE(shown["rows"].empty());
  ASSERT_EQ(shown["rows"][0].size(), 7u);
  EXPECT_EQ(shown["rows"][0][1], "position.y");
  EXPECT_NE(shown["rows"][0][2], shown["rows"][0][4]);  // got and expected
}

TEST_F(ReportPage, IsOneFile) {
  for (const std::string name : {"bad.html", "good.html"}) {
    const std::string text = contents(*folder_ / name);
    EXPECT_EQ(count(text, "http:"), count(text, "\"http://www.w3.org/2000/svg\""));  // a name, which nothing loads
    EXPECT_THAT(text, Not(HasSubstr("https:")));
    EXPECT_THAT(text, Not(HasSubstr("\nimport ")));
    EXPECT_THAT(text, Not(HasSubstr("src=\"")));
  }
}

TEST_F(ReportPage, HostileNamesStayText) {
  PortJudgement j = example_judgement();
  const std::string script = "</script><script>alert(1)</script>\"'<!--", image = "<img src=x onerror=alert(1)>{{report.js}}";
  j.port = j.command = j.passes[3].pass = j.first_bad_pass = script;
  j.passes[3].causes[0].sentence = j.notes[0] = image;
  const std::string text = report_html(j, 1, {});
  EXPECT_EQ(count(text, "<script"), 3u);
  EXPECT_EQ(count(text, "</script>"), 3u);
  EXPECT_THAT(text, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(text, Not(HasSubstr("<!--")));
  const Json judgement = part(text, "judgement");
  EXPECT_EQ(judgement["port"], script);
  EXPECT_EQ(judgement["notes"][0], image);
  if (!Browser::is_installed()) return;
  put(*folder_ / "hostile.html", text);
  Browser browser;
  browser.open(*folder_ / "hostile.html");
  EXPECT_EQ(browser.value("document.querySelectorAll('section.pass')[0].id"), "pass-" + script);
  EXPECT_EQ(browser.value("document.querySelectorAll('script').length"), 3);
  EXPECT_EQ(browser.value("document.images.length"), 0);
}

class ReportPageInBrowser : public ReportPage {
 protected:
  void SetUp() override {
    if (!Browser::is_installed()) GTEST_SKIP() << "chromium is not installed: the page's behaviour is not tested";
  }
  /// Nothing was logged, thrown or fetched.
  static void expect_quiet(const Browser& browser, const std::filesystem::path& file) {
    for (const Json& e : browser.events) {
      const std::string method = e.value("method", "");
      EXPECT_TRUE(method != "Log.entryAdded" && method != "Runtime.consoleAPICalled" && method != "Runtime.exceptionThrown") << e.dump();
      if (method != "Network.requestWillBeSent") continue;
      const std::string url = e["params"]["request"]["url"];
      EXPECT_TRUE(url == "file://" + file.string() || url.starts_with("data:")) << url;
    }
  }
};

TEST_F(ReportPageInBrowser, LoadsQuietlyAndEveryPictureIsDecoded) {
  Browser browser;
  for (const std::string name : {"bad.html", "good.html"}) {
    browser.events.clear();
    browser.open(*folder_ / name);
    EXPECT_EQ(browser.value("document.querySelectorAll('svg.graph a .node').length"), 5);
    EXPECT_GT(browser.value("document.images.length"), 40);
    EXPECT_EQ(browser.value(
                  "Promise.all([...document.images].map(i => i.decode().then(() => 0, () => 1))).then(bad => bad.filter(b => b).length)"),
              0);
    EXPECT_EQ(
        browser.value("[...document.querySelectorAll('svg.graph a')].filter(a => !document.querySelector(a.getAttribute('href'))).length"),
        0);
    // Nothing is cut off on a laptop: neither the passes nor a table, and no legend runs into its neighbour.
    browser.call("Emulation.setDeviceMetricsOverride", {{"width", 1280}, {"height", 900}, {"deviceScaleFactor", 1}, {"mobile", false}});
    EXPECT_EQ(browser.value("document.documentElement.scrollWidth > innerWidth"), false);
    EXPECT_EQ(browser.value("[...document.querySelectorAll('.scroll, figcaption')].filter(e => e.scrollWidth > e.clientWidth).map(e => "
                            "e.textContent).join(' | ')"),
              "");
    EXPECT_EQ(browser.value("[...document.querySelectorAll('.node')].filter(n => n.querySelector('.state').getBBox().width > "
                            "n.querySelector('rect').getBBox().width - 8).length"),
              0);
    browser.call("Emulation.clearDeviceMetricsOverride");
    expect_quiet(browser, *folder_ / name);
  }
}

// The port lies over the reference in the first picture; zoom is about the middle and never beyond the edge.
TEST_F(ReportPageInBrowser, KeysFlickerSwapZoomMoveAndEnlarge) {
  Browser browser;
  browser.open(*folder_ / "bad.html");
  browser.value("window.viewer = document.querySelector('#pass-shade .viewer'), viewer.focus()");
  const std::string other = "getComputedStyle(viewer.querySelector('.reference .other')).visibility";
  const std::string flickers = "viewer.querySelector('.flicker').getAttribute('aria-pressed')";
  EXPECT_EQ(browser.value("viewer.querySelector('.reference .other').src === viewer.querySelector('.port img').src"), true);
  EXPECT_EQ(browser.value(other), "hidden");
  browser.press("f");
  EXPECT_EQ(browser.value(flickers), "true");
  for (const std::string state : {"hidden", "visible", "hidden"}) {
    EXPECT_EQ(browser.value("new Promise(done => { const end = Date.now() + 10000; (function look() { const v = " + other + "; v === '" +
                            state + "' || Date.now() > end ? done(v) : setTimeout(look, 10); })(); })"),
              state);
  }
  browser.press("f");
  EXPECT_EQ(browser.value(flickers), "false");
  EXPECT_EQ(browser.value(other), "hidden");
  browser.press("s");
  EXPECT_EQ(browser.value(other), "visible");

  browser.value("window.viewer = document.querySelector('#pass-surface_hit .viewer'), viewer.focus()");
  const auto zoom_and_left = [&] {
    return browser.value("['--zoom', '--px'].map(name => parseFloat(getComputedStyle(viewer).getPropertyValue(name)))");
  };
  browser.press("+");
  EXPECT_EQ(zoom_and_left(), (Json{2, -50}));
  browser.press("ArrowRight");
  EXPECT_EQ(zoom_and_left(), (Json{2, -60}));
  browser.press("-");
  EXPECT_EQ(zoom_and_left(), (Json{1, 0}));
  const std::string view = "viewer.querySelector('.view:not([hidden])')";
  browser.press("2");
  EXPECT_EQ(browser.value("[..." + view + ".querySelectorAll('.pane')].map(p => Boolean(p.offsetParent)).join()"),
            "false,true,false,false");
  browser.press("2");
  browser.press("v");
  EXPECT_EQ(browser.value(view + ".dataset.label"), "y");
  expect_quiet(browser, *folder_ / "bad.html");
}

// The middle of the mark, in texels, row 0 at the bottom.
TEST_F(ReportPageInBrowser, AWorstElementIsFound) {
  Browser browser;
  browser.open(*folder_ / "bad.html");
  browser.value("window.viewer = document.querySelector('#pass-shade .viewer'), viewer.querySelector('.place').click()");
  EXPECT_EQ(
      browser.value(
          "(() => { const [m, i] = ['.mark', 'img'].map(e => viewer.querySelector('.view:not([hidden]) ' + e).getBoundingClientRect()); "
          "return [Math.floor(35 * (m.x + m.width / 2 - i.x) / i.width), 20 - Math.floor(21 * (m.y + m.height / 2 - i.y) / i.height)]; "
          "})()"),
      browser.value("(({x, y}) => [+x, +y])(viewer.querySelector('.place').dataset)"));
  EXPECT_THAT(browser.value("viewer.querySelector('.readout').textContent").get<std::string>(), HasSubstr("accepted"));
}

TEST_F(ReportPageInBrowser, DarkAndLight) {
  Browser browser;
  browser.open(*folder_ / "bad.html");
  const auto page = [&](const std::string& scheme) {
    browser.call("Emulation.setEmulatedMedia", {{"features", {{{"name", "prefers-color-scheme"}, {"value", scheme}}}}});
    return browser.value("getComputedStyle(document.body).backgroundColor");
  };
  EXPECT_NE(page("dark"), page("light"));
}

}  // namespace
}  // namespace rainref::reports
