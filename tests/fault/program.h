/* Name of main() of cli/main.c in the tests of faults. */
#ifndef FAULT_PROGRAM_H
#define FAULT_PROGRAM_H

int hooke_program_main(int argc, char **argv);

#endif
