// The HTML page: its text without a browser, its behaviour in one where Chromium is installed.
#include "reports/html.h"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "faults/diagnose.h"
#include "judge/validate.h"
#include "reports/browser.h"
#include "reports/example_judgement.h"

namespace rainref::reports {
namespace {

using namespace judge;

using capture::Array;
using testing::HasSubstr;
using testing::Not;

/// The corrected small pack, and a port of it whose shade is upside down and whose drops differ in a field.
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
    return report_html(j, page_source(std::make_shared<const capture::Pack>(pack.folder()), port));
  }
  static std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) ++n;
    return n;
  }
  static TemporaryFolder* folder_;
};
TemporaryFolder* ReportPage::folder_ = nullptr;

TEST_F(ReportPage, SaysWhatFailsAndWhy) {
  const std::string text = contents(*folder_ / "bad.html");
  EXPECT_THAT(text, HasSubstr("<title>FAIL: puddle corrected, vulkan</title>"));
  EXPECT_THAT(text, HasSubstr("<a href=\"#pass-shade\">shade</a> is the first bad pass: "));
  EXPECT_THAT(text, HasSubstr("Likely cause: <b>upside down</b>"));
  EXPECT_THAT(text, HasSubstr("<code>rainref validate pack --port port</code>"));
  EXPECT_EQ(count(text, "<section class=\"pass "), 5u);
  EXPECT_EQ(count(text, "class=\"node is-fail first\""), 1u);
  EXPECT_EQ(count(text, "class=\"node is-pass\""), 4u);
  EXPECT_EQ(count(text, "class=\"edge previous\""), 1u);  // the wave of the step before
  // Two failing cases of shade; a sample of each other pass: wave, hit in four channels, normal in four, picture.
  EXPECT_EQ(count(text, "<figure class=\"pane verdict\">"), 2u + 2 + 4 + 4 + 1);
  EXPECT_THAT(text, HasSubstr("The worst 100 of "));
}

// The first bad pass stands first, its worst output before its others, and the banner leads there.
TEST_F(ReportPage, OpensOnWhatFailsWorst) {
  const TemporaryFolder folder;
  const capture::Pack pack(small_pack("puddle-corrected"));
  // Of hit one texel is off by 0.1 of 4 m in y, of normal many in z, by up to 0.29 of 2.
  write_port(pack, folder.path(), [](const capture::PackCase& c, const std::string& name, Array& a) {
    if (c.id != "puddle.surface_hit/0012.0") return;
    const float y = 0.1f;
    if (name == "hit") std::memcpy(&a.levels[0][16 * 40 + 4], &y, 4);
    if (name == "normal")
      for (std::size_t at = 4; at < a.levels[0].size(); at += 8) a.levels[0][at + 1] ^= std::byte{0x80};
  });
  const std::string text = page(pack, folder.path());
  EXPECT_THAT(text, HasSubstr("Worst in <a href=\"#at-puddle.surface_hit/0012.0/out.normal\">channel z of out.normal</a>, off by up to "));
  const auto at = [&](const std::string& what) { return text.find(what); };
  EXPECT_LT(at("id=\"pass-surface_hit\""), at("id=\"dataflow\""));
  EXPECT_LT(at("id=\"dataflow\""), at("id=\"pass-wave_step\""));
  EXPECT_NE(at("id=\"at-puddle.surface_hit/0012.0/out.hit\""), std::string::npos);
  EXPECT_LT(at("id=\"at-puddle.surface_hit/0012.0/out.normal\""), at("id=\"at-puddle.surface_hit/0012.0/out.hit\""));
  EXPECT_EQ(count(text, "<section class=\"pass "), 5u);
  EXPECT_EQ(count(text, "<div class=\"view\" data-open data-label=\"z\""), 1u);
  EXPECT_EQ(count(text, "<div class=\"view\" data-open "), 2u);  // one of each output that fails
  EXPECT_THAT(text, HasSubstr("<th class=\"n\">off by</th>"));
  if (!Browser::is_installed()) return;
  put(folder / "page.html", text);
  Browser browser;
  browser.open(folder / "page.html");
  const std::string viewer = "document.querySelector('#pass-surface_hit .viewer')";
  EXPECT_EQ(browser.value("[..." + viewer + ".querySelectorAll('.view:not([hidden])')].map(v => v.dataset.label).join()"), "z");
  EXPECT_EQ(browser.value(viewer + ".querySelectorAll('.view:not([hidden]) .mark').length"), 4);  // in each picture
}

// What a port in progress has not, and files that cannot be used: in the banner and by name.
TEST_F(ReportPage, SaysWhatWasNotJudged) {
  const TemporaryFolder folder;
  const capture::Pack pack(small_pack("puddle-corrected"));
  write_port(pack, folder.path());
  std::filesystem::remove_all(folder / "puddle.display");
  std::filesystem::remove(folder / "puddle.shade/0012.0/out.colour.npy");
  const parallel::Executor executor;
  ValidateOptions options;
  options.executor = &executor;
  options.partial = true;
  const PortJudgement j = validate(pack, folder.path(), options);
  const std::string text = report_html(j, page_source(std::make_shared<const capture::Pack>(pack.folder()), folder.path()));
  EXPECT_THAT(text,
              HasSubstr("<a href=\"#files\">1 file is</a> missing, or cannot be used. Not judged: <a href=\"#pass-shade\">shade</a>, <a "
                        "href=\"#pass-display\">display</a>."));
  EXPECT_THAT(text, HasSubstr("<section id=\"files\">"));
  EXPECT_THAT(text, HasSubstr("no 'out.colour' as .npy"));
  EXPECT_THAT(text, HasSubstr("<section class=\"pass is-not-judged\" id=\"pass-display\">"));
  EXPECT_THAT(text, HasSubstr("NOT JUDGED</span> puddle.shade/0012.0: out.colour: missing, or cannot be used"));
  EXPECT_EQ(count(text, "id=\"at-puddle.shade/0011.0/out.colour\""), 1u);  // a sample of what was judged
}

TEST_F(ReportPage, TheFieldsOfAListHaveFigures) {
  const TemporaryFolder folder;
  const capture::Pack pack(small_pack("windshield-corrected"));
  write_port(pack, folder.path(), [](const capture::PackCase& c, const std::string&, Array& a) {
    if (c.id == "windshield.integrate/0012.0") a.levels[0][6] ^= std::byte{0x10};  // of the first drop's position
  });
  const std::string text = page(pack, folder.path());
  EXPECT_THAT(text, HasSubstr("<td>drops</td><td>velocity.y</td><td>1/s</td><td>field</td>"));
  EXPECT_THAT(text, HasSubstr("Worst in <a href=\"#at-windshield.integrate/0012.0/out.drops\">position.y of out.drops</a>"));
  EXPECT_THAT(text, HasSubstr("fields outside, of "));
}

TEST_F(ReportPage, PassesWithoutFailures) {
  const std::string text = contents(*folder_ / "good.html");
  EXPECT_THAT(text, HasSubstr("<p class=\"verdict\">PASS</p>"));
  EXPECT_THAT(text, HasSubstr("100 % of the elements have the reference's own bits."));
  EXPECT_THAT(text, Not(HasSubstr("The worst")));
}

TEST_F(ReportPage, IsOneFile) {
  for (const std::string name : {"bad.html", "good.html"}) {
    const std::string text = contents(*folder_ / name);
    EXPECT_THAT(text, Not(HasSubstr("http:")));
    EXPECT_THAT(text, Not(HasSubstr("https:")));
    EXPECT_EQ(count(text, "src=\""), count(text, "src=\"data:image/png;base64,"));
  }
}

TEST_F(ReportPage, HostileNamesStayText) {
  PortJudgement j = example_judgement();
  j.port = j.command = j.passes[3].pass = j.first_bad_pass = "</script><script>alert(1)</script>\"'";
  j.passes[3].causes[0].sentence = j.notes[0] = "<img src=x onerror=alert(1)>{{js}}";
  const std::string text = report_html(j, {});
  EXPECT_EQ(count(text, "<script>"), 1u);
  EXPECT_THAT(text, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(text, HasSubstr("&lt;img src=x onerror=alert(1)&gt;{{js}}"));
}

TEST_F(ReportPage, NothingJudged) {
  PortJudgement j;
  j.reason = "port: there is no such folder";
  const std::string text = report_html(j, {});
  EXPECT_THAT(text, HasSubstr("UNTESTED"));
  EXPECT_THAT(text, HasSubstr("port: there is no such folder."));
}

TEST_F(ReportPage, UntestedSaysWhichPassAndWhy) {
  PortJudgement j = example_judgement();
  j.passes.pop_back();
  j.first_bad_pass.clear();
  j.status = Status::untested;
  EXPECT_THAT(report_html(j, {}),
              HasSubstr("Too little could be judged. <a href=\"#pass-noise\">noise</a>: 100 % of the elements have no useful bound.</p>"));
}

// --only: the one pass is drawn at its size, and what it takes from others is no link to nowhere.
TEST_F(ReportPage, OnePassAlone) {
  PortJudgement j = example_judgement();
  j.passes = {j.passes[3]};
  PageSource source;
  source.edges = {{"shade", "hit", "hit", false}};
  const std::string text = report_html(j, source);
  EXPECT_THAT(text, HasSubstr("viewBox=\"0 0 214 80\" style=\"max-width:214px;min-width:214px\""));
  EXPECT_THAT(text, HasSubstr("Takes hit of hit."));
  EXPECT_THAT(text, Not(HasSubstr("#pass-hit")));
}

// A port that took a stale input is wrong in what it stored as well. The input is the news.
TEST_F(ReportPage, AWrongInputIsTheCause) {
  PortJudgement j = example_judgement();
  PassJudgement& shade = j.passes[3];
  shade.causes.clear();
  shade.cases[0].broken = true;
  shade.reason = shade.cases[0].reason = "input hit is that of the run before";
  const std::string text = report_html(j, {});
  EXPECT_THAT(text, HasSubstr("is the first bad pass: input hit is that of the run before."));
  EXPECT_THAT(text, Not(HasSubstr("ause unknown")));
  EXPECT_THAT(text, Not(HasSubstr("cause is unknown")));
  EXPECT_EQ(count(text, shade.reason), 2u);  // in the banner, and with its run
}

class ReportPageInBrowser : public ReportPage {
 protected:
  void SetUp() override {
    if (!Browser::is_installed()) GTEST_SKIP() << "chromium is not installed: the page's behaviour is not tested";
  }
  /// Nothing was logged, thrown or fetched.
  static void expect_quiet(const Browser& browser, const std::filesystem::path& file) {
    for (const Browser::Json& e : browser.events) {
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

TEST_F(ReportPageInBrowser, FlickerShowsThePortInThePlaceOfTheReference) {
  Browser browser;
  browser.open(*folder_ / "bad.html");
  const std::string viewer = "document.querySelector('#pass-shade .viewer')";
  const auto port_is_shown = [&] {
    return browser.value("getComputedStyle(" + viewer + ".querySelector('.reference .other')).visibility");
  };
  const auto wait_for = [&](const std::string& state) {
    return browser.value("new Promise(done => { const end = Date.now() + 10000; (function look() { const v = getComputedStyle(" + viewer +
                         ".querySelector('.reference .other')).visibility; "
                         "v === '" +
                         state + "' || Date.now() > end ? done(v) : setTimeout(look, 10); })(); })");
  };
  EXPECT_EQ(port_is_shown(), "hidden");
  EXPECT_EQ(browser.value(viewer + ".querySelector('.reference .other').src === " + viewer + ".querySelector('.port img').src"), true);
  browser.value(viewer + ".focus()");
  browser.press("f");
  EXPECT_EQ(browser.value(viewer + ".querySelector('.flicker').getAttribute('aria-pressed')"), "true");
  for (const std::string state : {"hidden", "visible", "hidden", "visible"}) EXPECT_EQ(wait_for(state), state);
  browser.press("f");
  EXPECT_EQ(browser.value(viewer + ".querySelector('.flicker').getAttribute('aria-pressed')"), "false");
  EXPECT_EQ(port_is_shown(), "hidden");
  browser.press("s");
  EXPECT_EQ(port_is_shown(), "visible");
  expect_quiet(browser, *folder_ / "bad.html");
}

TEST_F(ReportPageInBrowser, KeysZoomMoveAndEnlarge) {
  Browser browser;
  browser.open(*folder_ / "bad.html");
  const std::string viewer = "document.querySelector('#pass-surface_hit .viewer')";
  const auto zoom = [&] { return browser.value("+getComputedStyle(" + viewer + ").getPropertyValue('--zoom')"); };
  const auto left = [&] { return browser.value("parseFloat(getComputedStyle(" + viewer + ").getPropertyValue('--px'))").get<double>(); };
  browser.value(viewer + ".focus()");
  browser.press("+");
  EXPECT_EQ(zoom(), 2);
  EXPECT_EQ(left(), -50);  // about the middle
  browser.press("ArrowRight");
  EXPECT_EQ(left(), -60);
  browser.press("-");
  EXPECT_EQ(zoom(), 1);
  EXPECT_EQ(left(), 0);  // never beyond the edge
  browser.press("2");
  EXPECT_EQ(
      browser.value("[...document.querySelectorAll('#pass-surface_hit .viewer')][0].querySelectorAll('.view:not([hidden]) .pane').length"),
      4);
  EXPECT_EQ(browser.value("[..." + viewer + ".querySelectorAll('.view:not([hidden]) .pane')].filter(p => p.offsetParent).length"), 1);
  browser.press("2");
  browser.press("v");
  EXPECT_EQ(browser.value(viewer + ".querySelector('.view:not([hidden])').dataset.label"), "y");
}

TEST_F(ReportPageInBrowser, AWorstElementIsFound) {
  Browser browser;
  browser.open(*folder_ / "bad.html");
  const std::string viewer = "document.querySelector('#pass-shade .viewer')";
  browser.value(viewer + ".querySelector('.place').click()");
  // The mark lies on the texel that the button names: the middle of the mark, in texels, row 0 at the bottom.
  const Browser::Json place =
      browser.value("[+" + viewer + ".querySelector('.place').dataset.x, +" + viewer + ".querySelector('.place').dataset.y]");
  const Browser::Json mark =
      browser.value("(() => { const m = " + viewer + ".querySelector('.view:not([hidden]) .mark').getBoundingClientRect(), i = " + viewer +
                    ".querySelector('.view:not([hidden]) img').getBoundingClientRect(); const u = (m.x + m.width / 2 - i.x) / i.width, v = "
                    "(m.y + m.height / 2 - i.y) / i.height; "
                    "return [Math.floor(35 * u), 20 - Math.floor(21 * v)]; })()");
  EXPECT_EQ(mark, place);
  EXPECT_THAT(browser.value(viewer + ".querySelector('.readout').textContent").get<std::string>(), HasSubstr("accepted"));
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
