# The page of `rainref view`: the site's own files, beside the scenes. Its engine is the program.
set(pages)
foreach(name cancelled.js live.html live.css live.js live_busy.js live_film.js live_gallery.js live_lines.js live_link.js live_player.js live_presets.js live_run.js
             live_scenes.js live_screen.js live_speed.js parameters.js scene_values.js style.css webm.js)
  list(APPEND pages ${CMAKE_CURRENT_SOURCE_DIR}/web/pages/${name})
endforeach()
list(APPEND pages ${CMAKE_CURRENT_SOURCE_DIR}/web/program/engine.js ${CMAKE_CURRENT_SOURCE_DIR}/reports/assets/common.css
                  ${CMAKE_CURRENT_SOURCE_DIR}/reports/assets/report_words.js)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share/rainref/pages)
foreach(file IN LISTS pages)
  cmake_path(GET file FILENAME name)
  file(CREATE_LINK ${file} ${PROJECT_BINARY_DIR}/share/rainref/pages/${name} SYMBOLIC COPY_ON_ERROR)
endforeach()
# The program that opens addresses.
set(opens_addresses xdg-open)
if(APPLE)
  set(opens_addresses open)
endif()
set_source_files_properties(cli/view/browser_posix.cpp PROPERTIES COMPILE_DEFINITIONS RAINREF_OPENS_ADDRESSES="${opens_addresses}")
