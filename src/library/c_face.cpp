// The library for programs in C: each function is one of traceray.h, whose exceptions become a reason that
// the thread keeps.
#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "traceray/traceray.h"
#include "traceray/traceray_c.h"

struct traceray_scene {
  traceray::Scene scene;
  std::string text{};  ///< what the last call returned
};
struct traceray_render {
  traceray::Render render;
  std::string text{};
  std::optional<traceray::Image> shown{};
};

namespace traceray {
namespace {

struct Failure {
  traceray_fault kind = TRACERAY_NONE;
  std::string text{};
};
thread_local Failure lastFailure;

/// The scene or the picture is NULL, since a call before has failed: its reason stays.
struct FailedBefore {};

traceray_fault faultForC(Error::Kind kind) {
  switch (kind) {
    case Error::Kind::file: return TRACERAY_FILE;
    case Error::Kind::usage: return TRACERAY_USAGE;
    case Error::Kind::scene: return TRACERAY_SCENE;
    case Error::Kind::limit: break;
  }
  return TRACERAY_LIMIT;
}

/// The result of work(), or `failed`; no exception gets into a program in C.
template <class Result, class Work>
Result attempted(Result failed, const Work& work) noexcept {
  try {
    try {
      const Result result = work();
      lastFailure = {};
      return result;
    } catch (const FailedBefore&) {
      if (lastFailure.kind == TRACERAY_NONE)
        lastFailure = {TRACERAY_USAGE, "error: expected a scene, a picture or a text, found NULL\n"};
    } catch (const Error& error) {
      lastFailure = {faultForC(error.kind()), error.what() + std::string("\n")};
    } catch (const std::bad_alloc&) {
      lastFailure = {TRACERAY_LIMIT, "error: out of memory\n"};
    } catch (const std::exception& error) {
      lastFailure = {TRACERAY_USAGE, "error: " + std::string(error.what()) + "\n"};
    }
  } catch (...) {  // not even the reason can be kept
  }
  return failed;
}
/// 1 if work() ends, else 0.
template <class Work>
int succeeds(const Work& work) noexcept {
  return attempted(0, [&] {
    work();
    return 1;
  });
}

template <class Given>
Given& given(Given* pointer) {
  if (!pointer) throw FailedBefore();
  return *pointer;
}
std::string given(const char* text) {
  if (!text) throw FailedBefore();
  return text;
}

/// The text that work() makes of the scene or picture, which keeps it.
template <class Handle, class Work>
const char* kept(Handle* handle, const Work& work) noexcept {
  return attempted<const char*>(nullptr, [&] {
    Handle& of = given(handle);
    of.text = work(of);
    return of.text.c_str();
  });
}

std::string joined(std::span<const Problem> problems) {
  std::string text;
  for (const Problem& problem : problems) text += problem.text;
  return text;
}

/// The part that look() finds, if there is one of the name.
template <class Look>
std::optional<Part> found(const Look& look) {
  try {
    return look();
  } catch (const Error&) {
    return {};
  }
}

/// The part of that name: see traceray_c.h.
Part partOf(traceray_scene* scene, const char* name) {
  Scene& in = given(scene).scene;
  const std::string path = given(name);
  constexpr std::string_view kOfObject = ".material";
  if (path == "camera") return in.camera();
  if (path == "background") return in.background();
  if (path.ends_with(kOfObject)) return in.object(path.substr(0, path.size() - kOfObject.size())).material();
  if (auto object = found([&] { return in.object(path); })) return *object;
  if (auto light = found([&] { return in.light(path); })) return *light;
  if (auto material = found([&] { return in.material(path); })) return *material;
  return in.object(path);  // says what it may have meant
}

traceray_scene* newScene(Scene scene) { return new traceray_scene{std::move(scene)}; }

const char* explained(traceray_render* render, int x, int y, int sample,
                      const std::string& (Explanation::*as)() const) {
  return kept(render, [&](traceray_render& of) { return (of.render.explain(x, y, sample).*as)(); });
}

}  // namespace
}  // namespace traceray

using namespace traceray;

const char* traceray_version() {
  static const std::string text = version();
  return text.c_str();
}

const char* traceray_error() { return lastFailure.text.c_str(); }
traceray_fault traceray_error_kind() { return lastFailure.kind; }

// --- scenes -------------------------------------------------------------------------------------------

traceray_scene* traceray_new_scene() {
  return attempted<traceray_scene*>(nullptr, [] { return newScene(Scene()); });
}
traceray_scene* traceray_open(const char* file) {
  return attempted<traceray_scene*>(nullptr, [&] { return newScene(Scene::open(given(file))); });
}
traceray_scene* traceray_from_text(const char* text, const char* file) {
  return attempted<traceray_scene*>(
      nullptr, [&] { return newScene(Scene::fromText(given(text), file ? file : "scene.ray")); });
}
traceray_scene* traceray_copy_scene(const traceray_scene* scene) {
  return attempted<traceray_scene*>(nullptr, [&] { return newScene(given(scene).scene); });
}
void traceray_free_scene(traceray_scene* scene) { delete scene; }

int traceray_add(traceray_scene* scene, const char* statements) {
  return succeeds([&] { given(scene).scene.addText(given(statements)); });
}
int traceray_choose(traceray_scene* scene, const char* option, const char* value) {
  return succeeds([&] { given(scene).scene.choose(given(option), given(value)); });
}

int traceray_set_numbers(traceray_scene* scene, const char* part, const char* field, const double* numbers,
                         size_t count) {
  return succeeds([&] {
    const std::span<const double> all(&given(numbers), count);
    partOf(scene, part)
        .set(given(field), count == 1 ? Value(all[0]) : Value(Value::List(all.begin(), all.end())));
  });
}
int traceray_set_text(traceray_scene* scene, const char* part, const char* field, const char* text) {
  return succeeds([&] { partOf(scene, part).set(given(field), given(text)); });
}
int traceray_set_switch(traceray_scene* scene, const char* part, const char* field, int on) {
  return succeeds([&] { partOf(scene, part).set(given(field), on != 0); });
}
const char* traceray_get(traceray_scene* scene, const char* part, const char* field) {
  return attempted<const char*>(nullptr, [&] {
    const Value value = partOf(scene, part).get(given(field));
    scene->text = value.isText() ? value.text() : value.inLanguage();
    return scene->text.c_str();
  });
}
size_t traceray_get_numbers(traceray_scene* scene, const char* part, const char* field, double* numbers,
                            size_t capacity) {
  return attempted<size_t>(0, [&] {
    const Value value = partOf(scene, part).get(given(field));
    const std::vector<double> all = value.isNumber() ? std::vector{value.number()} : value.numbers();
    if (capacity > 0) std::copy_n(all.begin(), std::min(capacity, all.size()), &given(numbers));
    return all.size();
  });
}
int traceray_remove(traceray_scene* scene, const char* part) {
  return succeeds([&] { partOf(scene, part).remove(); });
}
int traceray_get_transform(traceray_scene* scene, const char* object, double numbers[16]) {
  return succeeds([&] {
    const std::array<double, 16> all = partOf(scene, object).transform();
    std::copy(all.begin(), all.end(), &given(numbers));
  });
}
int traceray_set_transform(traceray_scene* scene, const char* object, const double numbers[16]) {
  return succeeds([&] {
    std::array<double, 16> all{};
    std::copy_n(&given(numbers), all.size(), all.begin());
    partOf(scene, object).setTransform(all);
  });
}

const char* traceray_warnings(traceray_scene* scene) {
  return kept(scene, [&](traceray_scene& of) { return joined(of.scene.warnings()); });
}
const char* traceray_lint(traceray_scene* scene) {
  return kept(scene, [&](traceray_scene& of) { return joined(of.scene.lint()); });
}
int traceray_save(traceray_scene* scene, const char* file) {
  return succeeds([&] { given(scene).scene.save(given(file)); });
}

// --- rendering ----------------------------------------------------------------------------------------

traceray_render* traceray_render_scene(const traceray_scene* scene, traceray_progress progress, void* user) {
  return attempted<traceray_render*>(nullptr, [&] {
    OnProgress told;
    if (progress) told = [=](const Progress& now) { return progress(now.fraction, now.seconds, user) != 0; };
    return new traceray_render{given(scene).scene.render({}, told)};
  });
}
void traceray_free_render(traceray_render* render) { delete render; }

int traceray_width(const traceray_render* render) {
  return attempted(0, [&] { return given(render).render.width(); });
}
int traceray_height(const traceray_render* render) {
  return attempted(0, [&] { return given(render).render.height(); });
}
int traceray_is_finished(const traceray_render* render) {
  return attempted(0, [&] { return static_cast<int>(given(render).render.finished()); });
}
const char* traceray_end(traceray_render* render) {
  return kept(render, [&](traceray_render& of) { return of.render.end(); });
}
const char* traceray_render_warnings(traceray_render* render) {
  return kept(render, [&](traceray_render& of) { return joined(of.render.warnings()); });
}

const float* traceray_light(traceray_render* render) {
  return attempted<const float*>(nullptr, [&] { return given(render).render.image().values.data(); });
}
const float* traceray_shown(traceray_render* render) {
  return attempted<const float*>(nullptr, [&] {
    traceray_render& of = given(render);
    if (!of.shown) of.shown = of.render.shown();
    return of.shown->values.data();
  });
}
const float* traceray_pass(traceray_render* render, const char* name) {
  return attempted<const float*>(nullptr,
                                 [&] { return given(render).render.pass(given(name)).values.data(); });
}
const unsigned char* traceray_png(traceray_render* render, size_t* size) {
  return attempted<const unsigned char*>(nullptr, [&] {
    traceray_render& of = given(render);
    of.text = of.render.png();
    given(size) = of.text.size();
    return reinterpret_cast<const unsigned char*>(of.text.data());
  });
}
const char* traceray_write(traceray_render* render, const char* file) {
  return kept(render, [&](traceray_render& of) { return of.render.write(given(file)); });
}

const char* traceray_explain(traceray_render* render, int x, int y, int sample) {
  return explained(render, x, y, sample, &Explanation::text);
}
const char* traceray_explain_json(traceray_render* render, int x, int y, int sample) {
  return explained(render, x, y, sample, &Explanation::json);
}
