# cmake --install copies the programs to the prefix, with their files for shells, man and desktops, the pages and the
# scenes. The program is called trace-ray, since others are called ray; `ray`, the name of the courses, leads to it.
# Packages are made of the same rules, one of each component (cmake/packages.cmake); `names` is in none of them.
include(GNUInstallDirs)
set(doc ${CMAKE_INSTALL_DATAROOTDIR}/doc/trace-ray)
if(NOT "$CACHE{CMAKE_INSTALL_DOCDIR}" STREQUAL "")
  set(doc ${CMAKE_INSTALL_DOCDIR})
endif()
set(man ${CMAKE_INSTALL_MANDIR}/man1)
set(packaging ${PROJECT_SOURCE_DIR}/packaging)

# The programs are in one folder, where `ray gui` looks for the studio; the commands are links to them.
set(programs ${CMAKE_INSTALL_LIBEXECDIR}/trace-ray)
file(RELATIVE_PATH toPrograms ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBEXECDIR}/trace-ray)

# install_link(COMPONENT FOLDER NAME TARGET)
function(install_link COMPONENT FOLDER NAME TARGET)
  set(links ${PROJECT_BINARY_DIR}/links/${FOLDER})
  file(MAKE_DIRECTORY ${links})
  file(REMOVE ${links}/${NAME})
  file(CREATE_LINK ${TARGET} ${links}/${NAME} SYMBOLIC)
  install(FILES ${links}/${NAME} DESTINATION ${FOLDER} COMPONENT ${COMPONENT})
endfunction()

if(CMAKE_SYSTEM_NAME STREQUAL Linux)  # what a program calls cannot be redirected once it runs
  foreach(program ray ray-studio)
    if(TARGET ${program})
      target_link_options(${program} PRIVATE LINKER:-z,relro,-z,now)
    endif()
  endforeach()
endif()

install(TARGETS ray DESTINATION ${programs} COMPONENT program)
install_link(program ${CMAKE_INSTALL_BINDIR} trace-ray ${toPrograms}/ray)
install_link(names ${CMAKE_INSTALL_BINDIR} ray trace-ray)
if(TARGET ray-studio)
  install(TARGETS ray-studio DESTINATION ${programs} COMPONENT studio OPTIONAL)  # it may not have been asked for
  install_link(studio ${CMAKE_INSTALL_BINDIR} ray-studio ${toPrograms}/ray-studio)
endif()

# The manual pages and completions come from the program's own tables; where it cannot run, there are none.
if(NOT CMAKE_CROSSCOMPILING)
  set(pages ${PROJECT_BINARY_DIR}/pages)
  file(MAKE_DIRECTORY ${pages})
  add_custom_command(TARGET ray POST_BUILD
    COMMAND $<TARGET_FILE:ray> features --man ray -o ${pages}/trace-ray.1
    COMMAND $<TARGET_FILE:ray> features --man ray-studio -o ${pages}/ray-studio.1
    COMMAND $<TARGET_FILE:ray> features --completion bash -o ${pages}/trace-ray.bash
    COMMAND $<TARGET_FILE:ray> features --completion zsh -o ${pages}/trace-ray.zsh
    COMMAND $<TARGET_FILE:ray> features --completion fish -o ${pages}/trace-ray.fish
    VERBATIM)
  set(bash ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions)
  set(fish ${CMAKE_INSTALL_DATAROOTDIR}/fish/vendor_completions.d)
  install(FILES ${pages}/trace-ray.1 DESTINATION ${man} COMPONENT program)
  install(FILES ${pages}/trace-ray.bash DESTINATION ${bash} RENAME trace-ray COMPONENT program)
  install(FILES ${pages}/trace-ray.zsh DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/zsh/site-functions RENAME _trace-ray
          COMPONENT program)
  install(FILES ${pages}/trace-ray.fish DESTINATION ${fish} COMPONENT program)
  install_link(names ${man} ray.1 trace-ray.1)
  install_link(names ${bash} ray trace-ray)
  install_link(names ${fish} ray.fish trace-ray.fish)
  if(TARGET ray-studio)
    install(FILES ${pages}/ray-studio.1 DESTINATION ${man} COMPONENT studio)
    install_link(studio ${bash} ray-studio trace-ray)
    install_link(studio ${fish} ray-studio.fish trace-ray.fish)
  endif()
endif()

# Files for desktops: an icon, the type of scene files, and for the studio an entry in the menus.
install(FILES ${packaging}/trace-ray.svg DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/icons/hicolor/scalable/apps
        COMPONENT program)
foreach(size 48 128)
  install(FILES ${packaging}/trace-ray-${size}.png RENAME trace-ray.png
          DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/icons/hicolor/${size}x${size}/apps COMPONENT program)
endforeach()
install(FILES ${packaging}/trace-ray.xml DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/mime/packages COMPONENT program)
if(TARGET ray-studio)
  install(FILES ${packaging}/trace-ray-studio.desktop DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/applications
          COMPONENT studio)
endif()

install(DIRECTORY scenes DESTINATION ${doc} COMPONENT program)
install(FILES README.md ARCHITECTURE.md CHANGELOG.md CITATION.cff CONTRIBUTING.md LICENSE SECURITY.md DESTINATION ${doc} COMPONENT doc)  # their links lead to one another
install(DIRECTORY docs editors include DESTINATION ${doc} COMPONENT doc)  # pages lead to them, and to examples (library.cmake)
install(FILES cmake/words.txt DESTINATION ${doc}/cmake COMPONENT doc)

include(${CMAKE_CURRENT_LIST_DIR}/packages.cmake)
