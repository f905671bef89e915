// The list of what a scene may get, as pictures: shapes, lights and materials.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "app/session/background_task.h"
#include "app/view/additions.h"
#include "studio/widgets/texture.h"

namespace trace::studio {

struct Studio;

/// Small pictures of additions, each made once, when it is first to be seen.
class Previews {
 public:
  /// Null until it is made; then perhaps empty.
  const Texture* of(const Addition& addition);
  /// Takes what was made; for each frame.
  void update();
  /// One is being made.
  bool busy() const { return task_.busy(); }
  /// One was made, and is to be shown.
  bool news() const { return task_.hasNews(); }

 private:
  struct Made {
    std::string name;
    Bytes bytes;
  };
  std::map<std::string, std::unique_ptr<Texture>> made_;
  BackgroundTask<Made> task_;
};

/// The button "Add..." and its list.
void drawAdditions(Studio& studio);

}  // namespace trace::studio
