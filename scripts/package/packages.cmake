# CPack's packages of Debian, one for each component of the installation; scripts/packages makes them. Which libraries a package needs
# is read from its files, so it is for the release of Debian that it was made in; its version says which.
include(GNUInstallDirs)
file(STRINGS /etc/os-release release REGEX "^VERSION_ID=")
string(REGEX REPLACE "[^0-9.]" "" release "${release}")
set(CPACK_PACKAGE_NAME rainref)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_VENDOR rainref)
set(CPACK_PACKAGE_CONTACT "rainref maintainers <maintainers@users.noreply.github.com>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program library dev data python3)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE "1~deb${release}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# Folders as Debian has them, whatever the umask of the build.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(full_version "${PROJECT_VERSION}-1~deb${release}")
set(about "rainref simulates five published rain effects with the same bits on every
machine, and judges GPU ports of them pass by pass: which pass is wrong
first, where, by how much, and the likely mistake.")
function(rainref_package component name more)
  cmake_parse_arguments(ARG "" "SECTION;ARCHITECTURE" "DEPENDS" ${ARGN})
  string(TOUPPER ${component} key)
  list(JOIN ARG_DEPENDS ", " depends)
  foreach(pair IN ITEMS "NAME=${name}" "DEPENDS=${depends}" "SECTION=${ARG_SECTION}" "ARCHITECTURE=${ARG_ARCHITECTURE}")
    if(pair MATCHES "^([A-Z]+)=(.+)$")
      set(CPACK_DEBIAN_${key}_PACKAGE_${CMAKE_MATCH_1} "${CMAKE_MATCH_2}" PARENT_SCOPE)
    endif()
  endforeach()
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${about}\n\n${more}" PARENT_SCOPE)
  # What each package of Debian has; an installation by itself has the licence beside its documents.
  set(documents ${CMAKE_INSTALL_DATADIR}/doc/${name})
  install(FILES ${PROJECT_SOURCE_DIR}/scripts/package/copyright ${PROJECT_BINARY_DIR}/package/changelog.Debian.gz DESTINATION ${documents}
          COMPONENT ${component} EXCLUDE_FROM_ALL)
  set(overrides ${PROJECT_SOURCE_DIR}/scripts/package/${component}.overrides)
  if(EXISTS ${overrides})
    install(FILES ${overrides} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME ${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
  endif()
endfunction()
rainref_package(program rainref "This is the program."
  DEPENDS "librainref0 (= ${full_version})" "rainref-data (= ${full_version})")
rainref_package(library librainref0 "This is the library for C, and what reads and writes pictures."
  SECTION libs
  DEPENDS "rainref-data (= ${full_version})")
rainref_package(dev librainref-dev "These are the headers for C and C++, and the libraries for C++."
  SECTION libdevel
  DEPENDS "librainref0 (= ${full_version})" libhwy-dev libtbb-dev libfmt-dev libtomlplusplus-dev nlohmann-json3-dev libglm-dev libembree-dev
          libxxhash-dev zlib1g-dev pkg-config)
rainref_package(data rainref-data
  "These are scenes, small packs, profiles, documents and examples." ARCHITECTURE all)
rainref_package(python3 python3-rainref "This is the package for Python 3." SECTION python ARCHITECTURE all
  DEPENDS python3 python3-numpy "librainref0 (>= ${full_version})" "rainref-data (>= ${full_version})")
set(CPACK_DEBIAN_PYTHON3_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/scripts/package/postinst ${PROJECT_SOURCE_DIR}/scripts/package/prerm)

# What others that link the library depend on, and that the loader's list is to be made anew.
file(CONFIGURE OUTPUT package/shlibs CONTENT "librainref ${PROJECT_VERSION_MAJOR} librainref0 (>= ${PROJECT_VERSION})
")
file(CONFIGURE OUTPUT package/triggers CONTENT "activate-noawait ldconfig
")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/package/shlibs ${PROJECT_BINARY_DIR}/package/triggers)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/python/rainref DESTINATION lib/python3/dist-packages COMPONENT python3 EXCLUDE_FROM_ALL
        PATTERN "__pycache__" EXCLUDE)

# Of the packaging, not of rainref: that has CHANGELOG.md.
file(CONFIGURE OUTPUT package/changelog.Debian CONTENT "rainref (${full_version}) stable; urgency=medium

  * Made by scripts/packages; what is new is in rainref-data: CHANGELOG.md.

 -- ${CPACK_PACKAGE_CONTACT}  Mon, 23 Nov 2026 00:00:00 +0000
")
if(RAINREF_GZIP)
  execute_process(COMMAND ${RAINREF_GZIP} -9nkf ${PROJECT_BINARY_DIR}/package/changelog.Debian)
endif()
include(CPack)
