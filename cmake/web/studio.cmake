# The studio for a browser: Dear ImGui from its sources, GLFW and OpenGL ES from Emscripten (./dev web).
file(GLOB imgui ${PROJECT_SOURCE_DIR}/build/web-libraries/sources/imgui-[0-9]*)  # cmake/libraries.sh
add_library(imgui STATIC ${imgui}/imgui.cpp ${imgui}/imgui_draw.cpp ${imgui}/imgui_tables.cpp ${imgui}/imgui_widgets.cpp
  ${imgui}/misc/cpp/imgui_stdlib.cpp ${imgui}/backends/imgui_impl_glfw.cpp ${imgui}/backends/imgui_impl_opengl3.cpp)
target_include_directories(imgui SYSTEM PUBLIC ${imgui} ${imgui}/misc/cpp)
target_compile_definitions(imgui PRIVATE IMGUI_IMPL_OPENGL_ES3)
set_target_properties(imgui PROPERTIES UNITY_BUILD OFF)  # its back ends include different headers of OpenGL
floor(studio LIGHT USES app PRIVATE imgui PRECOMPILE imgui.h studio/studio.h)
add_executable(ray-studio src/studio/main.cpp)
target_link_libraries(ray-studio PRIVATE trace_studio imgui)
# One folder of a few files that any server can serve: the page (web/), the program, and the scenes and the font that it reads.
set(font /usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf)
target_link_options(ray-studio PRIVATE -fexceptions -pthread -sMIN_WEBGL_VERSION=2 -sMAX_WEBGL_VERSION=2 -sUSE_GLFW=3
  -sPTHREAD_POOL_SIZE=Module.workers -sINITIAL_MEMORY=256MB -sALLOW_MEMORY_GROWTH -sMAXIMUM_MEMORY=4GB
  -sTOTAL_STACK=4MB -sDEFAULT_PTHREAD_STACK_SIZE=2MB -sEXPORTED_RUNTIME_METHODS=ccall,FS -sFORCE_FILESYSTEM -sENVIRONMENT=web,worker
  "SHELL:--preload-file ${PROJECT_SOURCE_DIR}/scenes@/scenes" "SHELL:--preload-file ${font}@${font}" -Wno-pthreads-mem-growth)
# The program, for node: what the page computes, to be compared with the desktop's (tests/web).
target_link_options(ray PRIVATE -fexceptions -pthread -sNODERAWFS -sPROXY_TO_PTHREAD -sEXIT_RUNTIME -sPTHREAD_POOL_SIZE=8
  -sINITIAL_MEMORY=256MB -sALLOW_MEMORY_GROWTH -sMAXIMUM_MEMORY=4GB -sTOTAL_STACK=4MB -sDEFAULT_PTHREAD_STACK_SIZE=2MB
  -sENVIRONMENT=node,worker -Wno-pthreads-mem-growth)
set(page ${PROJECT_BINARY_DIR}/page)
add_custom_target(web ALL DEPENDS ray-studio
  COMMAND ${CMAKE_COMMAND} -E make_directory ${page}
  COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/web/index.html ${PROJECT_SOURCE_DIR}/web/page.js
          ${PROJECT_SOURCE_DIR}/web/input.js ${PROJECT_SOURCE_DIR}/web/isolation.js ${PROJECT_BINARY_DIR}/bin/ray-studio.js ${PROJECT_BINARY_DIR}/bin/ray-studio.wasm
          ${PROJECT_BINARY_DIR}/bin/ray-studio.data ${PROJECT_BINARY_DIR}/bin/ray-studio.worker.js ${page})
# A place where an exception may pass costs a call into JavaScript here. The code that rays run through has none: a render that is
# cancelled there frees less than all of its memory.
foreach(hot math accel geometry shading)
  target_compile_options(trace_${hot} PRIVATE -fignore-exceptions)
endforeach()
file(GLOB hot ${PROJECT_SOURCE_DIR}/src/render/*/*.cpp)
list(FILTER hot EXCLUDE REGEX "/render/(world|picture)/")  # which catch some
set_source_files_properties(${hot} PROPERTIES COMPILE_OPTIONS -fignore-exceptions)
set_target_properties(trace_render PROPERTIES UNITY_BUILD OFF)
