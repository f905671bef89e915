// Names of files as other files write them: programs of other systems, folders of other machines.
#pragma once

#include <string>

namespace trace {

struct NamedFile {
  std::string path;
  std::string remark;  ///< a warning, if the name is not quite that of the file; may be empty
};

/// The file that the file `from` means by `name`: the first that exists and may be read
/// (base/files/read_scope.h). Looked for are, with `name` as it is, without quotation marks, with backslashes
/// as slashes and with its percent signs decoded: the file beside `from`; in the current folder; in one of
/// three folders above; by the end of the name, and by its last part in the folders that it names; and all
/// these with letters of the other case, which is remarked. besideFile() if there is none.
NamedFile namedFile(const std::string& from, const std::string& name);

/// Does namedFile() find one?
bool namesFile(const std::string& from, const std::string& name);

}  // namespace trace
