// Nodes and fields that students of the courses added to .ray. All that is known of them stands in
// ray_students.cpp.
#pragma once

#include "formats/ray/syntax/syntax.h"

namespace trace::rayfile {

/// Does the file have nodes or fields that translateStudents() would rewrite?
bool speaksStudents(const Syntax& syntax);

/// Rewrites them into nodes of the format, in place, so that the reader never sees them. Nodes keep the
/// places of the text that they stand for. What cannot be translated stays as it is, and the reader reports
/// it. What is shown otherwise than its program did is noted as a remark of the syntax.
/// Precondition: expand() has run.
void translateStudents(Syntax& syntax);

}  // namespace trace::rayfile
