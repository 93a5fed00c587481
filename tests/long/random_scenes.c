/* Random scenes as files: random_scenes FOLDER FIRST COUNT writes FOLDER/random-<seed>.json, whose runs are
 * of a second, with frames every tenth; groups of springs that only pull have names that begin with "pull".
 * Prints the names of the files. */
#include "check.h"
#include "random_scene.h"
#include "run.h"

#include <stdio.h>
#include <stdlib.h>

/* The features that a scene file can hold, in turns; no springs that start without a direction, whose motion
 * depends on rounding. */
static struct random_scene_request request(uint64_t seed) {
  static const int32_t features[] = {
      SCENE_GRAVITY | SCENE_PINNED, SCENE_GRAVITY | SCENE_DAMPING | SCENE_DRAG | SCENE_PINNED,
      SCENE_GRAVITY | SCENE_PULL_ONLY | SCENE_DAMPING | SCENE_PINNED, SCENE_DRAG | SCENE_DAMPING,
      SCENE_GRAVITY | SCENE_PULL_ONLY | SCENE_PINNED};
  const int turn = (int)(seed % 5);
  return (struct random_scene_request){.seed = seed,
                                       .particles = 6 + (int64_t)(seed % 7),
                                       .springs = 10 + 3 * (int64_t)(seed % 4),
                                       .features = features[turn],
                                       .rope = seed % 4 == 1 ? 6 : 0,
                                       .cloth = {seed % 4 == 2 ? 4 : 0, seed % 4 == 2 ? 3 : 0},
                                       .lattice = {seed % 4 == 3 ? 2 : 0, 2, 3}};
}

int main(int argc, char **argv) {
  if (argc != 4) return 2;
  const uint64_t first = strtoull(argv[2], NULL, 10), count = strtoull(argv[3], NULL, 10);
  for (uint64_t seed = first; seed < first + count; seed++) {
    owned_random_scene scene;
    char path[4096];
    random_scene_create(request(seed), &scene);
    owned_options *options =
        run_options((struct run){.method = "rk4", .step = 1e-3, .duration = 1.0, .every = 0.1});
    snprintf(path, sizeof path, "%s/random-%llu.json", argv[1], (unsigned long long)seed);
    check_ok(hooke_scene_write(path, scene.system, "", options));
    printf("%s\n", path);
  }
  return 0;
}
