# Fetches the sources of Dear ImGui: substep_fetch_imgui(OUT) sets OUT to their folder.
#
# Debian 12's libimgui-dev is 1.86 and native only; the web build needs sources, and both shells
# should use the same version. On Debian, apt fetches the source package of 1.90.1 and checks its
# signature, with separate lists and sources, so that the system is unchanged; elsewhere the upstream
# tag is used. Both must have the same contents: the digest below covers every file that we compile.
# A second configure finds the folder and needs no network. -DIMGUI_SOURCE_DIR=... overrides this.

set(IMGUI_VERSION 1.90.1)
set(IMGUI_DEBIAN_VERSION 1.90.1+ds-1)
set(IMGUI_DEBIAN_SUITE trixie)
set(IMGUI_DIGEST "ed2812dd4d51f230d131beadbfa01d64b13e3798a290d80a23431bd657c2d5a2")
set(IMGUI_FILES
  imconfig.h imgui.cpp imgui.h imgui_draw.cpp imgui_internal.h imgui_tables.cpp imgui_widgets.cpp
  imstb_rectpack.h imstb_textedit.h imstb_truetype.h
  backends/imgui_impl_glfw.cpp backends/imgui_impl_glfw.h
  backends/imgui_impl_opengl3.cpp backends/imgui_impl_opengl3.h
  backends/imgui_impl_opengl3_loader.h)

# One digest of all files that we compile, or "incomplete".
function(substep_imgui_digest dir out)
  set(all "")
  foreach(file IN LISTS IMGUI_FILES)
    if(NOT EXISTS ${dir}/${file})
      set(${out} "incomplete" PARENT_SCOPE)
      return()
    endif()
    file(SHA256 ${dir}/${file} digest)
    string(APPEND all "${file} ${digest}\n")
  endforeach()
  string(SHA256 all "${all}")
  set(${out} ${all} PARENT_SCOPE)
endfunction()

function(substep_imgui_from_apt deps out)
  set(${out} "" PARENT_SCOPE)
  find_program(APT_GET apt-get)
  mark_as_advanced(APT_GET)
  if(NOT APT_GET)
    return()
  endif()
  execute_process(
    COMMAND ${APT_GET} indextargets --format $(REPO_URI) "Created-By: Packages" "Component: main"
    OUTPUT_VARIABLE archives ERROR_QUIET)
  string(REGEX MATCHALL "[^\n]+" archives "${archives}")
  list(FILTER archives INCLUDE REGEX "/debian/?$")
  list(APPEND archives http://deb.debian.org/debian/)
  list(GET archives 0 archive)

  set(apt ${deps}/apt)
  file(MAKE_DIRECTORY ${apt}/lists/partial ${apt}/cache/archives/partial ${apt}/sources.list.d)
  file(WRITE ${apt}/sources.list.d/imgui.sources
    "Types: deb-src\nURIs: ${archive}\nSuites: ${IMGUI_DEBIAN_SUITE}\nComponents: main\n"
    "Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg\n")
  set(options -q
    -o Dir::State::Lists=${apt}/lists -o Dir::Cache=${apt}/cache
    -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts=${apt}/sources.list.d
    -o Debug::NoLocking=1 -o APT::Sandbox::User= -o Acquire::Languages=none)
  message(STATUS "Dear ImGui ${IMGUI_VERSION}: source package from ${archive}")
  execute_process(COMMAND ${APT_GET} ${options} update
    OUTPUT_FILE ${apt}/log ERROR_FILE ${apt}/log RESULT_VARIABLE failed)
  if(NOT failed)
    execute_process(
      COMMAND ${APT_GET} ${options} --download-only source imgui=${IMGUI_DEBIAN_VERSION}
      WORKING_DIRECTORY ${apt} OUTPUT_FILE ${apt}/log2 ERROR_FILE ${apt}/log2
      RESULT_VARIABLE failed)
  endif()
  file(GLOB archive ${apt}/imgui_${IMGUI_VERSION}*.orig.tar.*)
  if(failed OR NOT archive)
    message(STATUS "Dear ImGui: apt could not fetch it (see ${apt}/log*)")
    return()
  endif()
  file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${deps})
  file(REMOVE_RECURSE ${apt})
  set(${out} ${deps}/imgui-${IMGUI_VERSION} PARENT_SCOPE)
endfunction()

function(substep_imgui_from_upstream deps out)
  include(FetchContent)
  set(FETCHCONTENT_BASE_DIR ${deps}/fetch)
  set(FETCHCONTENT_QUIET OFF)
  FetchContent_Declare(imgui GIT_REPOSITORY https://github.com/ocornut/imgui.git
    GIT_TAG v${IMGUI_VERSION} GIT_SHALLOW ON SOURCE_DIR ${deps}/imgui-${IMGUI_VERSION})
  FetchContent_GetProperties(imgui)
  if(NOT imgui_POPULATED)
    FetchContent_Populate(imgui)
  endif()
  set(${out} ${deps}/imgui-${IMGUI_VERSION} PARENT_SCOPE)
endfunction()

function(substep_fetch_imgui out)
  set(IMGUI_SOURCE_DIR "" CACHE PATH "Dear ImGui sources to use instead of fetching ${IMGUI_VERSION}")
  if(IMGUI_SOURCE_DIR)
    if(NOT EXISTS ${IMGUI_SOURCE_DIR}/imgui.cpp)
      message(FATAL_ERROR "IMGUI_SOURCE_DIR=${IMGUI_SOURCE_DIR} has no imgui.cpp")
    endif()
    set(${out} ${IMGUI_SOURCE_DIR} PARENT_SCOPE)
    return()
  endif()

  # Builds of one checkout (release, web, ...) share the fetched sources.
  string(FIND ${PROJECT_BINARY_DIR} ${PROJECT_SOURCE_DIR}/build/ at)
  if(at EQUAL 0)
    set(deps ${PROJECT_SOURCE_DIR}/build/deps)
  else()
    set(deps ${PROJECT_BINARY_DIR}/deps)
  endif()
  set(dir ${deps}/imgui-${IMGUI_VERSION})
  substep_imgui_digest(${dir} digest)
  if(NOT digest STREQUAL IMGUI_DIGEST)
    file(REMOVE_RECURSE ${dir})
    substep_imgui_from_apt(${deps} dir)
    if(NOT dir)
      substep_imgui_from_upstream(${deps} dir)
    endif()
    substep_imgui_digest(${dir} digest)
    if(NOT digest STREQUAL IMGUI_DIGEST)
      message(FATAL_ERROR "Dear ImGui in ${dir} differs from the expected ${IMGUI_VERSION} "
        "(digest ${digest}). Remove that folder, or give -DIMGUI_SOURCE_DIR=...")
    endif()
  endif()
  set(${out} ${dir} PARENT_SCOPE)
endfunction()
