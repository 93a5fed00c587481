/* What people type in place of a name: other common words, mistyped ones and their beginnings. */
#pragma once

#include <stdint.h>

/* The option, the verb or the option in its place that a common word means; the word itself if none. */
const char *cli_words_meant(const char *word);

/* The candidate that a word means or is nearest to, up to the next call; NULL if none is near. `next` gives
 * candidate i, NULL past the last. */
const char *cli_suggest(const char *word, const char *(*next)(int64_t i, const void *ctx), const void *ctx);

/* The file beside the missing `path` whose name is nearest; NULL if `path` is there, or none is near. */
const char *cli_suggest_file(const char *path);
