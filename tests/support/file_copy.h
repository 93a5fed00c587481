/* The bytes of a file as they are now, which is what a kill would leave. */
#ifndef TESTS_SUPPORT_FILE_COPY_H
#define TESTS_SUPPORT_FILE_COPY_H

/* Fails the test where that does not go. */
void copy_file(const char *from, const char *to);

#endif
