#include "cli/view/view.h"

#include <cctype>
#include <cstdio>
#include <exception>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "cli/scene_file.h"
#include "cli/terminal.h"
#include "cli/view/access.h"
#include "cli/view/browser.h"
#include "cli/view/page_files.h"
#include "cli/view/scene_list.h"
#include "cli/view/server.h"
#include "cli/view/sessions.h"
#include "rainref/error.h"
#include "simulation/opened.h"
#include "simulation/picture_notes.h"
#include "simulation/preset_texts.h"

namespace rainref::cli {
namespace {

/// A text as a part of an address.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = byte < 0x80 && (std::isalnum(byte) != 0 || std::string_view("-._~/").find(c) != std::string_view::npos);
    out += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return out;
}

constexpr std::string_view scenes_folder = "scenes/", operations_folder = "run/";

/// A page's file, the list of scenes, or a scene's text.
Reply answer_get(const PageFiles& pages, const SceneList& scenes, std::string_view name) {
  try {
    if (!name.starts_with(scenes_folder)) return pages.get(name);
    name.remove_prefix(scenes_folder.size());
    if (name == "index.json") return {200, "application/json", scenes.json()};
    const std::filesystem::path file = scenes.file(name);
    if (file.empty()) return {404, "text/plain", "no such scene\n"};
    return {200, "text/plain; charset=utf-8", simulation::scene_text(file)};
  } catch (const std::exception& e) {
    return {500, "text/plain", fmt::format("{}\n", e.what())};
  }
}

}  // namespace

void view(const ViewRequest& request) {
  Server::require();
  const scene::Config config = load_scene(request.scene);  // its mistakes are told here, before a browser is opened
  const PageFiles pages;
  const SceneList scenes(request.named, request.scene.scene);
  Sessions sessions(scenes, request.scene.threads);
  Server server(request.port);
  Access access(Access::new_secret(), Access::new_secret(), server.port());

  std::string page = "live.html?scene=" + escaped(scenes.first()) + "&size=" + escaped(request.size);
  if (!request.presets.empty())
    for (const scene::Preset& preset : scene::presets_for(fmt::format("{}", fmt::join(request.presets, ",")), config.effect(),
                                                          config.variant(), simulation::effect_table().presets))
      for (const auto& [key, toml] : simulation::preset_texts(preset, config.effect())) page += "&set=" + escaped(key + "=" + toml);
  for (const std::string& set : request.set) page += "&set=" + escaped(set);
  const bool is_opened = request.opens_browser && open_browser(access.address_once());
  say("{}\n{}Ctrl-C ends it.\n", access.address() + page,
      is_opened || !request.opens_browser ? "" : "No browser could be opened: open this address in one. ");
  if (std::fflush(stdout) != 0) throw Error(ExitCode::io, "standard output cannot be written");

  server.run({.refusal = [&](const Sender& sender, std::string_view path) { return access.refusal(sender, path); },
              .get =
                  [&](std::string_view path) {
                    if (access.leads_to_page(path)) return Reply{303, "text/plain", "", access.address() + page};
                    return answer_get(pages, scenes, access.name_in(path));
                  },
              .post =
                  [&](std::string_view path, const Sent& sent, const Write& write) {
                    std::string_view name = access.name_in(path);
                    name.remove_prefix(name.starts_with(operations_folder) ? operations_folder.size() : name.size());
                    sessions.answer(name, sent, write);
                  }});
  throw Error(ExitCode::io, "view: the server ended");
}

}  // namespace rainref::cli
