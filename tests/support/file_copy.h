/* The current bytes of a file, which a kill would leave. */
#ifndef TESTS_SUPPORT_FILE_COPY_H
#define TESTS_SUPPORT_FILE_COPY_H

/* Fails the test on error. */
void copy_file(const char *from, const char *to);

#endif
