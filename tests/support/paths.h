// Where this checkout, its program and the shared material lie. The folders are compiled into paths.cpp
// alone, so that the object files of two checkouts are the same and a compiler cache serves both.
#pragma once

#include <string>

namespace trace::test {

/// The root of the checkout.
std::string sourceFolder();
/// Scenes and reference pictures that are not part of the repository; the folder may be absent.
std::string sharedFolder();
/// The program `ray` of this build.
std::string rayProgram();

}  // namespace trace::test
