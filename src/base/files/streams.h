// The standard streams of a program, made safe before it opens its first file.
#pragma once

namespace trace {

/// To be called first in main(). Occupies the places of standard streams that are closed, so that no file or
/// pipe of the program gets one of them and is then written to as if it were stderr; what is written to a
/// closed stdout still fails. A stream whose reader is gone, or a file that has met its limit of size, is an
/// error of writing from now on, and no longer the end of the program.
void guardStreams();

}  // namespace trace
