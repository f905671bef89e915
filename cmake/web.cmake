# The studio for a browser: Dear ImGui from its sources, GLFW and OpenGL ES from Emscripten (./dev web).
set(imgui ${PROJECT_SOURCE_DIR}/build/web-dependencies/sources/imgui)
add_library(imgui STATIC ${imgui}/imgui.cpp ${imgui}/imgui_draw.cpp ${imgui}/imgui_tables.cpp ${imgui}/imgui_widgets.cpp
  ${imgui}/misc/cpp/imgui_stdlib.cpp ${imgui}/backends/imgui_impl_glfw.cpp ${imgui}/backends/imgui_impl_opengl3.cpp)
target_include_directories(imgui SYSTEM PUBLIC ${imgui} ${imgui}/misc/cpp)
target_compile_definitions(imgui PRIVATE IMGUI_IMPL_OPENGL_ES3)
floor(studio LIGHT USES app PRIVATE imgui PRECOMPILE imgui.h studio/studio.h)
add_executable(ray-studio src/studio/main.cpp)
target_link_libraries(ray-studio PRIVATE trace_studio imgui)
