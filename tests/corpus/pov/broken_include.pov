#include "missing.inc"
