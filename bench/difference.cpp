// bench_difference A B: how far two pictures are apart, so that programs.sh notices when the programs it
// times do not draw the same thing. Prints: mean difference in levels, then the share of values more than 8
// levels apart.
#include <cstdio>
#include <exception>
#include <iostream>

#include "image/codec.h"
#include "image/compare.h"

int main(int argc, char** argv) {
  if (argc != 3) return std::cerr << "usage: bench_difference A B\n", 2;
  try {
    const trace::Comparison c =
        trace::compare(trace::readPicture(argv[1]), trace::readPicture(argv[2]), 8.0 / 255);
    std::printf("%.3f %.5f\n", c.mean * 255, c.fractionBeyond);
    return 0;
  } catch (const std::exception& error) {
    return std::cerr << error.what() << '\n', 1;
  }
}
