// The valid values of the fields of Inventor's and VRML's nodes: a table, by which values of another kind,
// out of their range or misspelt are found. Such a field then has its default.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "formats/inventor/inventor_fields.h"

namespace trace::inventor {

/// Tells of one field: where, what is wrong, a hint, and the kind of mistake.
using Complain = std::function<void(const Token& at, std::string what, std::string hint, std::string kind)>;

/// Looks at the fields that the node itself gives. Nodes that the table does not have are not looked at.
void checkFields(const Values& node, bool vrml2, const Complain& complain);

}  // namespace trace::inventor
