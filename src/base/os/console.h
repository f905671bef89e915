// The terminal that the program was started in.
#pragma once

namespace trace::os {

enum class Stream { result, messages };  // stdout, stderr

/// The stream is a terminal on which a line can be drawn again, and which takes colours.
bool isScreen(Stream stream);
/// The width of the terminal; 0 if neither stream is one.
int terminalColumns();

}  // namespace trace::os
