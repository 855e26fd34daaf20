// `rainref view` over HTTP: what it serves and what it refuses, and that its frames are those of `rainref run` and `rainref hash`.
#include "cli/view/page.h"
#include "image_io/read.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

class View : public CommandLine {
 protected:
  View() : path_(std::getenv("PATH")) { fs::create_directory(folder / "bin"); }
  ~View() override {
    ::setenv("PATH", path_.c_str(), 1);
    ::unsetenv("TMPDIR");
  }

  /// A program of this shell script, before all others.
  void use(const std::string& name, const std::string& script) {
    const fs::path file = folder / ("bin/" + name);
    put(file, "#!/bin/sh\n" + script);
    fs::permissions(file, fs::perms::owner_all);
    ::setenv("PATH", ((folder / "bin").string() + ":" + path_).c_str(), 1);
  }
  ServedPage served(const std::vector<std::string>& more = {}) const {
    return {folder.path(), joined({"corrected.toml", "--size", "24x16", "--no-browser"}, more)};
  }
  /// The arguments that open the scene of the page's address.
  nlohmann::json scene(std::vector<std::string> sets = {}) const {
    sets.insert(sets.begin(), "run.size=[24, 16]");
    return {{"text", contents(folder / "corrected.toml")}, {"file", "corrected.toml"}, {"known", "corrected.toml"}, {"sets", sets}};
  }
  /// A PNG's pixels as a page shows them.
  std::string shown(const fs::path& png) const {
    const Image image = image_io::read(png).image;
    std::string bytes;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        bytes.append(reinterpret_cast<const char*>(image.row_bytes(y)) + 4 * x, 3);
        bytes += '\xff';
      }
    return bytes;
  }
  std::vector<std::string> lines_of_frame(const std::vector<std::string>& arguments, int frame) const {
    std::vector<std::string> lines = hash(joined({"corrected.toml", "--size", "24x16"}, arguments));
    std::erase_if(lines, [&](const std::string& line) { return !line.starts_with(std::to_string(frame) + " "); });
    EXPECT_FALSE(lines.empty());
    return lines;
  }

 private:
  std::string path_;
};

TEST_F(View, ServesThePage) {
  ServedPage page = served();
  EXPECT_THAT(page.address(), MatchesRegex("http://127\\.0\\.0\\.1:[0-9]+/[0-9a-f]{32}/live\\.html\\?scene=corrected\\.toml&size=24x16"));
  const httplib::Result html = page.get("live.html");
  ASSERT_TRUE(html);
  EXPECT_EQ(html->status, 200);
  EXPECT_THAT(html->get_header_value("Content-Type"), StartsWith("text/html"));
  EXPECT_EQ(html->get_header_value("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(html->get_header_value("Referrer-Policy"), "no-referrer");
  EXPECT_THAT(html->get_header_value("Content-Security-Policy"), HasSubstr("frame-ancestors 'none'"));
  // Each file that a file of the page names is there.
  int checked = 0;
  std::vector<std::string> names{"live.html"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const httplib::Result file = page.get(names[k]);
    ASSERT_TRUE(file && file->status == 200) << names[k];
    const std::regex named("(src|href|from|import) ?=?\\(?\"(?:\\./)?([a-z_]+\\.(?:js|css))\"");
    for (std::sregex_iterator at(file->body.begin(), file->body.end(), named), end; at != end; ++at) {
      const std::string name = (*at)[2];
      if (name == "live_compare.js") continue;  // of ports, which this page has not
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
      ++checked;
    }
  }
  EXPECT_GE(checked, 12);
  EXPECT_THAT(page.get("engine.js")->body, HasSubstr("rainref view"));
  const nlohmann::json list = nlohmann::json::parse(page.get("scenes/index.json")->body);
  bool has_own = false, has_bundled = false;
  for (const auto& entry : list["scenes"]) {
    has_own |= entry["path"] == "corrected.toml" && entry["file"] == "corrected.toml" && entry["effect"] == "puddle";
    has_bundled |= entry["path"] == "puddle/default.toml" && entry["file"] == "scenes/puddle/default.toml" &&
                   entry["sentence"] == "A puddle on a street at night, in rain.";
  }
  EXPECT_TRUE(has_own && has_bundled) << list;
  EXPECT_EQ(page.get("scenes/corrected.toml")->body, contents(folder / "corrected.toml"));
}

TEST_F(View, RefusesOtherPagesAndHosts) {
  ServedPage page = served();
  const auto refused = [&](const std::string& path, const httplib::Headers& headers) {
    for (const httplib::Result& result : {page.client().Get(path, headers), page.client().Post(path, headers, "x", "text/plain")}) {
      ASSERT_TRUE(result) << path;
      EXPECT_EQ(result->status, 403) << path;
      EXPECT_THAT(result->body, AllOf(HasSubstr("expected"), Not(HasSubstr(page.root()))));
    }
  };
  const std::string html = page.root() + "live.html", step = page.root() + "run/1/step";
  for (const std::string& path : {html, step}) {
    refused(path, {{"Host", "rain.example"}});
    refused(path, {{"Host", "rain.example:" + page.host().substr(10)}});
    refused(path, {{"Origin", "http://rain.example"}});
    refused(path, {{"Origin", "null"}});
    refused(path, {{"Sec-Fetch-Site", "cross-site"}});
  }
  refused("/live.html", {});
  refused("/" + std::string(32, '0') + "/live.html", {});
  EXPECT_EQ(page.get("live.html", {{"Origin", "http://" + page.host()}})->status, 200);
  EXPECT_EQ(page.client().Delete(html)->status, 405);
}

TEST_F(View, ServesNoOtherFile) {
  ServedPage page = served();
  for (const std::string name :
       {"", "../scenes/puddle/default.toml", "%2e%2e/scenes/puddle/default.toml", "..%2fscenes%2fpuddle%2fdefault.toml", "/etc/passwd",
        "scenes/../../../../etc/passwd", "scenes/%2e%2e/pages/live.html", "scenes//etc/passwd", "sky.npy", "scenes/sky.npy",
        "scenes/published.toml", "scenes/puddle", "live.html/", "live.html%00.js", "scenes/windshield/cycles/wltc_3b.csv"}) {
    const httplib::Result result = page.get(name);
    ASSERT_TRUE(result) << name;
    EXPECT_EQ(result->status, 404) << name;
    EXPECT_LT(result->body.size(), 20u) << name;
  }
  // And writes none: files that a page sends have plain names.
  nlohmann::json args = scene();
  args.erase("known");
  for (const std::string name : {"../x.npy", "/x.npy", "a/x.npy", ".."}) {
    const Message answer = page.run("open", args, "1", {{"file", "x", name, "application/octet-stream"}}).back();
    EXPECT_THAT(answer.json["error"]["message"].get<std::string>(), HasSubstr("without a folder")) << name;
    EXPECT_EQ(answer.json["error"]["code"], 2);
  }
}

TEST_F(View, FramesAreThoseOfTheProgram) {
  ServedPage page = served();
  page.good("open", scene());
  for (int frame = 0; frame < 2; ++frame) {
    const Message answer = page.good("step", {});
    EXPECT_EQ(answer.json["result"]["lines"], lines_of_frame({"--frames", "2"}, frame));
    good(rainref({"run", "corrected.toml", "--size", "24x16", "--frames", std::to_string(frame + 1), "-o", "out", "--overwrite"}));
    EXPECT_EQ(answer.json["member"], "picture");
    EXPECT_EQ(answer.bytes, shown(folder / fmt::format("out/puddle.{:04}.png", frame)));
  }
}

TEST_F(View, AKeySetIsTheSceneWithThatKey) {
  ServedPage page = served();
  const std::vector<std::string> with{"--set", "puddle.rim_width=0.3", "--frames", "2"};
  page.good("open", scene());
  // Before the first frame.
  EXPECT_THAT(page.good("set", {{"key", "puddle.rim_width"}, {"value", "0.3"}}).json["result"]["sceneJson"].get<std::string>(),
              HasSubstr("\"puddle.rim_width\": 0.3"));
  for (int frame = 0; frame < 2; ++frame) {
    const Message answer = page.good("step", {});
    EXPECT_EQ(answer.json["result"]["lines"], lines_of_frame(with, frame));
    EXPECT_NE(answer.json["result"]["lines"], lines_of_frame({"--frames", "2"}, frame));
  }
  good(rainref(joined({"run", "corrected.toml", "--size", "24x16", "-o", "out"}, with)));
  page.good("open", scene({"puddle.rim_width=0.3"}));
  page.good("step", {});
  EXPECT_EQ(page.good("step", {}).bytes, shown(folder / "out/puddle.0001.png"));
}

TEST_F(View, ErrorsNameThePlaceAndTheSceneGoesOn) {
  ServedPage page = served();
  const auto error = [&](const std::string& operation, const nlohmann::json& args) {
    return page.run(operation, args).back().json["error"];
  };
  EXPECT_THAT(error("step", {})["message"].get<std::string>(), HasSubstr("no scene is open"));
  page.good("open", scene());
  EXPECT_THAT(error("set", {{"key", "rain.rat"}, {"value", "3"}})["message"].get<std::string>(), HasSubstr("rain.rate"));
  nlohmann::json wrong = scene();
  wrong["text"] = "effect = 'puddel'\n";
  EXPECT_THAT(error("open", wrong)["message"].get<std::string>(), AllOf(HasSubstr("corrected.toml:1"), HasSubstr("'puddle'")));
  EXPECT_EQ(error("open", wrong)["code"], 2);
  EXPECT_THAT(error("open", {})["message"].get<std::string>(), HasSubstr("file: expected"));
  EXPECT_THAT(error("set", {{"key", 3}, {"value", "3"}})["message"].get<std::string>(), HasSubstr("another type"));
  EXPECT_THAT(error("stop", {})["message"].get<std::string>(), HasSubstr("no operation 'stop'"));
  EXPECT_EQ(page.good("step", {}).json["result"]["lines"], lines_of_frame({}, 0));
}

TEST_F(View, EachPageHasItsScene) {
  ServedPage page = served();
  page.good("open", scene(), "a");
  page.good("step", {}, "a");
  page.good("open", scene(), "b");
  EXPECT_EQ(page.good("step", {}, "b").json["result"]["lines"], lines_of_frame({}, 0));
  EXPECT_EQ(page.good("step", {}, "a").json["result"]["lines"], lines_of_frame({}, 1));
  page.good("close", {}, "b");
  EXPECT_TRUE(page.run("step", {}, "b").back().json.contains("error"));
  // More pages than are kept.
  for (const char* other : {"c", "d", "e", "f"}) page.good("open", scene(), other);
  EXPECT_TRUE(page.run("step", {}, "a").back().json.contains("error"));
  EXPECT_TRUE(page.run("step", {}, "../1").empty() || page.run("step", {}, "../1").back().json.contains("error"));
}

TEST_F(View, AFilmHasTheFramesOfTheProgram) {
  use("ffmpeg", "for last; do :; done\ncat >\"${last#file:}\"\n");
  ServedPage page = served();
  page.good("open", scene());
  page.good("step", {});  // a film begins at the first frame all the same
  page.good("set", {{"key", "puddle.rim_width"}, {"value", "0.3"}});
  const std::vector<Message> answers = page.run("film", {{"frames", 3}, {"kind", "mp4"}});
  ASSERT_EQ(answers.size(), 4u);
  EXPECT_EQ(answers[1].json["progress"], (nlohmann::json{2, 3}));
  EXPECT_EQ(answers[3].json["member"], "film");
  good(rainref({"run", "corrected.toml", "--size", "24x16", "--frames", "3", "--set", "puddle.rim_width=0.3", "--film", "film.mp4",
                "--image", "none"}));
  EXPECT_EQ(answers[3].bytes, contents(folder / "film.mp4"));
  EXPECT_EQ(answers[3].bytes.size(), 3u * 3 * 24 * 16);
  EXPECT_THAT(page.run("film", {{"frames", 0}, {"kind", "mp4"}}).back().json["error"]["message"].get<std::string>(),
              HasSubstr("expected 1 to"));
  EXPECT_THAT(page.run("film", {{"frames", 3}, {"kind", "avi"}}).back().json["error"]["message"].get<std::string>(), HasSubstr(".webm"));
}

TEST_F(View, OpensTheBrowser) {
  use("xdg-open", "printf '%s\\n' \"$#\" \"$@\" >opened.part && mv opened.part opened\n");
  ServedPage page(folder.path(), {"corrected.toml", "--set", "rain.rate= 20"});
  EXPECT_THAT(page.address(), EndsWith("/live.html?scene=corrected.toml&size=640x360&set=rain.rate%3D%2020"));
  await([&] { return fs::exists(folder / "opened"); });
  // Others may see what it is given: that works once.
  const std::vector<std::string> given = lines_of(contents(folder / "opened"));
  const std::string start = "http://" + page.host();
  ASSERT_THAT(given, ElementsAre("1", StartsWith(start + "/")));
  EXPECT_THAT(given[1], Not(HasSubstr(page.root())));
  const httplib::Result first = page.client().Get(given[1].substr(start.size()));
  EXPECT_EQ(first->status, 303);
  EXPECT_THAT(first->get_header_value("Location"), StartsWith(start + page.root() + "live.html?scene=corrected.toml&size=640x360&set="));
  EXPECT_EQ(page.client().Get(given[1].substr(start.size()))->status, 403);
}

TEST_F(View, RefusesBeforeItServes) {
  before = folder.names();
  expect_refusal({"view", "nowhere.toml", "--no-browser"}, 4, HasSubstr("nowhere.toml"));
  expect_refusal({"view", "corrected.toml", "--no-browser", "--set", "rain.rat=3"}, 2, HasSubstr("rain.rate"));
  expect_refusal({"view", "corrected.toml", "--no-browser", "--port", "70000"}, 2, HasSubstr("--port"));
  const ServedPage page = served();
  expect_refusal({"view", "corrected.toml", "--no-browser", "--port", page.host().substr(10)}, 4, HasSubstr("expected a free port"));
}

TEST_F(View, APictureIsAScene) {
  good(rainref({"run", "corrected.toml", "--size", "24x16", "-o", "."}));
  ServedPage page(folder.path(), {"puddle.0001.png", "--size", "24x16", "--no-browser"});
  EXPECT_THAT(page.address(), HasSubstr("?scene=puddle.0001.png&"));
  nlohmann::json args = scene();
  args["text"] = page.get("scenes/puddle.0001.png")->body;
  args["known"] = "puddle.0001.png";
  page.good("open", args);
  EXPECT_EQ(page.good("step", {}).json["result"]["lines"], lines_of_frame({}, 0));
}

TEST_F(View, EndsWithASignalAndLeavesNothing) {
  fs::create_directory(folder / "tmp");
  ::setenv("TMPDIR", (folder / "tmp").c_str(), 1);
  ServedPage page = served();
  nlohmann::json args = scene();
  args.erase("known");
  const Message answer =
      page.run("open", args, "1", {{"file", contents(folder / "sky.npy"), "sky.npy", "application/octet-stream"}}).back();
  EXPECT_TRUE(answer.json.contains("result")) << answer.json;
  EXPECT_EQ(page.good("step", {}).json["result"]["lines"], lines_of_frame({}, 0));
  EXPECT_EQ(names("tmp").size(), 1u);
  EXPECT_EQ(page.program().end(SIGTERM), -SIGTERM);
  EXPECT_THAT(names("tmp"), ElementsAre());
}

}  // namespace
}  // namespace rainref::cli
