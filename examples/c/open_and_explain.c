/* Makes the ball of a scene green, renders it and asks one pixel why. Usage: open_and_explain SCENE PICTURE
 */
#include <stdio.h>
#include <traceray/traceray_c.h>

int main(int count, char** arguments) {
  const double green[3] = {0.1, 0.7, 0.2};
  if (count != 3) {
    fprintf(stderr, "Usage: open_and_explain SCENE PICTURE\n");
    return 2;
  }
  traceray_scene* scene = traceray_open(arguments[1]);
  traceray_choose(scene, "width", "64");
  traceray_choose(scene, "spp", "1");
  traceray_set_numbers(scene, "ball.material", "diffuse", green, 3);
  traceray_render* picture = traceray_render_scene(scene, NULL, NULL);
  const char* file = traceray_write(picture, arguments[2]);
  const char* why = file ? traceray_explain(picture, 32, 20, 0) : NULL;
  if (why)
    printf("%s", why);
  else
    fprintf(stderr, "%s", traceray_error());
  traceray_free_render(picture);
  traceray_free_scene(scene);
  return why ? 0 : 1;
}
