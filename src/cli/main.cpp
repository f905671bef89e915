// ray: the command line of Trace. See commands.cpp for what it can do.
#include "cli/commands.h"

int main(int argc, char** argv) { return trace::cli::run({argv + 1, argv + argc}); }
