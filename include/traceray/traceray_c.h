/* Trace for programs in C, and for languages that call C: Rust, Julia, Go, Swift, C#, JavaScript.
 *
 *   traceray_scene* scene = traceray_open("room.ray");
 *   traceray_choose(scene, "width", "320");
 *   traceray_render* picture = traceray_render_scene(scene, 0, 0);
 *   if (!traceray_write(picture, "room.png")) fputs(traceray_error(), stderr);
 *   traceray_free_render(picture);
 *   traceray_free_scene(scene);
 *
 * It is the library of traceray.h with another face: what a function does stands there, and in docs/cpp.md.
 * All names of the scene language (docs/language.md) and of options (docs/options.md) hold here, too.
 *
 * A function that gives a pointer gives NULL if it fails, one that gives an int 0 (else 1). Then
 * traceray_error() has the reason. Where a scene or a picture is expected, NULL is what a failed call gave:
 * the call fails too, and the reason of the first stays. Texts are UTF-8 that ends with a 0. What a function
 * returns belongs to the scene or the picture that it was given, and holds until the next call with that
 * scene or picture; numbers of pictures hold as long as the picture does. A scene or picture may be used by
 * one thread at a time.
 *
 * While the version of Trace begins with 0, a minor version may change this header.
 */
#ifndef TRACERAY_C_H
#define TRACERAY_C_H

#include <stddef.h>

#ifndef TRACERAY_API
#if defined(__GNUC__)
#define TRACERAY_API __attribute__((visibility("default")))
#else
#define TRACERAY_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** What a render needs: objects, lights, materials, a camera, options. */
typedef struct traceray_scene traceray_scene;
/** A picture that was rendered, with all it takes to explain it. */
typedef struct traceray_render traceray_render;

/** "Trace 0.1.0, commit 2093372". */
TRACERAY_API const char* traceray_version(void);

/* --- errors ------------------------------------------------------------------------------------------- */

typedef enum traceray_fault {
  TRACERAY_NONE,  /**< the last call of this thread did not fail */
  TRACERAY_FILE,  /**< a file cannot be read or written */
  TRACERAY_USAGE, /**< a name, a value or a call that makes no sense */
  TRACERAY_SCENE, /**< what a scene says is wrong */
  TRACERAY_LIMIT  /**< out of memory or time */
} traceray_fault;

/** Why the last call of this thread failed: `file:line:column: error: what`, the line with a caret below, and
 * a hint; "" if it did not. Holds until the next call of this thread. */
TRACERAY_API const char* traceray_error(void);
TRACERAY_API traceray_fault traceray_error_kind(void);

/* --- scenes ------------------------------------------------------------------------------------------- */

/** A scene without objects. What is left out is completed as in a file that begins with `Trace 1`. */
TRACERAY_API traceray_scene* traceray_new_scene(void);
/** Any format of docs/formats.md. */
TRACERAY_API traceray_scene* traceray_open(const char* file);
/** The same of a text; `file` gives it a name, and a folder for the files that it names. NULL: scene.ray. */
TRACERAY_API traceray_scene* traceray_from_text(const char* text, const char* file);
/** An independent copy. */
TRACERAY_API traceray_scene* traceray_copy_scene(const traceray_scene* scene);
/** NULL is no fault, here and below. */
TRACERAY_API void traceray_free_scene(traceray_scene* scene);

/** Adds statements of the scene language, without a header: "sphere { name = ball; }". */
TRACERAY_API int traceray_add(traceray_scene* scene, const char* statements);
/** An option for all renders of the scene: ("integrator", "path"). */
TRACERAY_API int traceray_choose(traceray_scene* scene, const char* option, const char* value);

/* A part is the name of an object, a light or a material, in this order; "camera", "background"; or
 * "NAME.material", the material of an object. */

/** Sets a field to a number, a vector, a colour or a list of numbers. */
TRACERAY_API int traceray_set_numbers(traceray_scene* scene, const char* part, const char* field,
                                      const double* numbers, size_t count);
/** Sets a field to a text, the name of a choice, a material of the library, or a file. */
TRACERAY_API int traceray_set_text(traceray_scene* scene, const char* part, const char* field,
                                   const char* text);
/** Sets a field that is on or off. */
TRACERAY_API int traceray_set_switch(traceray_scene* scene, const char* part, const char* field, int on);
/** The value of a field, as a scene file has it: "(0.8, 0.4, 0.2)". */
TRACERAY_API const char* traceray_get(traceray_scene* scene, const char* part, const char* field);
/** Its numbers, at most `capacity` of them. Returns how many there are; 0 if it fails, or has none. */
TRACERAY_API size_t traceray_get_numbers(traceray_scene* scene, const char* part, const char* field,
                                         double* numbers, size_t capacity);
/** Takes an object or a light out of the scene. */
TRACERAY_API int traceray_remove(traceray_scene* scene, const char* part);
/** From the object to the world: 4 rows of 4 numbers, the last (0, 0, 0, 1). */
TRACERAY_API int traceray_get_transform(traceray_scene* scene, const char* object, double numbers[16]);
TRACERAY_API int traceray_set_transform(traceray_scene* scene, const char* object, const double numbers[16]);

/** The warnings about the scene as it is, a text; "" if there are none. */
TRACERAY_API const char* traceray_warnings(traceray_scene* scene);
/** What is likely a mistake (docs/lint.md), a text; "" if nothing is. */
TRACERAY_API const char* traceray_lint(traceray_scene* scene);
/** Writes the scene in the format of the name. */
TRACERAY_API int traceray_save(traceray_scene* scene, const char* file);

/* --- rendering ---------------------------------------------------------------------------------------- */

/** Called when a render begins and then some times a second, by the thread that renders: the fraction from 0
 * to 1, and the seconds since the render began. 0 stops it, and keeps what was traced. */
typedef int (*traceray_progress)(double fraction, double seconds, void* user);

/** Blocks until the picture is there. Its options are those of the scene, and those that traceray_choose()
 * has set. `progress` may be NULL; it gets `user`. */
TRACERAY_API traceray_render* traceray_render_scene(const traceray_scene* scene, traceray_progress progress,
                                                    void* user);
TRACERAY_API void traceray_free_render(traceray_render* render);

TRACERAY_API int traceray_width(const traceray_render* render);
TRACERAY_API int traceray_height(const traceray_render* render);
/** All samples of all pixels are there. */
TRACERAY_API int traceray_is_finished(const traceray_render* render);
/** "finished", "cancelled", "time limit", "out of memory", or "failed: " and the reason. */
TRACERAY_API const char* traceray_end(traceray_render* render);
/** Those of the scene, then those of the render, a text; "" if there are none. */
TRACERAY_API const char* traceray_render_warnings(traceray_render* render);

/** Linear light: height rows of width pixels of red, green and blue, from the top left. */
TRACERAY_API const float* traceray_light(traceray_render* render);
/** What a PNG file of it shows, 0 to 1, likewise. */
TRACERAY_API const float* traceray_shown(traceray_render* render);
/** The values of a pass that the option `passes` asked for, likewise: "depth". */
TRACERAY_API const float* traceray_pass(traceray_render* render, const char* name);
/** The bytes of a PNG file of it, and their number. */
TRACERAY_API const unsigned char* traceray_png(traceray_render* render, size_t* size);
/** Writes the picture and its passes; returns the name of the file, which another name may stand beside if a
 *  part of the picture would have replaced a whole one. */
TRACERAY_API const char* traceray_write(traceray_render* render, const char* file);

/** Why the pixel has its colour, (0, 0) at the top left: the text of `ray explain`, or its JSON. */
TRACERAY_API const char* traceray_explain(traceray_render* render, int x, int y, int sample);
TRACERAY_API const char* traceray_explain_json(traceray_render* render, int x, int y, int sample);

#ifdef __cplusplus
}
#endif

#endif
