# Manual page and shell completion of an app, both made of its --help while building, so
# that they cannot say anything else. Without help2man (Debian: help2man) there are no
# manual pages, and nothing else is missing.
find_program(HELP2MAN_PROGRAM help2man)
find_program(GZIP_PROGRAM gzip)

# A page NAME.1.gz; help2man runs the app in the C locale.
function(pcl_mrf_planes_man_page target title)
  set(page "${CMAKE_CURRENT_BINARY_DIR}/${target}.1")
  set(source "${PROJECT_SOURCE_DIR}/packaging/man/${target}.h2m")
  add_custom_command(OUTPUT "${page}.gz"
    COMMAND ${HELP2MAN_PROGRAM} --no-info --no-discard-stderr --locale=C
      "--name=${title}" "--include=${source}"
      "--version-string=${target} ${PROJECT_VERSION}" "--output=${page}"
      $<TARGET_FILE:${target}>
    COMMAND ${GZIP_PROGRAM} -9nf "${page}"
    DEPENDS ${target} "${source}"
    COMMENT "Manual page of ${target}" VERBATIM)
  add_custom_target(${target}_man ALL DEPENDS "${page}.gz")
  install(FILES "${page}.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT tools)
endfunction()

# bash reads a file of the app's name; zsh asks the app itself.
function(pcl_mrf_planes_completion target)
  set(completion "${CMAKE_CURRENT_BINARY_DIR}/completion/${target}")
  set(maker "${PROJECT_SOURCE_DIR}/packaging/completion/make_completion.cmake")
  add_custom_command(OUTPUT "${completion}"
    COMMAND ${CMAKE_COMMAND} -D APP=$<TARGET_FILE:${target}> -D "NAME=${target}"
      -D "OUTPUT=${completion}" -P "${maker}"
    DEPENDS ${target} "${maker}"
    COMMENT "Completion of ${target}" VERBATIM)
  add_custom_target(${target}_completion ALL DEPENDS "${completion}")
  install(FILES "${completion}"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" COMPONENT tools)
  configure_file("${PROJECT_SOURCE_DIR}/packaging/completion/zsh_completion.in"
    "${CMAKE_CURRENT_BINARY_DIR}/completion/_${target}" @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/completion/_${target}"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions" COMPONENT tools)
endfunction()

# Both; title: what the app does, in a line.
function(pcl_mrf_planes_app_pages target title)
  if(CMAKE_CROSSCOMPILING) # the apps do not run here
    return()
  endif()
  pcl_mrf_planes_completion(${target})
  if(HELP2MAN_PROGRAM AND GZIP_PROGRAM)
    pcl_mrf_planes_man_page(${target} "${title}")
  endif()
endfunction()
