# Dear ImGui for Windows, compiled from Debian's sources, which cmake/libraries.sh fetched. It takes the place of the
# library that pkg-config finds on Linux.
file(GLOB imgui ${TRACE_WINDOWS_LIBRARIES}/sources/imgui-[0-9]*)
if(imgui AND glfw3_FOUND)
  add_library(imgui STATIC ${imgui}/imgui.cpp ${imgui}/imgui_draw.cpp ${imgui}/imgui_tables.cpp ${imgui}/imgui_widgets.cpp
    ${imgui}/misc/cpp/imgui_stdlib.cpp ${imgui}/backends/imgui_impl_glfw.cpp ${imgui}/backends/imgui_impl_opengl3.cpp)
  target_include_directories(imgui SYSTEM PUBLIC ${imgui} ${imgui}/misc/cpp)
  target_link_libraries(imgui PUBLIC glfw PRIVATE imm32)
  set_target_properties(imgui PROPERTIES UNITY_BUILD OFF)  # its back ends include different headers of OpenGL
  add_library(PkgConfig::IMGUI ALIAS imgui)
  set(IMGUI_FOUND ON)
endif()
